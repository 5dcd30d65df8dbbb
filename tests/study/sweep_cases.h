#pragma once

#include "renderer/study/sweep_points.h"

namespace quartet::test {

/// After a pass with this cost and error; 20 rays a sample.
inline Measurement swept(std::uint32_t pass, double seconds, double spp, double error,
                         double energy = 0.0) {
  Measurement measurement;
  measurement.record.pass = pass;
  measurement.record.seconds = seconds;
  measurement.mean_spp = spp;
  measurement.mean_rays = 20.0 * spp;
  measurement.values = {error};
  measurement.energy = energy;
  return measurement;
}

/// Of kl and its twin at their default thresholds, and of the clamp: two seeds, three passes, no
/// two numbers alike. In MSE, of which the parts are made up.
inline SweepPlan hand_plan() {
  SweepPlan plan;
  plan.lane_settings = {default_settings(EstimatorId::kl),
                        default_settings(EstimatorId::uniform_clamp)};
  plan.thresholds = 1;
  plan.low = plan.high = 1.0;
  plan.twins = Twins::at_all;
  plan.seeds = 2;
  plan.metrics = {MetricId::mse};
  return plan;
}

inline SweepResult hand_result() {
  SweepResult result;
  result.first_seed = 40;
  const std::vector<SweepLane> lanes = sweep_lanes(hand_plan());
  for (const std::uint64_t seed : {40, 41}) {
    const double late = seed == 40 ? 0.0 : 1.0;
    SweepRun kl{.lane = lanes[0], .seed = seed};
    kl.way = {swept(1, 1.0 + late, 2.0, 0.5 + 0.1 * late, -0.02),
              swept(2, 2.0 + late, 4.0, 0.3 + 0.1 * late, -0.04)};
    kl.end = swept(3, 3.0 + late, 6.0 + 2.0 * late, 0.2 + 0.2 * late, -0.06 + 0.02 * late);
    SweepRun twin{.lane = lanes[1], .seed = seed};
    twin.way = {swept(1, 2.0, 4.0, 0.6)};
    twin.end = swept(std::uint32_t(2 + late), 5.0, 10.0, 0.4, 0.01);
    SweepRun clamp{.lane = lanes[2], .seed = seed};
    clamp.end = swept(3, 1.5, 3.0, 0.9, -0.1);
    result.runs.insert(result.runs.end(), {kl, twin, clamp});
    // 1.6 / spp, and half as much more with the other seed.
    const double noise = 1.6 + 0.8 * late;
    result.uniform.push_back({swept(1, 0.5, 1.0, noise), swept(4, 2.0, 4.0, noise / 4.0),
                              swept(16, 8.0, 16.0, noise / 16.0)});
  }
  result.parts = {{{{1, {0.1, 0.45}}, {2, {0.05, 0.3}}}, {0.2, 0.1}},
                  {{{1, {0.01, 0.59}}}, {-0.01, 0.41}},
                  {{}, {0.8, 0.1}}};
  result.uniform_parts.way = {{1, {0.02, 1.98}}, {4, {0.01, 0.49}}, {16, {-0.001, 0.126}}};
  return result;
}

}  // namespace quartet::test
