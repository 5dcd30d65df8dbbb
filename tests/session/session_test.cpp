#include "renderer/session/session.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "tests/session/session_cases.h"
#include "tests/trace/test_scenes.h"

namespace quartet {
namespace {

using namespace test;

TEST(SessionThreads, EachKindOfChangeGivesWhatAHeadlessRunDoes) {
  Session session;
  EXPECT_FALSE(session.latest());
  LabRequest request = four_lanes();
  expect_as_headless(session, request);
  {
    SCOPED_TRACE("a threshold");
    request.lanes.settings[1].thresholds[0] *= 0.5f;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("an estimator");
    request.lanes.settings[2] = default_settings(EstimatorId::uniform);
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("a reference, and another");
    request.lanes.settings[2] = default_settings(EstimatorId::oracle);
    request.lanes.reference = grey_reference(0.3f);
    expect_as_headless(session, request);
    request.lanes.reference = grey_reference(0.5f);
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("a mode");
    request.lanes.settings[1].mode = SampleMode::unbiased;
    expect_as_headless(session, request);
    request.lanes.settings[1].mode = SampleMode::reuse;
    expect_as_headless(session, request);
    request.lanes.settings[2] = default_settings(EstimatorId::uniform);
    request.lanes.reference.reset();
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("a lower pass");
    request.lanes.pass = 3;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("a higher pass");
    request.lanes.pass = 9;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("variance");
    request.lanes.variance = true;
    expect_as_headless(session, request);
    // That of replicates, where it is had in another way.
    request.store.settings.sampler = SamplerId::replicated;
    expect_as_headless(session, request);
    request.store.settings.sampler = SamplerId::sobol;
    request.lanes.variance = false;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("lanes");
    request.lanes.settings.pop_back();
    expect_as_headless(session, request);
    request.lanes.settings.push_back(default_settings(EstimatorId::hellinger));
    request.lanes.settings.push_back(default_settings(EstimatorId::uniform));
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("size and seed");
    request.store.settings.width = 31;
    request.store.settings.seed = 7;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("nothing");
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("pass 0");
    request.lanes.pass = 0;
    expect_as_headless(session, request);
  }
}

TEST(SessionThreads, AnOracleWithoutAReferenceIsAnError) {
  Session session;
  LabRequest request = four_lanes();
  request.lanes.settings[1] = default_settings(EstimatorId::oracle);
  session.submit(request);
  EXPECT_TRUE(wait_until([&] { return !session.status().error.empty(); }));
  EXPECT_NE(session.status().error.find("oracle"), std::string::npos) << session.status().error;
  // And the session goes on.
  request.lanes.reference = grey_reference(0.3f);
  expect_as_headless(session, request);
}

std::uint64_t stored_samples(const Session& session) {
  return session.status().stored_samples;
}

void wait_until_idle(const Session& session) {
  EXPECT_TRUE(
      wait_until([&] { return session.status().activity == SessionStatus::Activity::idle; }));
}

TEST(SessionThreads, AThresholdKeepsTheStoreAndACameraChangeEmptiesIt) {
  Session session;
  LabRequest request = four_lanes();
  ASSERT_TRUE(answer(session, request));
  wait_until_idle(session);
  const std::uint64_t stored = stored_samples(session);
  EXPECT_GT(stored, std::uint64_t(width * height * passes));

  request.lanes.settings[0].thresholds = {10.0f, 10.0f, 10.0f};
  ASSERT_TRUE(answer(session, request));
  wait_until_idle(session);
  EXPECT_EQ(stored_samples(session), stored) << "a higher threshold needs nothing new";
  EXPECT_GT(session.status().replay_seconds, 0.0);

  request.store.settings.camera.origin.x += 0.1f;
  request.lanes.pass = 1;
  ASSERT_TRUE(answer(session, request));
  wait_until_idle(session);
  EXPECT_EQ(stored_samples(session), std::uint64_t(width * height));
}

TEST(SessionThreads, SnapshotsComeInOrderAndOnceDoneTheSessionSleeps) {
  std::atomic<int> notified = 0;
  Session session([&] { ++notified; });
  LabRequest request = four_lanes();
  request.lanes.pass = LaneRequest::no_end;
  session.submit(request);
  std::uint64_t last = 0;
  std::uint32_t pass = 0;
  const auto end = Clock::now() + patience;
  while (pass < 5 && Clock::now() < end) {
    if (const auto snapshot = session.latest()) {
      EXPECT_GE(snapshot->number, last);
      EXPECT_GE(snapshot->pass, pass);
      last = snapshot->number;
      pass = snapshot->pass;
    }
  }
  EXPECT_GE(pass, 5u);
  // To stop where it stands, a window asks for the pass that it shows.
  request.lanes.pass = session.latest()->pass;
  expect_as_headless(session, request);
  wait_until_idle(session);
  EXPECT_EQ(session.status().samples_per_second, 0.0);
  const int before = notified;
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(notified, before);
  EXPECT_GT(before, 2);
}

TEST(SessionThreads, WithoutAnEndItSleepsOnceNoLaneWantsASample) {
  Session session;
  LabRequest request = four_lanes();
  request.lanes.pass = LaneRequest::no_end;
  for (LaneSettings& settings : request.lanes.settings) {
    settings.policy.kind = PolicyId::two_level;
  }
  session.submit(request);
  std::shared_ptr<const Snapshot> snapshot;
  EXPECT_TRUE(wait_until([&] {
    snapshot = session.latest();
    return snapshot && snapshot->pass >= 2;
  }));
  wait_until_idle(session);
  ASSERT_EQ(session.status().activity, SessionStatus::Activity::idle);
  snapshot = session.latest();
  for (const LaneSnapshot& lane : snapshot->lanes) {
    EXPECT_EQ(lane.plan.total, 0u);
    EXPECT_GE(lane.history.size(), 2u);
  }
  // It can be woken again, and goes on from there.
  request.lanes.settings[0].policy.kind = PolicyId::vote;
  request.lanes.pass = 6;
  expect_as_headless(session, request);
}

TEST(SessionThreads, AShortMemoryChangesNothing) {
  Session session;
  LabRequest request = four_lanes();
  request.store.memory = 200'000;
  expect_as_headless(session, request);
  request.lanes.settings[3].thresholds[0] *= 0.5f;
  expect_as_headless(session, request);
  EXPECT_TRUE(session.status().partial);
}

TEST(SessionThreads, AnErrorIsReportedAndTheSessionLivesOn) {
  Session session;
  LabRequest request = four_lanes();
  ASSERT_TRUE(answer(session, request));
  const auto before = session.latest();

  LabRequest impossible = request;
  // More pixels than there are addresses for.
  impossible.store.settings.width = impossible.store.settings.height = 1 << 30;
  session.submit(impossible);
  EXPECT_TRUE(wait_until([&] { return !session.status().error.empty(); }));
  EXPECT_FALSE(session.status().error.empty());
  EXPECT_EQ(session.latest(), before);

  LabRequest without_lanes = request;
  without_lanes.lanes.settings.clear();
  session.submit(without_lanes);
  EXPECT_TRUE(wait_until([&] { return session.status().error == "no lane to render"; }));
  EXPECT_EQ(session.status().error, "no lane to render");

  expect_as_headless(session, request);
  wait_until_idle(session);
  EXPECT_EQ(session.status().error, "");
}

/// A closed white room in so many pixels that a pass takes seconds.
LabRequest long_pass() {
  Scene room;
  Sphere walls;
  walls.radius = 10.0f;
  walls.flip_normals = true;
  test::add_shape(room, walls, test::diffuse(1.0f));
  LabRequest request;
  request.store.scene = std::make_shared<const TraceScene>(std::move(room));
  request.store.settings.camera = test::pinhole({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 60.0f);
  request.store.settings.width = 1600;
  request.store.settings.height = 1200;
  request.lanes.settings = {default_settings(EstimatorId::kl)};
  return request;
}

TEST(SessionThreads, ClosingEndsThePassUnderWay) {
  std::atomic<const Session*> asked = nullptr;
  std::atomic<bool> shown = false;
  auto session = std::make_unique<Session>([&] {
    if (const Session* open = asked; open && open->latest()) {
      shown = true;
    }
  });
  asked = session.get();
  session->submit(long_pass());
  ASSERT_TRUE(
      wait_until([&] { return session->status().activity == SessionStatus::Activity::tracing; }));
  ASSERT_FALSE(session->latest()) << "the pass was over before it could be ended";
  session.reset();
  EXPECT_FALSE(shown) << "the pass was traced to its end";
}

TEST(SessionThreads, ClosesAtAnyMoment) {
  const LabRequest request = four_lanes();
  for (int moment = 0; moment < 30; ++moment) {
    std::shared_ptr<const Snapshot> kept;
    {
      Session session;
      session.submit(request);
      std::this_thread::sleep_for(std::chrono::microseconds(500 * moment));
      kept = session.latest();
    }
    // A snapshot outlives its session.
    EXPECT_TRUE(!kept || kept->lanes.size() == request.lanes.settings.size());
  }
}

}  // namespace
}  // namespace quartet
