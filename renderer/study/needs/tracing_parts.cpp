#include <fmt/format.h>

#include <array>
#include <limits>

#include "renderer/study/needs/part_rows.h"

namespace quartet {
namespace {

constexpr int endless = std::numeric_limits<int>::max();
/// Of paths that nothing else would end.
constexpr int deepest_without_roulette = 64;
/// At less, roulette never has a say: a path's first three segments are out of its reach.
constexpr int least_depth_of_roulette = 4;

constexpr std::array tried_depths{1, 2, 3, 4, 5, 6, 8, 12, 16, 24, 32};

std::vector<Simplification> depths_of(const Model& whole) {
  std::vector<Simplification> found;
  for (const int depth : tried_depths) {
    if (depth < whole.scene.max_depth) {
      found.push_back({PartId::depth, fmt::format("depth {}", depth),
                       [depth](Model& model) { model.scene.max_depth = depth; }});
    }
  }
  return found;
}

std::vector<Simplification> next_event_of(const Model& whole) {
  if (whole.integrator != IntegratorId::mis ||
      !why_not(whole.scene, IntegratorId::kajiya).empty()) {
    return {};
  }
  return {{PartId::next_event, "no next-event estimation",
           [](Model& model) { model.integrator = IntegratorId::kajiya; }}};
}

std::vector<Simplification> roulette_of(const Model& whole) {
  const int depth = whole.scene.max_depth;
  if (!whole.roulette || depth < least_depth_of_roulette) {
    return {};
  }
  const bool cut = depth > deepest_without_roulette;
  return {{PartId::roulette,
           cut ? fmt::format("no Russian roulette, depth {}", deepest_without_roulette)
               : std::string("no Russian roulette"),
           [](Model& model) {
             model.roulette = false;
             model.scene.max_depth = std::min(model.scene.max_depth, deepest_without_roulette);
           }}};
}

std::vector<Simplification> lens_of(const Model& whole) {
  if (!(whole.scene.camera.aperture_radius > 0.0f)) {
    return {};
  }
  return {{PartId::lens, "lens → pinhole", [](Model& model) {
             model.scene.camera.aperture_radius = Camera().aperture_radius;
             model.scene.camera.focus_distance = Camera().focus_distance;
           }}};
}

}  // namespace

constexpr Part depth_part{.key = PartId::depth,
                          .id = "depth",
                          .label = "depth",
                          .description = "paths of at most 1, 2, 3, … segments; 2 is direct light",
                          .same_mean = false,
                          .can_be_left = true,
                          .exclusive = true,
                          .of = depths_of};

constexpr Part next_event_part{.key = PartId::next_event,
                               .id = "next-event",
                               .label = "next-event estimation",
                               .description = "light is found by chance alone (kajiya)",
                               .same_mean = true,
                               .can_be_left = true,
                               .exclusive = false,
                               .of = next_event_of};

constexpr Part roulette_part{.key = PartId::roulette,
                             .id = "roulette",
                             .label = "Russian roulette",
                             .description = "paths go on to their depth, 64 segments at most",
                             .same_mean = true,
                             .can_be_left = false,
                             .exclusive = false,
                             .of = roulette_of};

constexpr Part lens_part{.key = PartId::lens,
                         .id = "lens",
                         .label = "lens",
                         .description = "a pinhole",
                         .same_mean = false,
                         .can_be_left = true,
                         .exclusive = false,
                         .of = lens_of};

}  // namespace quartet
