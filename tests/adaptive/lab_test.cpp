#include "renderer/adaptive/lab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

constexpr int width = 48;
constexpr int height = 27;
constexpr std::size_t pixels = std::size_t(width) * height;

/// Every estimator with the policy that comes with it.
std::vector<LaneSettings> all_settings() {
  std::vector<LaneSettings> lane_settings;
  for (const Estimator& row : estimators()) {
    lane_settings.push_back(default_settings(row.key));
  }
  return lane_settings;
}

/// Every estimator under every policy in every mode.
std::vector<LaneSettings> all_combinations() {
  std::vector<LaneSettings> lane_settings;
  for (LaneSettings settings : all_settings()) {
    for (const PolicyRow& policy : policies()) {
      for (const SampleModeRow& mode : sample_modes()) {
        settings.policy.kind = policy.key;
        settings.mode = mode.key;
        lane_settings.push_back(settings);
      }
    }
  }
  return lane_settings;
}

SampleSource cornell_checker(std::uint64_t seed = 0) {
  static const auto scene =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  RenderSettings settings = default_settings(scene->scene());
  settings.width = width;
  settings.height = height;
  settings.seed = seed;
  return sample_source(scene, settings);
}

/// With all that any estimator and any mode asks for.
Lab make_lab(std::span<const LaneSettings> lane_settings, LabOptions options = {},
             SampleSource source = cornell_checker()) {
  options.reference = std::make_shared<const RadianceImage>(width, height, glm::vec3(0.3f));
  options.pilot_source = cornell_checker(1);
  return Lab(std::move(source), width, height, lane_settings, options);
}

LabOptions options_with_threads(int threads) {
  LabOptions options;
  options.threads = threads;
  return options;
}

LabOptions options_with_memory(std::size_t bytes) {
  LabOptions options;
  options.memory = bytes;
  return options;
}

void run(Lab& lab, std::uint32_t passes) {
  while (lab.pass() < passes) {
    ASSERT_TRUE(lab.run_pass());
  }
}

/// Equal to the bit: film, errors, plan, counts.
void expect_same_state(const Lane& a, const Lane& b) {
  ASSERT_EQ(a.pass(), b.pass());
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(std::ranges::equal(a.film().mean(c), b.film().mean(c)));
  }
  EXPECT_TRUE(std::ranges::equal(a.film().counts(), b.film().counts()));
  EXPECT_TRUE(std::ranges::equal(a.taken(), b.taken()));
  EXPECT_TRUE(std::ranges::equal(a.error(), b.error()));
  EXPECT_EQ(a.plan().wanted, b.plan().wanted);
  for (std::size_t i = 0; i < a.history().size(); ++i) {
    EXPECT_EQ(a.history()[i].samples, b.history()[i].samples);
    EXPECT_EQ(a.history()[i].not_done, b.history()[i].not_done);
    EXPECT_EQ(a.history()[i].max_spp, b.history()[i].max_spp);
    EXPECT_EQ(a.history()[i].rays, b.history()[i].rays);
  }
}

std::uint64_t sum(std::span<const std::uint32_t> values) {
  return std::accumulate(values.begin(), values.end(), std::uint64_t(0));
}

TEST(Lab, EachSampleIsTracedOnce) {
  Lab lab = make_lab(all_settings());
  run(lab, 8);
  std::uint64_t greediest = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint32_t most = 0;
    for (const Lane& lane : lab.lanes()) {
      most = std::max(most, lane.taken()[i]);
    }
    greediest += most;
  }
  EXPECT_EQ(lab.store().traced(), greediest);
  EXPECT_EQ(lab.store().stored(), greediest);
  std::uint64_t used = 0;
  for (const Lane& lane : lab.lanes()) {
    used += sum(lane.taken());
    EXPECT_EQ(lane.history().back().samples, sum(lane.taken()));
  }
  EXPECT_GT(used, 2 * greediest);
}

TEST(Lab, ALaneIsTheSameAloneAndInCompany) {
  const auto lane_settings = all_settings();
  Lab together = make_lab(lane_settings);
  run(together, 6);
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    Lab alone = make_lab(std::span(lane_settings).subspan(i, 1));
    run(alone, 6);
    expect_same_state(alone.lanes()[0], together.lanes()[i]);
  }
}

TEST(Lab, AReplayIsTheSameAsAFreshRun) {
  // Not all: a greedier lane would have traced what a lower threshold wants.
  std::vector<LaneSettings> lane_settings;
  for (const EstimatorId id : {EstimatorId::contrast, EstimatorId::kl, EstimatorId::rigau_kl}) {
    lane_settings.push_back(default_settings(id));
  }
  lane_settings[2].policy.kind = PolicyId::vote;
  Lab lab = make_lab(lane_settings);
  run(lab, 6);
  const std::uint64_t traced = lab.store().traced();
  // There and back: what was done before leaves no trace.
  const LaneSettings original = lane_settings[1];
  lane_settings[1].thresholds[0] *= 3.0f;
  lab.set_settings(1, lane_settings[1]);
  run(lab, 6);
  EXPECT_EQ(lab.store().traced(), traced) << "a higher threshold needs nothing new";
  Lab fresh = make_lab(lane_settings);
  run(fresh, 6);
  expect_same_state(lab.lanes()[1], fresh.lanes()[1]);

  lane_settings[1].thresholds[0] = original.thresholds[0] / 4.0f;
  lab.set_settings(1, lane_settings[1]);
  run(lab, 6);
  EXPECT_GT(lab.store().traced(), traced);
  lab.set_settings(1, original);
  run(lab, 6);
  lane_settings[1] = original;
  Lab again = make_lab(lane_settings);
  run(again, 6);
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    expect_same_state(lab.lanes()[i], again.lanes()[i]);
  }
}

TEST(LabThreads, OneTwoAndEightThreadsGiveTheSame) {
  const auto lane_settings = all_combinations();
  Lab one = make_lab(lane_settings, options_with_threads(1));
  run(one, 6);
  for (const int threads : {2, 8}) {
    Lab many = make_lab(lane_settings, options_with_threads(threads));
    run(many, 6);
    for (std::size_t i = 0; i < lane_settings.size(); ++i) {
      expect_same_state(one.lanes()[i], many.lanes()[i]);
    }
  }
}

TEST(Lab, AShortMemoryChangesNothingButWork) {
  auto lane_settings = all_settings();
  lane_settings.back().mode = lane_settings.front().mode = SampleMode::unbiased;
  Lab ample = make_lab(lane_settings);
  run(ample, 12);
  Lab tight = make_lab(lane_settings, options_with_memory(1));
  run(tight, 12);
  EXPECT_TRUE(tight.store().partial());
  EXPECT_FALSE(ample.store().partial());
  EXPECT_LT(tight.store().stored(), ample.store().stored());
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    expect_same_state(ample.lanes()[i], tight.lanes()[i]);
  }
  tight.set_settings(2, lane_settings[2]);
  run(tight, 12);
  expect_same_state(ample.lanes()[2], tight.lanes()[2]);
}

/// Radiance that depends on all arguments, where `bad` is asked for every seventh sample negative
/// or not a number.
SampleSource noise(bool bad) {
  return [bad](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      const auto n = float(first + i);
      const float value = 0.5f + 0.5f * std::sin(12.9898f * float(x) + 78.233f * float(y) + 37 * n);
      radiance[i] = glm::vec3(value, value * value, std::sqrt(value));
      if (bad && x % 16 == 3 && (first + i) % 7 == 3) {
        radiance[i][(first + i) % 3] = y % 2 == 0 ? -1.0f : std::nanf("");
      }
    }
  };
}

TEST(Lab, MeansLookedUpAreThoseAddedUp) {
  const auto lane_settings = all_settings();
  // A lane that wants the variance must add.
  LabOptions adds;
  adds.statistics.variance = true;
  for (const bool bad : {false, true}) {
    Lab looking_up = make_lab(lane_settings, {}, noise(bad));
    Lab adding = make_lab(lane_settings, adds, noise(bad));
    run(looking_up, 9);
    run(adding, 9);
    EXPECT_TRUE(looking_up.store().has_means());
    for (std::size_t i = 0; i < lane_settings.size(); ++i) {
      EXPECT_EQ(looking_up.lanes()[i].film().has_sums(),
                estimator(lane_settings[i].estimator).needs.any());
      EXPECT_TRUE(adding.lanes()[i].film().has_sums());
      expect_same_state(looking_up.lanes()[i], adding.lanes()[i]);
      EXPECT_TRUE(std::ranges::equal(looking_up.lanes()[i].film().rejected(),
                                     adding.lanes()[i].film().rejected()));
      EXPECT_EQ(looking_up.lanes()[i].film().total_rejected() > 0, bad);
    }
  }
}

TEST(Lab, ChangesFromLookingUpToAddingInTheMiddle) {
  const auto lane_settings = all_settings();
  for (const bool bad : {false, true}) {
    Lab ample = make_lab(lane_settings, {}, noise(bad));
    run(ample, 5);
    LabOptions options;
    options.memory = ample.store().bytes() * 4 / 3;  // with room for one pass more
    Lab tight = make_lab(lane_settings, options, noise(bad));
    run(tight, 5);
    EXPECT_TRUE(tight.store().has_means());
    run(tight, 12);
    EXPECT_FALSE(tight.store().has_means());
    run(ample, 12);
    EXPECT_TRUE(ample.store().has_means());
    for (std::size_t i = 0; i < lane_settings.size(); ++i) {
      EXPECT_TRUE(tight.lanes()[i].film().has_sums());
      expect_same_state(ample.lanes()[i], tight.lanes()[i]);
      EXPECT_TRUE(std::ranges::equal(ample.lanes()[i].film().rejected(),
                                     tight.lanes()[i].film().rejected()));
    }
  }
}

TEST(Lab, StoppedWorkIsKeptAndTakenUpAgain) {
  const auto lane_settings = all_settings();
  std::stop_source stop;
  stop.request_stop();
  Lab lab = make_lab(lane_settings);
  EXPECT_TRUE(lab.run_pass(stop.get_token())) << "the first samples are never given up";
  EXPECT_EQ(lab.pass(), 1u);
  EXPECT_FALSE(lab.run_pass(stop.get_token()));
  EXPECT_EQ(lab.pass(), 1u);
  run(lab, 4);
  Lab fresh = make_lab(lane_settings);
  run(fresh, 4);
  for (std::size_t i = 0; i < lane_settings.size(); ++i) {
    expect_same_state(lab.lanes()[i], fresh.lanes()[i]);
  }
}

TEST(Lab, BadSamplesAreRejectedAndDoNotHoldUpTheLane) {
  const SampleSource source = [](int x, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3(x == 0 && (first + i) % 2 == 1 ? std::nanf("") : 1.0f);
    }
  };
  const LaneSettings settings = default_settings(EstimatorId::uniform);
  Lab lab(source, 2, 1, std::span(&settings, 1));
  run(lab, 10);
  const Lane& lane = lab.lanes()[0];
  EXPECT_EQ(lane.taken()[0], 10u);
  EXPECT_EQ(lane.film().counts()[0], 5u);
  EXPECT_EQ(lane.film().rejected()[0], 5u);
  EXPECT_EQ(lane.film().mean(0)[0], 1.0f);
  EXPECT_EQ(lane.history().back().samples, 20u);
}

TEST(Lab, SecondsGrowWithTheSamplesOfALane) {
  Lab lab = make_lab(all_settings());
  run(lab, 6);
  for (const Lane& lane : lab.lanes()) {
    for (std::size_t i = 1; i < lane.history().size(); ++i) {
      EXPECT_GT(lane.history()[i].seconds, 0.0);
      EXPECT_GT(lane.history()[i].samples, lane.history()[i - 1].samples);
    }
  }
}

TEST(Lab, OneLaneAloneIsChargedForAllThatWasTraced) {
  for (const SampleModeRow& mode : sample_modes()) {
    LaneSettings settings = default_settings(EstimatorId::kl);
    settings.mode = mode.key;
    Lab lab = make_lab(std::span(&settings, 1));
    run(lab, 5);
    const double traced =
        lab.store().seconds() + (lab.pilot_store() ? lab.pilot_store()->seconds() : 0.0);
    EXPECT_NEAR(lab.lanes()[0].history().back().tracing_seconds / traced, 1.0, 1e-9) << mode.id;
  }
}

TEST(Lab, RaysAreThoseOfTheSamplesThatALaneTook) {
  static const auto scene =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-checker")));
  RenderSettings settings = default_settings(scene->scene());
  settings.width = width;
  settings.height = height;
  const CameraRays camera(settings.camera, width, height);
  const Integrator& row = integrator(settings.integrator);
  for (const std::size_t memory : {std::size_t(1) << 30, std::size_t(1) << 18}) {
    Lab lab = make_lab(all_combinations(), options_with_memory(memory));
    run(lab, 5);
    EXPECT_EQ(lab.partial(), memory == std::size_t(1) << 18);
    for (const Lane& lane : lab.lanes()) {
      if (lane.settings().mode != SampleMode::reuse) {
        EXPECT_GT(lane.history().back().rays, lane.history().back().samples);
        continue;
      }
      // Traced again, pixel by pixel.
      std::uint64_t rays = 0;
      std::vector<glm::vec3> radiance;
      for (std::size_t i = 0; i < pixels; ++i) {
        radiance.resize(lane.taken()[i]);
        SampleJob job{int(i) % width, int(i) / width, 0, radiance};
        row.trace_jobs(*scene, settings, camera, {&job, 1});
        rays += std::uint64_t(job.work);
      }
      EXPECT_EQ(lane.history().back().rays, rays) << estimator(lane.settings().estimator).id;
    }
  }
}

TEST(Lab, AllLanesAreChargedByOneTableAfterAThresholdWentAwayAndCameBack) {
  // Lanes in pairs, of which one is dragged; the others rest meanwhile.
  std::vector<LaneSettings> lane_settings;
  for (const EstimatorId id : {EstimatorId::contrast, EstimatorId::kl}) {
    for (const SampleModeRow& mode : sample_modes()) {
      LaneSettings settings = default_settings(id);
      settings.mode = mode.key;
      lane_settings.insert(lane_settings.end(), {settings, settings});
    }
  }
  Lab lab = make_lab(lane_settings);
  run(lab, 6);
  const std::uint64_t before = lab.store().traced();
  for (const float factor : {0.01f, 1.0f}) {
    for (std::size_t i = 0; i < lane_settings.size(); i += 2) {
      LaneSettings dragged = lane_settings[i];
      for (float& threshold : dragged.thresholds) {
        threshold *= factor;
      }
      lab.set_settings(i, dragged);
    }
    run(lab, 6);
  }
  EXPECT_GT(lab.store().traced(), before) << "what samples take was measured anew";
  for (std::size_t i = 0; i < lane_settings.size(); i += 2) {
    const auto dragged = lab.lanes()[i].history();
    const auto rested = lab.lanes()[i + 1].history();
    ASSERT_EQ(dragged.size(), rested.size());
    for (std::size_t k = 0; k < dragged.size(); ++k) {
      EXPECT_EQ(dragged[k].tracing_seconds, rested[k].tracing_seconds) << i << ", " << k;
      EXPECT_GT(dragged[k].seconds, dragged[k].tracing_seconds);
      EXPECT_GT(rested[k].seconds, rested[k].tracing_seconds);
      EXPECT_EQ(dragged[k].rays, rested[k].rays);
    }
  }
}

TEST(Lab, TheOracleNeedsAReferenceOfThePicturesSize) {
  const LaneSettings oracle = default_settings(EstimatorId::oracle);
  EXPECT_THROW(Lab(cornell_checker(), width, height, std::span(&oracle, 1)), std::invalid_argument);
  LabOptions options;
  options.reference = std::make_shared<const RadianceImage>(width, height + 1);
  EXPECT_THROW(Lab(cornell_checker(), width, height, std::span(&oracle, 1), options),
               std::invalid_argument);
  const LaneSettings plain = default_settings(EstimatorId::kl);
  Lab lab(cornell_checker(), width, height, std::span(&plain, 1));
  EXPECT_THROW(lab.set_settings(0, oracle), std::invalid_argument);
  EXPECT_EQ(lab.lanes()[0].settings(), plain);
}

TEST(Lab, TheOracleKnowsWhereThePictureIsWrong) {
  // A reference that is the picture itself, but for one pixel.
  const LaneSettings lane_settings[] = {default_settings(EstimatorId::uniform),
                                        default_settings(EstimatorId::oracle)};
  Lab uniform = make_lab(std::span(lane_settings).first(1));
  run(uniform, 8);
  RadianceImage truth = uniform.lanes()[0].film().image();
  truth.at(5, 7) += glm::vec3(1.0f);
  LabOptions options;
  options.reference = std::make_shared<const RadianceImage>(truth);
  Lab lab(cornell_checker(), width, height, std::span(lane_settings).subspan(1), options);
  run(lab, 1);
  const Lane& lane = lab.lanes()[0];
  ASSERT_EQ(lane.taken()[0], 8u);
  EXPECT_EQ(lane.plan().not_done, 1u);
  EXPECT_EQ(lane.plan().wanted[std::size_t(7) * width + 5], 8u);
  EXPECT_NEAR(lane.error()[std::size_t(7) * width + 5], 1.0, 1e-5);
}

TEST(Lab, AnUnbiasedLaneIsPlannedByItsPilotAlone) {
  // The counts are those of a lane that reuses the pilot's samples; the picture is another.
  LaneSettings settings = default_settings(EstimatorId::kl);
  Lab pilot(cornell_checker(1), width, height, std::span(&settings, 1));
  run(pilot, 6);
  settings.mode = SampleMode::unbiased;
  Lab lab = make_lab(std::span(&settings, 1));
  run(lab, 6);
  const Lane& lane = lab.lanes()[0];
  EXPECT_TRUE(std::ranges::equal(lane.taken(), pilot.lanes()[0].taken()));
  EXPECT_TRUE(std::ranges::equal(lane.error(), pilot.lanes()[0].error()));
  EXPECT_EQ(lane.deciding_film().image(), pilot.lanes()[0].film().image());
  EXPECT_NE(lane.film().image(), pilot.lanes()[0].film().image());
}

TEST(Lab, AnotherSeedGivesOtherSamples) {
  const LaneSettings settings = default_settings(EstimatorId::uniform);
  Lab a(cornell_checker(0), width, height, std::span(&settings, 1));
  Lab b(cornell_checker(1), width, height, std::span(&settings, 1));
  run(a, 1);
  run(b, 1);
  EXPECT_NE(a.lanes()[0].film().image(), b.lanes()[0].film().image());
}

}  // namespace
}  // namespace quartet
