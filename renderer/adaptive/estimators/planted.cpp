#include <algorithm>

#include "renderer/adaptive/estimators/each_pixel.h"
#include "renderer/adaptive/estimators/estimator_rows.h"
#include "renderer/base/math/lot.h"

// Mistakes made on purpose: a study that does not find them finds nothing.

namespace quartet {
namespace {

void draw_lots(const EstimatorInput& input, std::span<float> error) {
  each_judged_pixel(input, error, [](std::size_t i, std::uint32_t) { return lot(i, 0); });
}

void never_end(const EstimatorInput& /*input*/, std::span<float> error) {
  std::ranges::fill(error, float(not_judged));
}

}  // namespace

constexpr Estimator lottery_estimator{.key = EstimatorId::lottery,
                                      .id = "lottery",
                                      .label = "lottery",
                                      .unit = "",
                                      .source = "some pixels, drawn by lot, get all they may",
                                      .threshold_source = "half of the pixels",
                                      .channels = 1,
                                      .default_thresholds = {0.5f, 0.0f, 0.0f},
                                      .estimate = draw_lots,
                                      .default_policy = PolicyId::batch,
                                      .control = true};

constexpr Estimator endless_estimator{.key = EstimatorId::endless,
                                      .id = "endless",
                                      .label = "endless",
                                      .unit = "",
                                      .source = "never done with a pixel",
                                      .threshold_source = "",
                                      .channels = 1,
                                      .default_thresholds = {1.0f, 0.0f, 0.0f},
                                      .estimate = never_end,
                                      .default_policy = PolicyId::batch,
                                      .control = true};

}  // namespace quartet
