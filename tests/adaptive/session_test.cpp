#include "renderer/adaptive/session.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "renderer/adaptive/lab.h"
#include "renderer/scene/load_scene.h"
#include "tests/trace/test_scenes.h"

namespace quartet {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int width = 48;
constexpr int height = 27;
constexpr std::uint32_t frames = 8;
// Far beyond what anything takes, even under a sanitizer on a busy machine: a deadlock fails.
constexpr auto patience = std::chrono::seconds(120);

std::shared_ptr<const TraceScene> cornell_checker() {
  static const auto scene =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  return scene;
}

LabRequest four_lanes() {
  LabRequest request;
  request.scene = cornell_checker();
  request.settings = default_settings(request.scene->scene());
  request.settings.width = width;
  request.settings.height = height;
  request.frame = frames;
  request.threads = 2;
  for (const EstimatorId id :
       {EstimatorId::contrast, EstimatorId::kl, EstimatorId::chi2, EstimatorId::hellinger}) {
    request.policies.push_back(default_policy(id));
  }
  return request;
}

/// What answers the request with this number, at this frame; null if nothing does.
std::shared_ptr<const Snapshot> wait_for(const Session& session, std::uint64_t number,
                                         std::uint32_t frame) {
  const auto end = Clock::now() + patience;
  while (Clock::now() < end) {
    auto snapshot = session.latest();
    if (snapshot && snapshot->request >= number && snapshot->frame == frame) {
      return snapshot;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return nullptr;
}

std::shared_ptr<const Snapshot> answer(Session& session, const LabRequest& request) {
  const std::uint64_t number = session.submit(request);
  return wait_for(session, number, request.frame);
}

Snapshot headless(const LabRequest& request) {
  LabOptions options;
  options.threads = 1;
  options.statistics.variance = request.variance;
  Lab lab(sample_source(request.scene, request.settings), request.settings.width,
          request.settings.height, request.policies, options);
  while (lab.frame() < request.frame) {
    lab.run_frame();
  }
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  return snapshot;
}

/// Equal to the bit in all but the seconds.
void expect_same(const Snapshot& a, const Snapshot& b) {
  ASSERT_EQ(a.lanes.size(), b.lanes.size());
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  for (std::size_t i = 0; i < a.lanes.size(); ++i) {
    const LaneSnapshot& x = a.lanes[i];
    const LaneSnapshot& y = b.lanes[i];
    EXPECT_EQ(x.policy, y.policy);
    EXPECT_EQ(x.mean, y.mean);
    EXPECT_EQ(x.taken, y.taken);
    EXPECT_EQ(x.rejected, y.rejected);
    EXPECT_EQ(x.error, y.error);
    EXPECT_EQ(x.variance, y.variance);
    EXPECT_EQ(x.plan.wanted, y.plan.wanted);
    EXPECT_EQ(x.plan.total, y.plan.total);
    EXPECT_EQ(x.plan.refined, y.plan.refined);
    ASSERT_EQ(x.history.size(), y.history.size());
    for (std::size_t f = 0; f < x.history.size(); ++f) {
      EXPECT_EQ(x.history[f].frame, y.history[f].frame);
      EXPECT_EQ(x.history[f].samples, y.history[f].samples);
      EXPECT_EQ(x.history[f].max_spp, y.history[f].max_spp);
      EXPECT_EQ(x.history[f].refined, y.history[f].refined);
    }
  }
}

void expect_as_headless(Session& session, const LabRequest& request) {
  const auto snapshot = answer(session, request);
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->scene, request.scene);
  EXPECT_EQ(snapshot->settings, request.settings);
  expect_same(*snapshot, headless(request));
}

TEST(SessionThreads, EachKindOfChangeGivesWhatAHeadlessRunDoes) {
  Session session;
  EXPECT_FALSE(session.latest());
  LabRequest request = four_lanes();
  expect_as_headless(session, request);
  {
    SCOPED_TRACE("a threshold");
    request.policies[1].thresholds[0] *= 0.5f;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("an estimator");
    request.policies[2] = default_policy(EstimatorId::uniform);
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("a lower frame");
    request.frame = 3;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("a higher frame");
    request.frame = 9;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("variance");
    request.variance = true;
    expect_as_headless(session, request);
    request.variance = false;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("lanes");
    request.policies.pop_back();
    expect_as_headless(session, request);
    request.policies.push_back(default_policy(EstimatorId::hellinger));
    request.policies.push_back(default_policy(EstimatorId::uniform));
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("size and seed");
    request.settings.width = 31;
    request.settings.seed = 7;
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("nothing");
    expect_as_headless(session, request);
  }
  {
    SCOPED_TRACE("frame 0");
    request.frame = 0;
    expect_as_headless(session, request);
  }
}

std::uint64_t stored_samples(const Session& session) {
  return session.status().stored_samples;
}

void wait_until_idle(const Session& session) {
  const auto end = Clock::now() + patience;
  while (session.status().activity != SessionStatus::Activity::idle && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(SessionThreads, APolicyChangeKeepsTheStoreAndACameraChangeEmptiesIt) {
  Session session;
  LabRequest request = four_lanes();
  ASSERT_TRUE(answer(session, request));
  wait_until_idle(session);
  const std::uint64_t stored = stored_samples(session);
  EXPECT_GT(stored, std::uint64_t(width * height * frames));

  request.policies[0].thresholds = {10.0f, 10.0f, 10.0f};
  ASSERT_TRUE(answer(session, request));
  wait_until_idle(session);
  EXPECT_EQ(stored_samples(session), stored) << "a higher threshold needs nothing new";
  EXPECT_GT(session.status().replay_seconds, 0.0);

  request.settings.camera.origin.x += 0.1f;
  request.frame = 1;
  ASSERT_TRUE(answer(session, request));
  wait_until_idle(session);
  EXPECT_EQ(stored_samples(session), std::uint64_t(width * height));
}

TEST(SessionThreads, SnapshotsComeInOrderAndOnceDoneTheSessionSleeps) {
  std::atomic<int> notified = 0;
  Session session([&] { ++notified; });
  LabRequest request = four_lanes();
  request.frame = LabRequest::no_end;
  session.submit(request);
  std::uint64_t last = 0;
  std::uint32_t frame = 0;
  const auto end = Clock::now() + patience;
  while (frame < 5 && Clock::now() < end) {
    if (const auto snapshot = session.latest()) {
      EXPECT_GE(snapshot->number, last);
      EXPECT_GE(snapshot->frame, frame);
      last = snapshot->number;
      frame = snapshot->frame;
    }
  }
  EXPECT_GE(frame, 5u);
  // To stop where it stands, a window asks for the frame that it shows.
  request.frame = session.latest()->frame;
  expect_as_headless(session, request);
  wait_until_idle(session);
  EXPECT_EQ(session.status().samples_per_second, 0.0);
  const int before = notified;
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(notified, before);
  EXPECT_GT(before, 2);
}

TEST(SessionThreads, EveryStepOfACameraDragShowsAPicture) {
  Session session;
  LabRequest request = four_lanes();
  std::uint64_t number = 0;
  std::uint64_t pictures = 0;
  std::shared_ptr<const Snapshot> last;
  for (int step = 0; step < 300; ++step) {
    request.settings.camera.origin.x += 0.001f;
    number = session.submit(request);
    const auto snapshot = session.latest();
    pictures += snapshot && snapshot != last;
    last = snapshot;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GE(pictures, 3u) << "while it was dragged";
  const auto settled = wait_for(session, number, request.frame);
  ASSERT_TRUE(settled);
  expect_same(*settled, headless(request));
}

/// Submits faster than anything can be answered, at least `steps` times and until some snapshots
/// have come meanwhile.
template <class Change>
void drag(Session& session, LabRequest& request, int steps, Change change) {
  constexpr int wanted = 5;
  int pictures = 0;
  std::uint64_t last = 0;
  const auto end = Clock::now() + patience;
  for (int step = 0; step < steps || pictures < wanted; ++step) {
    ASSERT_LT(Clock::now(), end) << "no more than " << pictures << " pictures";
    change(request, step);
    session.submit(request);
    if (const auto snapshot = session.latest(); snapshot && snapshot->number != last) {
      ++pictures;
      last = snapshot->number;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

TEST(SessionThreads, AFastDragOfAThresholdShowsPicturesAndEndsRight) {
  Session session;
  LabRequest request = four_lanes();
  request.settings.width *= 4;
  request.settings.height *= 4;
  ASSERT_TRUE(answer(session, request));
  const float threshold = request.policies[1].thresholds[0];
  // Into what is not yet traced.
  drag(session, request, 1000, [&](LabRequest& dragged, int step) {
    dragged.policies[1].thresholds[0] = threshold * std::pow(0.997f, float(step % 1500));
  });
  request.frame = 6;
  expect_as_headless(session, request);
}

TEST(SessionThreads, HundredsOfRapidChangesOfAllKindsEndRight) {
  Session session;
  LabRequest request = four_lanes();
  drag(session, request, 600, [](LabRequest& changed, int step) {
    const auto lane = std::size_t(step) % changed.policies.size();
    switch (step % 7) {
      case 0:
        changed.frame = 1 + std::uint32_t(step) % 11;
        break;
      case 1:
        changed.policies[lane].max_spp = 3 + std::uint32_t(step) % 17;
        break;
      case 2:
        changed.policies[lane] = default_policy(estimators()[std::size_t(step) % 5].key);
        break;
      case 3:
        if (step % 4 == 0) {
          changed.settings.seed = std::uint64_t(step);
        }
        break;
      case 4:
        changed.variance = step % 3 == 0;
        break;
      case 5:
        changed.policies.resize(1 + std::size_t(step) % 5, default_policy(EstimatorId::chi2));
        break;
      default:
        changed.policies[lane].thresholds[0] *= 0.9f;
    }
  });
  expect_as_headless(session, request);
}

TEST(SessionThreads, AShortMemoryChangesNothing) {
  Session session;
  LabRequest request = four_lanes();
  request.memory = 200'000;
  expect_as_headless(session, request);
  request.policies[3].thresholds[0] *= 0.5f;
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
  impossible.settings.width = impossible.settings.height = 1 << 30;
  session.submit(impossible);
  const auto end = Clock::now() + patience;
  while (session.status().error.empty() && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(session.status().error.empty());
  EXPECT_EQ(session.latest(), before);

  LabRequest without_lanes = request;
  without_lanes.policies.clear();
  session.submit(without_lanes);
  while (session.status().error != "no lane to render" && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(session.status().error, "no lane to render");

  expect_as_headless(session, request);
  wait_until_idle(session);
  EXPECT_EQ(session.status().error, "");
}

/// A closed white room: paths end at their longest, and a frame takes minutes.
LabRequest endless_room() {
  Scene room;
  Sphere walls;
  walls.radius = 10.0f;
  walls.flip_normals = true;
  test::add_shape(room, walls, test::diffuse(1.0f));
  LabRequest request;
  request.scene = std::make_shared<const TraceScene>(std::move(room));
  request.settings.camera = test::pinhole({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 60.0f);
  request.settings.width = 400;
  request.settings.height = 300;
  request.settings.max_depth = 20'000;
  request.policies = {default_policy(EstimatorId::kl)};
  return request;
}

TEST(SessionThreads, ClosesWithinTheTimeOfAFewSamples) {
  auto session = std::make_unique<Session>();
  session->submit(endless_room());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto start = Clock::now();
  session.reset();
  // A sample takes a few milliseconds, a frame many minutes.
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
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
    EXPECT_TRUE(!kept || kept->lanes.size() == request.policies.size());
  }
}

}  // namespace
}  // namespace quartet
