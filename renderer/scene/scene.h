#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "renderer/scene/lights/delta_light.h"
#include "renderer/scene/lights/environment.h"
#include "renderer/scene/materials/material.h"
#include "renderer/scene/shapes/shape.h"
#include "renderer/scene/textures/texture.h"

namespace quartet {

// A scene as data: what the file says, with every transform applied. World units are those of the
// file; colours are linear RGB with Rec. 709 primaries; radiance is in W / (m² sr) or any unit
// proportional to it.

/// Which side of the picture `Camera::fov` spans.
enum class FovAxis { x, y, diagonal, smaller, larger };

/// A pinhole, or a thin lens where aperture_radius > 0.
struct Camera {
  glm::vec3 origin{0.0f};
  glm::vec3 right{1.0f, 0.0f, 0.0f};    ///< unit length; towards growing x in the picture
  glm::vec3 up{0.0f, 1.0f, 0.0f};       ///< unit length
  glm::vec3 forward{0.0f, 0.0f, 1.0f};  ///< unit length
  float fov = 39.3f;                    ///< degrees, along `fov_axis`
  FovAxis fov_axis = FovAxis::x;
  float aperture_radius = 0.0f;  ///< world units
  float focus_distance = 1.0f;   ///< world units along `forward`
  bool operator==(const Camera&) const = default;
};

struct Scene {
  std::string name;  ///< file name without folder and extension
  std::filesystem::path path;
  std::vector<Shape> shapes;
  std::vector<Material> materials;
  Textures textures;
  std::vector<DeltaLight> delta_lights;
  Environment environment;
  Camera camera;
  int width = 768;
  int height = 576;
  /// Longest path in segments: 1 shows lights only, 2 adds direct light. Mitsuba's -1 is this.
  int max_depth = std::numeric_limits<int>::max();
  std::vector<std::string> warnings;  ///< what was approximated or left out, each "file:line: text"
};

}  // namespace quartet
