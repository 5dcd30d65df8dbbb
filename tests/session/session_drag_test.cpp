#include "renderer/session/session.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "tests/session/session_cases.h"

namespace quartet {
namespace {

using namespace test;

TEST(SessionThreads, EveryStepOfACameraDragShowsAPicture) {
  Session session;
  LabRequest request = four_lanes();
  std::uint64_t number = 0;
  std::uint64_t pictures = 0;
  std::shared_ptr<const Snapshot> last;
  for (int step = 0; step < 300; ++step) {
    request.store.settings.camera.origin.x += 0.001f;
    number = session.submit(request);
    const auto snapshot = session.latest();
    pictures += snapshot && snapshot != last;
    last = snapshot;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_GE(pictures, 3u) << "while it was dragged";
  const auto settled = wait_for(session, number, request.lanes.pass);
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
  request.store.settings.width *= 4;
  request.store.settings.height *= 4;
  ASSERT_TRUE(answer(session, request));
  const float threshold = request.lanes.settings[1].thresholds[0];
  // Into what is not yet traced.
  drag(session, request, 1000, [&](LabRequest& dragged, int step) {
    dragged.lanes.settings[1].thresholds[0] = threshold * std::pow(0.997f, float(step % 1500));
  });
  request.lanes.pass = 6;
  expect_as_headless(session, request);
}

TEST(SessionThreads, HundredsOfRapidChangesOfAllKindsEndRight) {
  Session session;
  LabRequest request = four_lanes();
  request.lanes.reference = grey_reference(0.3f);
  drag(session, request, 600, [](LabRequest& changed, int step) {
    const auto lane = std::size_t(step) % changed.lanes.settings.size();
    switch (step % 9) {
      case 0:
        changed.lanes.pass = 1 + std::uint32_t(step) % 11;
        break;
      case 1:
        changed.lanes.settings[lane].max_spp = 3 + std::uint32_t(step) % 17;
        break;
      case 2:
        changed.lanes.settings[lane] =
            default_settings(estimators()[std::size_t(step) % estimators().size()].key);
        break;
      case 3:
        if (step % 4 == 0) {
          changed.store.settings.seed = std::uint64_t(step);
        }
        break;
      case 4:
        changed.lanes.variance = step % 3 == 0;
        break;
      case 5:
        changed.lanes.settings.resize(1 + std::size_t(step) % 5,
                                      default_settings(EstimatorId::chi2));
        break;
      case 6:
        changed.lanes.settings[lane].mode =
            sample_modes()[std::size_t(step) % sample_modes().size()].key;
        break;
      case 7:
        changed.lanes.reference = grey_reference(0.1f * float(step % 4));
        break;
      default:
        changed.lanes.settings[lane].thresholds[0] *= 0.9f;
    }
  });
  expect_as_headless(session, request);
}

}  // namespace
}  // namespace quartet
