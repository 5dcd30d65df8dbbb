#include "renderer/session/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/view/views.h"
#include "tests/session/session_cases.h"

namespace quartet {
namespace {

using namespace test;

std::shared_ptr<const Snapshot> snapshot_of_four() {
  return std::make_shared<const Snapshot>(headless(four_lanes()));
}

std::shared_ptr<const Reference> reference_of(float level) {
  Reference reference;
  reference.image = RadianceImage(width, height, glm::vec3(level));
  reference.halves = {RadianceImage(width, height, glm::vec3(level - 0.1f)),
                      RadianceImage(width, height, glm::vec3(level + 0.1f))};
  reference.spp = 2;
  return std::make_shared<const Reference>(std::move(reference));
}

Evaluation evaluated(EvaluationTask& task, const EvaluationInput& input) {
  const std::uint64_t number = task.submit(input);
  auto latest = task.latest();
  const bool answered = wait_until([&] {
    latest = task.latest();
    return latest->input == number && (latest->output.complete || !input.snapshot);
  });
  EXPECT_TRUE(answered) << "no answer";
  return answered ? latest->output : Evaluation{};
}

TEST(EvaluationThreads, KnowsEveryMetricOfEveryLane) {
  EvaluationTask task(evaluation_work());
  const auto snapshot = snapshot_of_four();
  for (const float level : {0.5f, 0.25f}) {
    const auto reference = reference_of(level);
    const Evaluation evaluation = evaluated(task, {snapshot, reference});
    EXPECT_EQ(evaluation.snapshot, snapshot);
    ASSERT_EQ(evaluation.lanes.size(), 4u);
    for (std::size_t m = 0; m < metrics().size(); ++m) {
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(evaluation.lanes[i][m],
                  metrics()[m].compute(radiance_image(*snapshot, i), reference->image));
      }
      EXPECT_EQ(evaluation.noise_floor[m], reference->noise_floor(metrics()[m].key));
      EXPECT_TRUE(std::isnan(evaluation.baseline[m])) << "this snapshot has none";
    }
  }
}

TEST(EvaluationThreads, WithoutAReferenceItKnowsNothing) {
  EvaluationTask task(evaluation_work());
  EXPECT_TRUE(evaluated(task, {}).lanes.empty());
}

}  // namespace
}  // namespace quartet
