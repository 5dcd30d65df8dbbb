#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace quartet {

/// A scene as data: what the file says, with every transform applied. World units are those of the
/// file; colours are linear RGB with Rec. 709 primaries; radiance is in W / (m² sr) or any unit
/// proportional to it.

/// The two-colour checkerboard of Mitsuba: the unit square of (to_uv · uv) holds 2 × 2 squares, and
/// the one at its origin shows color0.
struct Checkerboard {
  glm::vec3 color0{0.4f};
  glm::vec3 color1{0.2f};
  glm::mat3 to_uv{1.0f};
};

/// A colour slot of a material or an emitter: one value, or a texture of the scene.
struct Color {
  static constexpr int no_texture = -1;
  glm::vec3 value{0.0f};
  int texture = no_texture;  ///< index into Scene::textures; `value` is not used then
};

enum class MaterialKind { diffuse, conductor, rough_conductor, dielectric };

struct Material {
  MaterialKind kind = MaterialKind::diffuse;
  bool two_sided = false;  ///< reflects on the back like on the front; never a dielectric
  Color reflectance{
      {0.5f, 0.5f, 0.5f}};  ///< albedo (diffuse), or a factor on the reflected radiance
  Color transmittance{{1.0f, 1.0f, 1.0f}};  ///< factor on the transmitted radiance (dielectric)
  glm::vec3 eta{0.0f};                      ///< conductors: real part of the index of refraction
  glm::vec3 k{1.0f};                        ///< conductors: extinction; eta = 0 reflects everything
  float ior = 1.5046f;                      ///< dielectric: index inside over index outside
  float alpha = 0.1f;                       ///< rough_conductor: GGX roughness
  std::string id;                           ///< as in the file, may be empty
};

/// Triangles; normals and uvs are either empty or one a vertex. The geometric normal of a triangle
/// follows the right-hand rule over its vertices and is the emitting, front side.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> triangles;
  /// The mesh is exactly one parallelogram: triangles (0,1,2) and (0,2,3), corner 0 and edges to 1
  /// and 3. Such a light is sampled as one piece rather than two.
  bool parallelogram = false;
};

struct Sphere {
  glm::vec3 center{0.0f};
  float radius = 1.0f;
  bool flip_normals = false;  ///< the front is the inside
  glm::mat3 to_local{1.0f};   ///< world direction to the sphere's own axes, for uv
};

struct Disk {
  glm::vec3 center{0.0f};
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit length, the front
  glm::vec3 axis_u{1.0f, 0.0f, 0.0f};  ///< unit length, where the angle of uv is 0
  glm::vec3 axis_v{0.0f, 1.0f, 0.0f};  ///< unit length, where it is 1/4; left-handed if mirrored
  float radius = 1.0f;
};

struct Shape {
  std::variant<Mesh, Sphere, Disk> geometry;
  int material = 0;  ///< index into Scene::materials
  bool emits = false;
  Color radiance;  ///< of the front side, where `emits`
  std::string id;  ///< as in the file, may be empty
  int line = 0;    ///< in the scene file, for messages
};

/// Shines alike in all directions from a point. No ray meets it.
struct PointLight {
  glm::vec3 position{0.0f};
  glm::vec3 intensity{1.0f};  ///< power per solid angle: radiance times an area
};

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
  std::vector<Checkerboard> textures;
  std::vector<PointLight> points;
  glm::vec3 environment{0.0f};  ///< constant radiance from every direction that meets no shape
  Camera camera;
  int width = 768;
  int height = 576;
  /// Longest path in segments: 1 shows lights only, 2 adds direct light. Mitsuba's -1 is this.
  int max_depth = std::numeric_limits<int>::max();
  std::vector<std::string> warnings;  ///< what was approximated or left out, each "file:line: text"
};

}  // namespace quartet
