#include "renderer/scene/xml/sensor.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "renderer/base/excerpt.h"
#include "renderer/scene/limits.h"
#include "renderer/scene/xml/element.h"
#include "renderer/scene/xml/number.h"

namespace quartet {
namespace {

struct FovAxisName {
  std::string_view name;
  FovAxis axis;
};

constexpr std::array fov_axes = {
    FovAxisName{"x", FovAxis::x},
    FovAxisName{"y", FovAxis::y},
    FovAxisName{"diagonal", FovAxis::diagonal},
    FovAxisName{"smaller", FovAxis::smaller},
    FovAxisName{"larger", FovAxis::larger},
};

/// Mitsuba's camera looks along its +z, with +y up and +x to the left of the picture. A scale does
/// not move what a pinhole sees, so the axes only count by their directions.
void read_axes(Element& element, Camera& camera) {
  const glm::dmat4 to_world = element.transform("to_world");
  const glm::dvec3 right = -glm::normalize(glm::dvec3(to_world[0]));
  const glm::dvec3 up = glm::normalize(glm::dvec3(to_world[1]));
  const glm::dvec3 forward = glm::normalize(glm::dvec3(to_world[2]));
  constexpr double tolerance = 1e-3;
  if (std::abs(glm::dot(right, up)) > tolerance || std::abs(glm::dot(up, forward)) > tolerance ||
      std::abs(glm::dot(forward, right)) > tolerance) {
    element.fail("to_world of a camera shears, expected axes at right angles");
  }
  camera.origin = glm::vec3(to_world[3]);
  camera.right = glm::vec3(right);
  camera.up = glm::vec3(up);
  camera.forward = glm::vec3(forward);
}

/// "50mm": focal length on 35 mm film, whose frame is 36 mm × 24 mm.
void read_focal_length(Element& element, Camera& camera) {
  const std::string text = element.text("focal_length", "50mm");
  const std::string_view number =
      text.ends_with("mm") ? std::string_view(text).substr(0, text.size() - 2) : text;
  const std::optional<double> length = parse_number(number);
  if (!length || *length <= 0.0) {
    element.fail(fmt::format("focal_length is '{}', expected e.g. \"50mm\"", excerpt(text)));
  }
  camera.fov = float(glm::degrees(2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / *length)));
  camera.fov_axis = FovAxis::diagonal;
}

void read_fov(Element& element, Camera& camera) {
  if (!element.has("fov")) return read_focal_length(element, camera);
  if (element.has("focal_length")) element.fail("both fov and focal_length, expected one of them");
  camera.fov = float(element.number("fov", 0.0));
  const std::string name = element.text("fov_axis", "x");
  const auto* const axis =
      std::find_if(fov_axes.begin(), fov_axes.end(),
                   [&](const FovAxisName& candidate) { return candidate.name == name; });
  if (axis == fov_axes.end()) {
    element.fail(
        fmt::format("fov_axis is '{}', expected x, y, diagonal, smaller or larger", excerpt(name)));
  }
  camera.fov_axis = axis->axis;
}

void perspective(Element& element, Camera& camera) {
  read_axes(element, camera);
  read_fov(element, camera);
  for (const std::string_view name : {"principal_point_offset_x", "principal_point_offset_y"}) {
    if (element.number(name, 0.0) != 0.0) {
      element.warn(fmt::format("{} is left out: the view is centred", name));
    }
  }
}

void thinlens(Element& element, Camera& camera) {
  perspective(element, camera);
  if (!element.has("aperture_radius")) element.fail("sensor 'thinlens' has no aperture_radius");
  camera.aperture_radius = float(element.number("aperture_radius", 0.0));
  // Mitsuba's default is its far clipping plane.
  camera.focus_distance = float(element.positive("focus_distance", 1e4));
}

struct SensorType {
  std::string_view name;
  void (*read)(Element&, Camera&);
};

constexpr std::array sensor_types = {
    SensorType{"perspective", perspective},
    SensorType{"thinlens", thinlens},
};

void read_film(SceneBuilder& builder, pugi::xml_node node) {
  Element film(builder, node);
  for (const auto& [name, size] :
       {std::pair("width", &builder.scene.width), std::pair("height", &builder.scene.height)}) {
    *size = film.integer(name, *size);
  }
  if (const std::string fault = picture_size_fault(builder.scene.width, builder.scene.height);
      !fault.empty()) {
    film.fail(fault);
  }
  for (pugi::xml_node filter : film.objects("rfilter")) {
    const std::string_view type = filter.attribute("type").value();
    if (type != "box") {
      builder.warn(filter, fmt::format("reconstruction filter '{}' becomes the box filter, because "
                                       "statistics of a pixel need samples of its own",
                                       excerpt(type)));
    }
  }
  film.ignore({"file_format", "pixel_format", "component_format", "banner", "high_quality_edges",
               "sample_border", "compensate", "filename", "variance"});
  film.warn_unused();
}

}  // namespace

void read_sensor(SceneBuilder& builder, pugi::xml_node node) {
  Element element(builder, node);
  const auto* const type =
      std::find_if(sensor_types.begin(), sensor_types.end(),
                   [&](const SensorType& candidate) { return candidate.name == element.type(); });
  if (type == sensor_types.end()) {
    element.fail(fmt::format("{} is not known, expected perspective or thinlens", element.title()));
  }
  type->read(element, builder.scene.camera);
  if (const std::string fault = camera_fault(builder.scene.camera); !fault.empty()) {
    element.fail(fmt::format("{}: {}", element.title(), fault));
  }
  for (pugi::xml_node film : element.objects("film")) read_film(builder, film);
  element.objects("sampler");  // samples are chosen by the estimators
  element.ignore({"near_clip", "far_clip", "shutter_open", "shutter_close", "focus_distance"});
  element.warn_unused();
}

}  // namespace quartet
