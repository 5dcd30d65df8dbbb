#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>

#include "renderer/adaptive/lab.h"
#include "renderer/scene/load_scene.h"
#include "renderer/session/session.h"
#include "tests/wait_until.h"

namespace quartet::test {

using Clock = std::chrono::steady_clock;

inline constexpr int width = 48;
inline constexpr int height = 27;
inline constexpr std::uint32_t passes = 8;

inline std::shared_ptr<const TraceScene> cornell_checker() {
  static const auto scene =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  return scene;
}

inline LabRequest four_lanes() {
  LabRequest request;
  request.store.scene = cornell_checker();
  request.store.settings = default_settings(request.store.scene->scene());
  request.store.settings.width = width;
  request.store.settings.height = height;
  request.lanes.pass = passes;
  request.store.threads = 2;
  for (const EstimatorId id :
       {EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2, EstimatorId::hellinger}) {
    request.lanes.settings.push_back(default_settings(id));
  }
  return request;
}

/// A truth for estimators that need one.
inline std::shared_ptr<const RadianceImage> grey_reference(float radiance) {
  return std::make_shared<const RadianceImage>(width, height, glm::vec3(radiance));
}

/// What answers the request with this number, at this pass; null if nothing does.
inline std::shared_ptr<const Snapshot> wait_for(const Session& session, std::uint64_t number,
                                                std::uint32_t pass) {
  std::shared_ptr<const Snapshot> snapshot;
  const bool answered = wait_until([&] {
    snapshot = session.latest();
    return snapshot && snapshot->request >= number && snapshot->pass == pass;
  });
  return answered ? snapshot : nullptr;
}

inline std::shared_ptr<const Snapshot> answer(Session& session, const LabRequest& request) {
  const std::uint64_t number = session.submit(request);
  return wait_for(session, number, request.lanes.pass);
}

inline Snapshot headless(const LabRequest& request) {
  LabOptions options;
  options.threads = 1;
  options.statistics.variance = request.lanes.variance;
  options.sampler = request.store.settings.sampler;
  options.reference = request.lanes.reference;
  options.pilot_source = pilot_source(request.store.scene, request.store.settings);
  Lab lab(sample_source(request.store.scene, request.store.settings), request.store.settings.width,
          request.store.settings.height, request.lanes.settings, options);
  while (lab.pass() < request.lanes.pass) {
    lab.run_pass();
  }
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  return snapshot;
}

/// Equal to the bit in all but the seconds.
inline void expect_same(const Snapshot& a, const Snapshot& b) {
  ASSERT_EQ(a.lanes.size(), b.lanes.size());
  EXPECT_EQ(a.pass, b.pass);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  for (std::size_t i = 0; i < a.lanes.size(); ++i) {
    const LaneSnapshot& x = a.lanes[i];
    const LaneSnapshot& y = b.lanes[i];
    EXPECT_EQ(x.settings, y.settings);
    EXPECT_EQ(x.mean, y.mean);
    EXPECT_EQ(x.taken, y.taken);
    EXPECT_EQ(x.rejected, y.rejected);
    EXPECT_EQ(x.error, y.error);
    EXPECT_EQ(x.variance, y.variance);
    EXPECT_EQ(x.plan.wanted, y.plan.wanted);
    EXPECT_EQ(x.plan.total, y.plan.total);
    EXPECT_EQ(x.plan.not_done, y.plan.not_done);
    ASSERT_EQ(x.history.size(), y.history.size());
    for (std::size_t f = 0; f < x.history.size(); ++f) {
      EXPECT_EQ(x.history[f].pass, y.history[f].pass);
      EXPECT_EQ(x.history[f].samples, y.history[f].samples);
      EXPECT_EQ(x.history[f].max_spp, y.history[f].max_spp);
      EXPECT_EQ(x.history[f].not_done, y.history[f].not_done);
    }
  }
}

inline void expect_as_headless(Session& session, const LabRequest& request) {
  const auto snapshot = answer(session, request);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->scene, request.store.scene);
  EXPECT_EQ(snapshot->settings, request.store.settings);
  expect_same(*snapshot, headless(request));
}

}  // namespace quartet::test
