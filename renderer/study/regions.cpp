#include "renderer/study/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr float square_side = 70.0f;  // of the checkerboard, from the wall's lower left corner

constexpr std::array region_table{
    Region{RegionId::ceiling, "ceiling", "ceiling", "white, lit by nothing directly"},
    Region{RegionId::bright_squares, "bright-squares", "back wall, bright squares",
           "without their borders"},
    Region{RegionId::dark_squares, "dark-squares", "back wall, dark squares",
           "without their borders"},
    Region{RegionId::bright_borders, "bright-borders", "borders, bright side",
           "pixels of bright squares whose 3x3 neighbourhood meets a dark one"},
    Region{RegionId::dark_borders, "dark-borders", "borders, dark side",
           "pixels of dark squares whose 3x3 neighbourhood meets a bright one"},
    Region{RegionId::glass_ball, "glass-ball", "glass ball", ""},
    Region{RegionId::mirror_ball, "mirror-ball", "mirror ball", ""},
    Region{RegionId::ball_shadow, "ball-shadow", "shadow and caustic of the glass ball",
           "floor from which the ball hides the centre of the ceiling's light"},
    Region{RegionId::floor, "floor", "other floor", ""},
    Region{RegionId::box_front, "box-front", "front of the box", "its upright faces"},
    Region{RegionId::green_wall, "green-wall", "green wall", ""},
    Region{RegionId::red_wall, "red-wall", "red wall", ""},
    Region{RegionId::margin, "margin", "black margin", "where a ray meets nothing"},
    Region{RegionId::outlines, "outlines", "outlines",
           "pixels whose 3x3 neighbourhood meets two shapes or faces"},
    Region{RegionId::rest, "rest", "rest", "top of the box, light"},
};

/// What the ray through a pixel's centre meets.
struct FirstHit {
  RegionId region = RegionId::margin;
  int shape = -1;      // -1: none
  glm::ivec3 face{0};  // of the box: its normal, rounded
  bool operator==(const FirstHit&) const = default;
};

class Classifier {
 public:
  Classifier(const TraceScene& scene, const RenderSettings& settings)
      : scene_(scene), camera_(settings.camera, settings.width, settings.height) {
    for (const auto& [id, shape] : {std::pair{"ceiling", &ceiling_},
                                    {"back-wall", &back_wall_},
                                    {"glass-ball", &glass_},
                                    {"mirror-ball", &mirror_},
                                    {"floor", &floor_},
                                    {"box", &box_},
                                    {"green-wall", &green_},
                                    {"red-wall", &red_},
                                    {"light", &light_}}) {
      *shape = find(id);
    }
  }

  FirstHit at(int x, int y) const {
    constexpr Sampler::Draws center{0.5f, 0.5f, 0.5f, 0.5f};
    const Ray ray = camera_.ray(x, y, center);
    Hit hit;
    if (!scene_.accel().closest_hit(ray, hit)) {
      return {};
    }
    const Surface surface = scene_.surface(ray, hit);
    FirstHit first{region_of(surface), int(hit.shape), glm::ivec3(0)};
    if (first.shape == box_) {
      constexpr float steps = 16.0f;
      first.face = glm::ivec3(glm::round(steps * surface.normal));
    }
    return first;
  }

 private:
  int find(std::string_view id) const {
    const std::vector<Shape>& shapes = scene_.scene().shapes;
    const auto found = std::ranges::find(shapes, id, &Shape::id);
    if (found == shapes.end()) {
      throw std::runtime_error(
          fmt::format("scene '{}' has no shape '{}': the report's regions are those of "
                      "cornell-checker",
                      scene_.scene().name, id));
    }
    return int(found - shapes.begin());
  }

  RegionId region_of(const Surface& surface) const {
    const auto shape = int(surface.shape);
    if (shape == back_wall_) {
      const glm::vec3 p = surface.position / square_side;
      const bool bright = (int(std::floor(p.x)) + int(std::floor(p.y))) % 2 != 0;
      return bright ? RegionId::bright_squares : RegionId::dark_squares;
    }
    if (shape == floor_) {
      return behind_ball(surface) ? RegionId::ball_shadow : RegionId::floor;
    }
    if (shape == box_) {
      return std::abs(surface.normal.y) < 0.5f ? RegionId::box_front : RegionId::rest;
    }
    return shape == ceiling_  ? RegionId::ceiling
           : shape == glass_  ? RegionId::glass_ball
           : shape == mirror_ ? RegionId::mirror_ball
           : shape == green_  ? RegionId::green_wall
           : shape == red_    ? RegionId::red_wall
                              : RegionId::rest;
  }

  /// Whether the first thing between a point of the floor and the centre of the ceiling's light is
  /// the glass ball.
  bool behind_ball(const Surface& surface) const {
    const Mesh& light = std::get<Mesh>(scene_.scene().shapes[std::size_t(light_)].geometry);
    glm::vec3 center(0.0f);
    for (const glm::vec3& corner : light.positions) {
      center += corner / float(light.positions.size());
    }
    const glm::vec3 direction = glm::normalize(center - surface.position);
    Hit hit;
    return scene_.accel().closest_hit({offset_origin(surface, direction), direction}, hit) &&
           int(hit.shape) == glass_;
  }

  const TraceScene& scene_;
  CameraRays camera_;
  int ceiling_, back_wall_, glass_, mirror_, floor_, box_, green_, red_, light_;
};

/// Whether two hits of neighbours are of the same thing, up to the checkerboard and the shadow.
bool same_thing(const FirstHit& a, const FirstHit& b) {
  return a.shape == b.shape && a.face == b.face;
}

}  // namespace

std::span<const Region> regions() {
  return region_table;
}

const Region& region(RegionId key) {
  return row_of(regions(), key);
}

std::vector<RegionId> find_regions(const TraceScene& scene, const RenderSettings& settings) {
  const Classifier classifier(scene, settings);
  const int width = settings.width;
  const int height = settings.height;
  std::vector<FirstHit> hits;
  hits.reserve(std::size_t(width) * std::size_t(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      hits.push_back(classifier.at(x, y));
    }
  }
  std::vector<RegionId> found;
  found.reserve(hits.size());
  const auto hit_at = [&](int x, int y) -> const FirstHit& {
    return hits[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const FirstHit& here = hit_at(x, y);
      RegionId region = here.region;
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
          const FirstHit& there = hit_at(u, v);
          if (!same_thing(here, there)) {
            region = RegionId::outlines;
          } else if (there.region != here.region && region != RegionId::outlines) {
            region = here.region == RegionId::bright_squares ? RegionId::bright_borders
                     : here.region == RegionId::dark_squares ? RegionId::dark_borders
                                                             : region;
          }
        }
      }
      found.push_back(region);
    }
  }
  return found;
}

}  // namespace quartet
