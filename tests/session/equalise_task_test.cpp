#include "renderer/session/equalise_task.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/session/session_cases.h"

namespace quartet {
namespace {

using namespace test;

EqualiseRequest request_for(const CommonBudget& budget) {
  const LabRequest lab = four_lanes();
  EqualiseRequest request;
  request.store = lab.store;
  request.lane_settings = lab.lanes.settings;
  request.budget = budget;
  return request;
}

CommonBudget spp_budget(double spp) {
  CommonBudget budget;
  budget.passes = passes;
  budget.spp = spp;
  return budget;
}

CommonBudget error_budget(double relmse) {
  CommonBudget budget;
  budget.passes = passes;
  budget.error = ErrorTarget{MetricId::relmse, relmse};
  return budget;
}

EqualiseStatus equalised(EqualiseTask& task, const EqualiseRequest& request) {
  const std::uint64_t number = task.submit(request);
  auto latest = task.latest();
  const bool answered = wait_until([&] {
    latest = task.latest();
    return latest->input == number && latest->output.done;
  });
  EXPECT_TRUE(answered) << "no answer";
  return answered ? latest->output : EqualiseStatus{};
}

/// What the session of the window gives with these thresholds is what was asked for.
void expect_equal_spp(const EqualiseRequest& request, const EqualiseStatus& status, double spp) {
  LabRequest lab = four_lanes();
  for (std::size_t i = 0; i < lab.lanes.settings.size(); ++i) {
    lab.lanes.settings[i] = status.calibrations[i].settings;
  }
  const Snapshot snapshot = headless(lab);
  for (std::size_t i = 0; i < snapshot.lanes.size(); ++i) {
    EXPECT_EQ(status.calibrations[i].settings.estimator, request.lane_settings[i].estimator);
    ASSERT_TRUE(status.calibrations[i].met) << status.calibrations[i].reason;
    EXPECT_NEAR(double(snapshot.lanes[i].history.back().samples) / double(snapshot.pixels()), spp,
                0.011 * spp);
  }
}

TEST(EqualiseTaskThreads, FindsThresholdsWithWhichAllLanesTakeTheSameSamples) {
  EqualiseTask task(equalise_work());
  // Contrast cannot take between 8 and 11.67: it is 1 in many windows here, so that they all drop
  // out at once where the thresholds pass 1.
  for (const double spp : {14.0, 12.5}) {
    const EqualiseRequest request = request_for(spp_budget(spp));
    const EqualiseStatus status = equalised(task, request);
    EXPECT_EQ(status.error, "");
    ASSERT_EQ(status.calibrations.size(), 4u);
    expect_equal_spp(request, status, spp);
  }
}

TEST(EqualiseTaskThreads, SaysWhichLaneCannotAndWhy) {
  EqualiseTask task(equalise_work());
  // A pixel has a sample a pass, whatever the thresholds.
  const EqualiseRequest request = request_for(spp_budget(0.5 * passes));
  const EqualiseStatus status = equalised(task, request);
  ASSERT_EQ(status.calibrations.size(), 4u);
  EXPECT_FALSE(status.calibrations[2].met);
  EXPECT_NE(equalise_text(request, status).find("not lane 3: "), std::string::npos)
      << equalise_text(request, status);
}

TEST(EqualiseTaskThreads, AnErrorNeedsAReference) {
  EqualiseTask task(equalise_work());
  EqualiseRequest request = request_for(error_budget(0.1));
  EXPECT_NE(equalised(task, request).error, "");
  request.reference = std::make_shared<const RadianceImage>(width, height, glm::vec3(0.3f));
  const EqualiseStatus status = equalised(task, request);
  EXPECT_EQ(status.error, "");
  EXPECT_EQ(status.calibrations.size(), 4u);
}

TEST(EqualiseTaskThreads, ALaneThatIsBetterThanAskedIsSaidSo) {
  EqualiseTask task(equalise_work());
  EqualiseRequest request = request_for(error_budget(1e6));
  request.reference = std::make_shared<const RadianceImage>(width, height, glm::vec3(0.3f));
  const EqualiseStatus status = equalised(task, request);
  ASSERT_EQ(status.calibrations.size(), 4u);
  const std::string text = equalise_text(request, status);
  EXPECT_EQ(text.find("not lane"), std::string::npos) << text;
  EXPECT_NE(text.find("; lane 2 is already better than asked"), std::string::npos) << text;
}

TEST(EqualiseTaskThreads, IsEndedByTheNextRequest) {
  EqualiseTask task(equalise_work());
  for (int i = 0; i < 10; ++i) {
    task.submit(request_for(spp_budget(10.0 + i)));
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * i));
  }
  EXPECT_TRUE(equalised(task, EqualiseRequest()).calibrations.empty());
}

}  // namespace
}  // namespace quartet
