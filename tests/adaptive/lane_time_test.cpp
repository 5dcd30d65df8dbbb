#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "renderer/adaptive/lab.h"
#include "renderer/base/stopwatch.h"
#include "tests/trace/require.h"

// What a lane is charged: its samples, whoever traced them, its share of reading them, and its own
// estimates and plans. Sources state what each pixel's samples took. Of clocks only this is used:
// stretches of time that lie inside another one and apart from each other add up to no more than
// it.

namespace quartet {
namespace {

constexpr int timed_side = 16;
constexpr std::size_t timed_pixels = std::size_t(timed_side) * timed_side;
// Sums of the same floats in another order.
constexpr double time_rounding = 1e-6;

/// Far dearer than reading, with work that grows from left to right.
SampleSource dear_source(int milliseconds) {
  return [milliseconds](std::span<SampleJob> jobs) {
    for (SampleJob& job : jobs) {
      for (std::size_t i = 0; i < job.radiance.size(); ++i) {
        job.radiance[i] = glm::vec3(float((std::uint32_t(job.x) + job.first + i) % 5));
      }
      job.work *= 1.0 + job.x;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  };
}

/// What a lane was charged beside the tracing of its samples.
double own_of(const Lane& lane) {
  return lane.history().back().seconds - lane.history().back().tracing_seconds;
}

double own_of(const Lab& lab, std::size_t lane) {
  return own_of(lab.lanes()[lane]);
}

/// The seconds of a store's samples, of which each pixel has so many.
double tracing_of(const SampleStore& store, std::span<const std::uint32_t> counts) {
  SampleCosts::Work work;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto cell = [](std::size_t pixel) {
      return SampleCosts::cell(pixel / SampleStore::tile_size, timed_side / SampleStore::tile_size);
    };
    work.units[SampleCosts::side * cell(i / timed_side) + cell(i % timed_side)] += counts[i];
  }
  return store.costs().rates().of(work);
}

LaneSettings in_mode(EstimatorId id, SampleMode mode) {
  LaneSettings settings = default_settings(id);
  settings.mode = mode;
  return settings;
}

/// Takes 256 samples of each pixel a pass, with next to nothing to estimate and plan.
LaneSettings reading_settings() {
  LaneSettings settings = default_settings(EstimatorId::contrast);
  settings.policy.kind = PolicyId::batch;
  settings.policy.first = 256;
  settings.policy.batch = 256;
  settings.thresholds = {-1.0f, -1.0f, -1.0f};
  return settings;
}

TEST(LaneTime, IsThatOfItsSamplesOfReadingThemAndOfItsOwnWork) {
  SampleStore shown(timed_side, timed_side, std::size_t(1) << 30);
  SampleStore pilot(timed_side, timed_side, std::size_t(1) << 30);
  const std::vector<std::uint32_t> none(timed_pixels, 0);
  const std::vector<std::uint32_t> plenty(timed_pixels, 64);
  ASSERT_TRUE(test::require(shown, none, plenty, dear_source(10)));
  ASSERT_TRUE(test::require(pilot, none, plenty, dear_source(30)));
  for (const SampleMode mode : {SampleMode::reuse, SampleMode::unbiased}) {
    SCOPED_TRACE(sample_mode(mode).id);
    const bool has_pilot = mode == SampleMode::unbiased;
    const Stopwatch watch;
    Lane lane(timed_side, timed_side, in_mode(EstimatorId::kl, mode), {});
    const LaneStores stores{shown, has_pilot ? &pilot : nullptr};
    double reading = 0.0;
    for (const double take_seconds : {5.0, 7.0, 11.0}) {
      lane.begin_pass(stores);
      for (int row = 0; row < shown.tile_rows(); ++row) {
        lane.take(stores, row);
      }
      lane.end_pass(take_seconds);
      SampleCosts costs = shown.costs();
      if (has_pilot) {
        costs.add(pilot.costs());
      }
      lane.charge(costs, false);
      double tracing = 0.0;
      for (const SampleStore* store : {&shown, has_pilot ? &pilot : nullptr}) {
        tracing += store ? tracing_of(*store, lane.taken()) : 0.0;
      }
      EXPECT_NEAR(lane.history().back().tracing_seconds / tracing, 1.0, 1e-9);
      reading += take_seconds;
      const double own = own_of(lane) - reading;
      EXPECT_GT(own, -time_rounding);
      EXPECT_LT(own, watch.seconds() + time_rounding);
    }
  }
}

TEST(LaneTime, LanesAreChargedWhatTheyTookAndTogetherNoMoreThanPassed) {
  const std::vector<LaneSettings> lane_settings{
      in_mode(EstimatorId::uniform, SampleMode::reuse),
      in_mode(EstimatorId::kl, SampleMode::reuse),
      in_mode(EstimatorId::kl, SampleMode::unbiased),
      in_mode(EstimatorId::contrast, SampleMode::unbiased),
  };
  LabOptions options;
  options.pilot_source = dear_source(15);
  const Stopwatch watch;
  Lab lab(dear_source(5), timed_side, timed_side, lane_settings, options);
  for (int pass = 0; pass < 4; ++pass) {
    ASSERT_TRUE(lab.run_pass());
  }
  double own = 0.0;
  for (std::size_t lane = 0; lane < lane_settings.size(); ++lane) {
    EXPECT_GT(own_of(lab, lane), -time_rounding) << lane;
    own += own_of(lab, lane);
  }
  EXPECT_LT(own,
            watch.seconds() - lab.store().seconds() - lab.pilot_store()->seconds() + time_rounding);
  // All samples together are charged what tracing took, none of it twice.
  for (const SampleStore* store : {&lab.store(), lab.pilot_store()}) {
    std::vector<std::uint32_t> most(timed_pixels, 0);
    for (std::size_t i = 0; i < timed_pixels; ++i) {
      for (std::size_t lane = 0; lane < lane_settings.size(); ++lane) {
        const bool takes =
            store == &lab.store() || lane_settings[lane].mode == SampleMode::unbiased;
        most[i] = takes ? std::max(most[i], lab.lanes()[lane].taken()[i]) : most[i];
      }
    }
    EXPECT_NEAR(tracing_of(*store, most) / store->seconds(), 1.0, 1e-9);
  }
}

TEST(LaneTime, AReplayIsChargedToTheLanesThatMadeItOnce) {
  constexpr std::size_t lanes = 8;
  const std::vector<LaneSettings> lane_settings(lanes, reading_settings());
  LabOptions options;
  options.threads = 1;
  options.statistics.variance = true;
  Lab lab(dear_source(0), timed_side, timed_side, lane_settings, options);
  ASSERT_TRUE(lab.run_pass());
  const double tracing = lab.store().seconds();
  double best = 0.0;
  // Whatever else the machine does only adds to what passes: the best of many tries counts.
  for (int attempt = 0; attempt < 50 && best < 0.5; ++attempt) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      lab.set_settings(lane, lane_settings[lane]);
    }
    const Stopwatch watch;
    ASSERT_TRUE(lab.run_pass());
    const double passed = watch.seconds();
    double own = 0.0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      EXPECT_GT(own_of(lab, lane), 0.0) << lane;
      own += own_of(lab, lane);
    }
    EXPECT_LT(own, passed + lanes * time_rounding) << "each its own part";
    best = std::max(best, own / passed);
  }
  EXPECT_GE(best, 0.5) << "there is next to nothing but reading, and it is charged";
  EXPECT_EQ(lab.store().seconds(), tracing) << "nothing was traced";
}

TEST(LaneTime, ALaneThatRestsIsChargedNothing) {
  const std::vector<LaneSettings> lane_settings(3, default_settings(EstimatorId::kl));
  Lab lab(dear_source(1), timed_side, timed_side, lane_settings, {});
  ASSERT_TRUE(lab.run_pass());
  ASSERT_TRUE(lab.run_pass());
  const double first = own_of(lab, 0);
  const double last = own_of(lab, 2);
  lab.set_settings(1, lane_settings[1]);
  ASSERT_TRUE(lab.run_pass());
  EXPECT_EQ(lab.lanes()[1].pass(), 1u);
  EXPECT_EQ(own_of(lab, 0), first);
  EXPECT_EQ(own_of(lab, 2), last);
  // What it had been charged before it began again is forgotten.
  const Stopwatch watch;
  lab.set_settings(1, lane_settings[1]);
  ASSERT_TRUE(lab.run_pass());
  EXPECT_LT(own_of(lab, 1), watch.seconds() + time_rounding);
}

}  // namespace
}  // namespace quartet
