// A session with ground truth: the errors of its lanes, pass by pass, and the lane of uniform
// sampling that they are compared with.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "renderer/measure/metrics.h"
#include "renderer/session/baseline.h"
#include "tests/session/session_cases.h"
#include "tests/session/true_errors.h"

namespace quartet {
namespace {

using namespace test;

std::shared_ptr<const RadianceImage> picture_of(float level, int w = width, int h = height) {
  return std::make_shared<const RadianceImage>(w, h, glm::vec3(level));
}

/// What a lab without a session says of the errors after each of so many passes.
std::vector<std::vector<double>> headless_errors(const LabRequest& request,
                                                 std::span<const LaneSettings> lane_settings,
                                                 std::uint32_t passes) {
  LabOptions options;
  options.threads = 1;
  Lab lab(sample_source(request.store.scene, request.store.settings), request.store.settings.width,
          request.store.settings.height, lane_settings, options);
  std::vector<std::vector<double>> errors(lane_settings.size());
  while (lab.pass() < passes) {
    lab.run_pass();
    for (std::size_t i = 0; i < errors.size(); ++i) {
      errors[i].push_back(metric(request.lanes.metric)
                              .compute(lab.lanes()[i].film().image(), *request.lanes.reference));
    }
  }
  return errors;
}

/// Uniform sampling as far as the dearest lane, with the errors of a run alone where it has any.
void expect_baseline(const Snapshot& snapshot, const LabRequest& request) {
  const LaneSnapshot& baseline = *snapshot.baseline;
  const LaneSettings uniform = default_settings(EstimatorId::uniform);
  EXPECT_EQ(baseline.settings, uniform);
  const auto alone =
      headless_errors(request, std::span(&uniform, 1), baseline.history.back().pass).front();
  std::vector<PassRecord> ends;
  for (const LaneSnapshot& lane : snapshot.lanes) {
    ends.push_back(lane.history.back());
  }
  for (const PassRecord& record : baseline.history) {
    EXPECT_EQ(is_enough(record, ends), &record == &baseline.history.back()) << "no further";
  }
  for (const PassRecord& record : baseline.history) {
    EXPECT_EQ(record.samples, std::uint64_t(record.pass) * snapshot.pixels());
    EXPECT_EQ(record.truth.error, alone[record.pass - 1]) << "each pass is measured";
  }
}

void expect_errors(Session& session, const LabRequest& request) {
  const auto snapshot = answer(session, request);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->reference, request.lanes.reference);
  EXPECT_EQ(snapshot->metric, request.lanes.metric);
  const auto errors = headless_errors(request, request.lanes.settings, request.lanes.pass);
  ASSERT_EQ(snapshot->lanes.size(), request.lanes.settings.size());
  ASSERT_TRUE(snapshot->baseline);
  for (std::size_t i = 0; i < snapshot->lanes.size(); ++i) {
    EXPECT_EQ(true_errors(snapshot->lanes[i]), errors[i]) << "lane " << i + 1;
  }
  expect_baseline(*snapshot, request);
  expect_same(*snapshot, headless(request));
}

TEST(SessionThreads, ErrorsFollowEachKindOfChange) {
  Session session;
  LabRequest request = four_lanes();
  ASSERT_TRUE(answer(session, request));
  EXPECT_FALSE(session.latest()->baseline);
  EXPECT_TRUE(std::isnan(session.latest()->lanes[0].history.back().truth.error));
  {
    SCOPED_TRACE("a reference for passes that have been run");
    request.lanes.reference = picture_of(0.5f);
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("a threshold");
    request.lanes.settings[1].thresholds[0] *= 0.5f;
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("another metric");
    request.lanes.metric = MetricId::rmse;
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("another reference");
    request.lanes.reference = picture_of(0.25f);
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("a lower pass and a higher one");
    request.lanes.pass = 3;
    expect_errors(session, request);
    request.lanes.pass = 10;
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("lanes");
    request.lanes.settings.pop_back();
    expect_errors(session, request);
    request.lanes.settings.push_back(default_settings(EstimatorId::chi2));
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("seed");
    request.store.settings.seed = 7;
    expect_errors(session, request);
  }
  {
    SCOPED_TRACE("none");
    request.lanes.reference.reset();
    expect_as_headless(session, request);
    EXPECT_FALSE(session.latest()->baseline);
    EXPECT_FALSE(session.latest()->reference);
    EXPECT_TRUE(std::isnan(session.latest()->lanes[0].history.front().truth.error));
  }
}

TEST(SessionThreads, ErrorsAreRightAfterManyChangesThatWereNotWaitedFor) {
  Session session;
  LabRequest request = four_lanes();
  request.lanes.reference = picture_of(0.5f);
  const LabRequest first = request;
  ASSERT_TRUE(answer(session, request));
  for (int i = 0; i < 60; ++i) {
    request.lanes.settings[std::size_t(i) % 4].thresholds[0] *= i % 2 == 0 ? 0.9f : 1.1f;
    request.lanes.metric = i % 5 == 0 ? MetricId::mse : MetricId::relmse;
    session.submit(request);
    std::this_thread::sleep_for(std::chrono::microseconds(300 * (i % 7)));
    // Back to what is shown already, with lanes that have begun anew.
    session.submit(first);
  }
  expect_errors(session, first);
  LabRequest further = first;
  further.lanes.pass = passes + 2;
  expect_errors(session, further);
}

TEST(SessionThreads, AReferenceOfAnotherSizeIsRefused) {
  Session session;
  LabRequest request = four_lanes();
  request.lanes.reference = picture_of(0.5f, width + 1, height);
  session.submit(request);
  EXPECT_TRUE(wait_until([&] { return !session.status().error.empty(); }));
  EXPECT_EQ(session.status().error, "the reference has 49 × 27 pixels, the pictures 48 × 27");
  request.lanes.reference = picture_of(0.5f);
  expect_errors(session, request);
}

TEST(SessionThreads, WithoutAnEndTheBaselineAloneKeepsNobodyAwake) {
  Session session;
  LabRequest request = four_lanes();
  request.lanes.pass = LaneRequest::no_end;
  request.lanes.reference = picture_of(0.5f);
  for (LaneSettings& settings : request.lanes.settings) {
    settings.policy.kind = PolicyId::two_level;
  }
  session.submit(request);
  EXPECT_TRUE(wait_until(
      [&] { return session.latest() && session.latest()->pass >= 2 && !session.busy(); }));
  EXPECT_FALSE(session.busy());
  EXPECT_GE(session.latest()->pass, 2u);
}

TEST(Baseline, IsEnoughWhereItHasTakenAsMuchAsEachLane) {
  const auto record = [](std::uint64_t samples, std::uint64_t rays, double seconds) {
    PassRecord made;
    made.samples = samples;
    made.rays = rays;
    made.seconds = seconds;
    return made;
  };
  const std::array lanes{record(100, 300, 1.0), record(80, 400, 0.5)};
  EXPECT_TRUE(is_enough(record(100, 400, 1.0), lanes));
  EXPECT_FALSE(is_enough(record(99, 400, 1.0), lanes));
  EXPECT_FALSE(is_enough(record(100, 399, 1.0), lanes));
  EXPECT_FALSE(is_enough(record(124, 500, 0.9), lanes));
  EXPECT_TRUE(is_enough(record(125, 500, 0.9), lanes)) << "a lane that was held up";
}

}  // namespace
}  // namespace quartet
