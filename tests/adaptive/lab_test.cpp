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
std::vector<SamplingPolicy> all_policies() {
  std::vector<SamplingPolicy> policies;
  for (const Estimator& row : estimators()) {
    policies.push_back(default_policy(row.key));
  }
  return policies;
}

/// Every estimator under every allocation in every mode.
std::vector<SamplingPolicy> all_combinations() {
  std::vector<SamplingPolicy> policies;
  for (SamplingPolicy policy : all_policies()) {
    for (const AllocationRow& allocation : allocations()) {
      for (const SampleUseRow& use : sample_uses()) {
        policy.allocation.kind = allocation.key;
        policy.use = use.key;
        policies.push_back(policy);
      }
    }
  }
  return policies;
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
Lab make_lab(std::span<const SamplingPolicy> policies, LabOptions options = {},
             SampleSource source = cornell_checker()) {
  options.reference = std::make_shared<const RadianceImage>(width, height, glm::vec3(0.3f));
  options.pilot_source = cornell_checker(1);
  return Lab(std::move(source), width, height, policies, options);
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
  Lab lab = make_lab(all_policies());
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
  const auto policies = all_policies();
  Lab together = make_lab(policies);
  run(together, 6);
  for (std::size_t i = 0; i < policies.size(); ++i) {
    Lab alone = make_lab(std::span(policies).subspan(i, 1));
    run(alone, 6);
    expect_same_state(alone.lanes()[0], together.lanes()[i]);
  }
}

TEST(Lab, AReplayIsTheSameAsAFreshRun) {
  // Not all: a greedier lane would have traced what a lower threshold wants.
  std::vector<SamplingPolicy> policies;
  for (const EstimatorId id : {EstimatorId::contrast, EstimatorId::kl, EstimatorId::rigau_kl}) {
    policies.push_back(default_policy(id));
  }
  policies[2].allocation.kind = AllocationId::vote;
  Lab lab = make_lab(policies);
  run(lab, 6);
  const std::uint64_t traced = lab.store().traced();
  // There and back: what was done before leaves no trace.
  const SamplingPolicy original = policies[1];
  policies[1].thresholds[0] *= 3.0f;
  lab.set_policy(1, policies[1]);
  run(lab, 6);
  EXPECT_EQ(lab.store().traced(), traced) << "a higher threshold needs nothing new";
  Lab fresh = make_lab(policies);
  run(fresh, 6);
  expect_same_state(lab.lanes()[1], fresh.lanes()[1]);

  policies[1].thresholds[0] = original.thresholds[0] / 4.0f;
  lab.set_policy(1, policies[1]);
  run(lab, 6);
  EXPECT_GT(lab.store().traced(), traced);
  lab.set_policy(1, original);
  run(lab, 6);
  policies[1] = original;
  Lab again = make_lab(policies);
  run(again, 6);
  for (std::size_t i = 0; i < policies.size(); ++i) {
    expect_same_state(lab.lanes()[i], again.lanes()[i]);
  }
}

TEST(LabThreads, OneTwoAndEightThreadsGiveTheSame) {
  const auto policies = all_combinations();
  Lab one = make_lab(policies, options_with_threads(1));
  run(one, 6);
  for (const int threads : {2, 8}) {
    Lab many = make_lab(policies, options_with_threads(threads));
    run(many, 6);
    for (std::size_t i = 0; i < policies.size(); ++i) {
      expect_same_state(one.lanes()[i], many.lanes()[i]);
    }
  }
}

TEST(Lab, AShortMemoryChangesNothingButWork) {
  auto policies = all_policies();
  policies.back().use = policies.front().use = SampleUse::unbiased;
  Lab ample = make_lab(policies);
  run(ample, 12);
  Lab tight = make_lab(policies, options_with_memory(1));
  run(tight, 12);
  EXPECT_TRUE(tight.store().partial());
  EXPECT_FALSE(ample.store().partial());
  EXPECT_LT(tight.store().stored(), ample.store().stored());
  for (std::size_t i = 0; i < policies.size(); ++i) {
    expect_same_state(ample.lanes()[i], tight.lanes()[i]);
  }
  tight.set_policy(2, policies[2]);
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
  const auto policies = all_policies();
  // A lane that wants the variance must add.
  LabOptions adds;
  adds.statistics.variance = true;
  for (const bool bad : {false, true}) {
    Lab looking_up = make_lab(policies, {}, noise(bad));
    Lab adding = make_lab(policies, adds, noise(bad));
    run(looking_up, 9);
    run(adding, 9);
    EXPECT_TRUE(looking_up.store().has_means());
    for (std::size_t i = 0; i < policies.size(); ++i) {
      EXPECT_EQ(looking_up.lanes()[i].film().has_sums(),
                estimator(policies[i].estimator).needs.any());
      EXPECT_TRUE(adding.lanes()[i].film().has_sums());
      expect_same_state(looking_up.lanes()[i], adding.lanes()[i]);
      EXPECT_TRUE(std::ranges::equal(looking_up.lanes()[i].film().rejected(),
                                     adding.lanes()[i].film().rejected()));
      EXPECT_EQ(looking_up.lanes()[i].film().total_rejected() > 0, bad);
    }
  }
}

TEST(Lab, ChangesFromLookingUpToAddingInTheMiddle) {
  const auto policies = all_policies();
  for (const bool bad : {false, true}) {
    Lab ample = make_lab(policies, {}, noise(bad));
    run(ample, 5);
    LabOptions options;
    options.memory = ample.store().bytes();
    Lab tight = make_lab(policies, options, noise(bad));
    run(tight, 5);
    EXPECT_TRUE(tight.store().has_means());
    run(tight, 12);
    EXPECT_FALSE(tight.store().has_means());
    run(ample, 12);
    EXPECT_TRUE(ample.store().has_means());
    for (std::size_t i = 0; i < policies.size(); ++i) {
      EXPECT_TRUE(tight.lanes()[i].film().has_sums());
      expect_same_state(ample.lanes()[i], tight.lanes()[i]);
      EXPECT_TRUE(std::ranges::equal(ample.lanes()[i].film().rejected(),
                                     tight.lanes()[i].film().rejected()));
    }
  }
}

TEST(Lab, StoppedWorkIsKeptAndTakenUpAgain) {
  const auto policies = all_policies();
  std::stop_source stop;
  stop.request_stop();
  Lab lab = make_lab(policies);
  EXPECT_TRUE(lab.run_pass(stop.get_token())) << "the first samples are never given up";
  EXPECT_EQ(lab.pass(), 1u);
  EXPECT_FALSE(lab.run_pass(stop.get_token()));
  EXPECT_EQ(lab.pass(), 1u);
  run(lab, 4);
  Lab fresh = make_lab(policies);
  run(fresh, 4);
  for (std::size_t i = 0; i < policies.size(); ++i) {
    expect_same_state(lab.lanes()[i], fresh.lanes()[i]);
  }
}

TEST(Lab, BadSamplesAreRejectedAndDoNotHoldUpTheLane) {
  const SampleSource source = [](int x, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3(x == 0 && (first + i) % 2 == 1 ? std::nanf("") : 1.0f);
    }
  };
  const SamplingPolicy policy = default_policy(EstimatorId::uniform);
  Lab lab(source, 2, 1, std::span(&policy, 1));
  run(lab, 10);
  const Lane& lane = lab.lanes()[0];
  EXPECT_EQ(lane.taken()[0], 10u);
  EXPECT_EQ(lane.film().counts()[0], 5u);
  EXPECT_EQ(lane.film().rejected()[0], 5u);
  EXPECT_EQ(lane.film().mean(0)[0], 1.0f);
  EXPECT_EQ(lane.history().back().samples, 20u);
}

TEST(Lab, SecondsGrowWithTheSamplesOfALane) {
  Lab lab = make_lab(all_policies());
  run(lab, 6);
  for (const Lane& lane : lab.lanes()) {
    for (std::size_t i = 1; i < lane.history().size(); ++i) {
      EXPECT_GT(lane.history()[i].seconds, 0.0);
      EXPECT_GT(lane.history()[i].samples, lane.history()[i - 1].samples);
    }
  }
}

TEST(Lab, OneLaneAloneIsChargedForAllThatWasTraced) {
  for (const SampleUseRow& use : sample_uses()) {
    SamplingPolicy policy = default_policy(EstimatorId::kl);
    policy.use = use.key;
    Lab lab = make_lab(std::span(&policy, 1));
    run(lab, 5);
    const double traced =
        lab.store().seconds() + (lab.pilot_store() ? lab.pilot_store()->seconds() : 0.0);
    EXPECT_NEAR(lab.lanes()[0].history().back().tracing_seconds / traced, 1.0, 1e-9) << use.id;
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
      if (lane.policy().use != SampleUse::reuse) {
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
      EXPECT_EQ(lane.history().back().rays, rays) << estimator(lane.policy().estimator).id;
    }
  }
}

TEST(Lab, AllLanesAreChargedByOneTableAfterAThresholdWentAwayAndCameBack) {
  // Lanes in pairs, of which one is dragged; the others rest meanwhile.
  std::vector<SamplingPolicy> policies;
  for (const EstimatorId id : {EstimatorId::contrast, EstimatorId::kl}) {
    for (const SampleUseRow& use : sample_uses()) {
      SamplingPolicy policy = default_policy(id);
      policy.use = use.key;
      policies.insert(policies.end(), {policy, policy});
    }
  }
  Lab lab = make_lab(policies);
  run(lab, 6);
  const std::uint64_t before = lab.store().traced();
  for (const float factor : {0.01f, 1.0f}) {
    for (std::size_t i = 0; i < policies.size(); i += 2) {
      SamplingPolicy dragged = policies[i];
      for (float& threshold : dragged.thresholds) {
        threshold *= factor;
      }
      lab.set_policy(i, dragged);
    }
    run(lab, 6);
  }
  EXPECT_GT(lab.store().traced(), before) << "what samples take was measured anew";
  for (std::size_t i = 0; i < policies.size(); i += 2) {
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
  const SamplingPolicy oracle = default_policy(EstimatorId::oracle);
  EXPECT_THROW(Lab(cornell_checker(), width, height, std::span(&oracle, 1)), std::invalid_argument);
  LabOptions options;
  options.reference = std::make_shared<const RadianceImage>(width, height + 1);
  EXPECT_THROW(Lab(cornell_checker(), width, height, std::span(&oracle, 1), options),
               std::invalid_argument);
  const SamplingPolicy plain = default_policy(EstimatorId::kl);
  Lab lab(cornell_checker(), width, height, std::span(&plain, 1));
  EXPECT_THROW(lab.set_policy(0, oracle), std::invalid_argument);
  EXPECT_EQ(lab.lanes()[0].policy(), plain);
}

TEST(Lab, TheOracleKnowsWhereThePictureIsWrong) {
  // A reference that is the picture itself, but for one pixel.
  const SamplingPolicy policies[] = {default_policy(EstimatorId::uniform),
                                     default_policy(EstimatorId::oracle)};
  Lab uniform = make_lab(std::span(policies).first(1));
  run(uniform, 8);
  RadianceImage truth = uniform.lanes()[0].film().image();
  truth.at(5, 7) += glm::vec3(1.0f);
  LabOptions options;
  options.reference = std::make_shared<const RadianceImage>(truth);
  Lab lab(cornell_checker(), width, height, std::span(policies).subspan(1), options);
  run(lab, 1);
  const Lane& lane = lab.lanes()[0];
  ASSERT_EQ(lane.taken()[0], 8u);
  EXPECT_EQ(lane.plan().not_done, 1u);
  EXPECT_EQ(lane.plan().wanted[std::size_t(7) * width + 5], 8u);
  EXPECT_NEAR(lane.error()[std::size_t(7) * width + 5], 1.0, 1e-5);
}

TEST(Lab, AnUnbiasedLaneIsPlannedByItsPilotAlone) {
  // The counts are those of a lane that reuses the pilot's samples; the picture is another.
  SamplingPolicy policy = default_policy(EstimatorId::kl);
  Lab pilot(cornell_checker(1), width, height, std::span(&policy, 1));
  run(pilot, 6);
  policy.use = SampleUse::unbiased;
  Lab lab = make_lab(std::span(&policy, 1));
  run(lab, 6);
  const Lane& lane = lab.lanes()[0];
  EXPECT_TRUE(std::ranges::equal(lane.taken(), pilot.lanes()[0].taken()));
  EXPECT_TRUE(std::ranges::equal(lane.error(), pilot.lanes()[0].error()));
  EXPECT_EQ(lane.deciding_film().image(), pilot.lanes()[0].film().image());
  EXPECT_NE(lane.film().image(), pilot.lanes()[0].film().image());
}

TEST(Lab, AnotherSeedGivesOtherSamples) {
  const SamplingPolicy policy = default_policy(EstimatorId::uniform);
  Lab a(cornell_checker(0), width, height, std::span(&policy, 1));
  Lab b(cornell_checker(1), width, height, std::span(&policy, 1));
  run(a, 1);
  run(b, 1);
  EXPECT_NE(a.lanes()[0].film().image(), b.lanes()[0].film().image());
}

}  // namespace
}  // namespace quartet
