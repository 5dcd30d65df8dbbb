#include "renderer/study/calibrate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/files/temp_folder.h"
#include "tests/study/noisy_source.h"

namespace quartet {
namespace {

constexpr int calibrated_width = 96;
constexpr int calibrated_height = 64;

Experiment make_experiment(int threads = 0) {
  LabOptions options;
  options.threads = threads;
  return Experiment(test::noisy_source(calibrated_width), calibrated_width, calibrated_height,
                    options,
                    std::make_shared<const RadianceImage>(
                        test::noisy_truth(calibrated_width, calibrated_height)));
}

std::vector<LaneSettings> lanes_with_thresholds() {
  std::vector<LaneSettings> lane_settings;
  for (const Estimator& row : estimators()) {
    if (row.channels > 0) {
      lane_settings.push_back(default_settings(row.key));
      lane_settings.back().policy.kind = PolicyId::vote;
    }
  }
  return lane_settings;
}

/// What a lane gives, by a run of its own.
Measurement run_of(const LaneSettings& settings, std::uint32_t passes) {
  Experiment experiment = make_experiment();
  return experiment
      .run({.settings = settings, .stop = {.passes = passes}, .metrics = {MetricId::relmse}})
      ->back();
}

TEST(Calibrate, EveryEstimatorMeetsTheSameMeanOfSamples) {
  Experiment experiment = make_experiment();
  for (const LaneSettings& settings : lanes_with_thresholds()) {
    SCOPED_TRACE(estimator(settings.estimator).id);
    const auto found = calibrate(experiment, settings, {.passes = 12, .spp = 24.0});
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->met) << found->reason;
    EXPECT_NEAR(found->result.mean_spp, 24.0, 0.24);
    EXPECT_EQ(found->result.record.pass, 12u);
    // The thresholds alone reproduce it.
    EXPECT_EQ(run_of(found->settings, 12).record.samples, found->result.record.samples);
    // All are scaled alike.
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(found->settings.thresholds[c],
                float(double(settings.thresholds[c]) * found->factor));
    }
    EXPECT_LT(found->runs, 40);
  }
}

TEST(Calibrate, IsTheSameTwiceAndWithAnyThreads) {
  std::vector<Calibration> found;
  for (const int threads : {1, 2, 2}) {
    Experiment experiment = make_experiment(threads);
    found.push_back(
        *calibrate(experiment, default_settings(EstimatorId::kl), {.passes = 10, .spp = 20.0}));
  }
  EXPECT_EQ(found[0].settings, found[1].settings);
  EXPECT_EQ(found[0].settings, found[2].settings);
  EXPECT_EQ(found[0].runs, found[1].runs);
}

TEST(Calibrate, MeetsAnError) {
  Experiment experiment = make_experiment();
  const LaneSettings settings = default_settings(EstimatorId::contrast);
  const double middle = std::sqrt(run_of(scaled_thresholds(settings, 1e6), 12).values[0] *
                                  run_of(scaled_thresholds(settings, 1e-6), 12).values[0]);
  const auto found = calibrate(experiment, settings,
                               {.passes = 12, .error = ErrorTarget{MetricId::relmse, middle}});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->met) << found->reason;
  EXPECT_LE(found->result.values[0], middle) << "an upper bound";
  EXPECT_NEAR(found->result.values[0], middle, 0.011 * middle);
  EXPECT_EQ(found->note, "");
  EXPECT_LT(found->runs, 60);
}

TEST(Calibrate, AnErrorInDecibelsIsComparedAsWhatItStandsFor) {
  Experiment experiment = make_experiment();
  const LaneSettings settings = default_settings(EstimatorId::kl);
  const auto free =
      experiment.run({.settings = settings, .stop = {.passes = 12}, .metrics = {MetricId::psnr}});
  const double psnr = free->back().values[0];
  const auto found = calibrate(experiment, scaled_thresholds(settings, 1.5),
                               {.passes = 12, .error = ErrorTarget{MetricId::psnr, psnr}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->result.values[0], psnr, 0.05);
}

TEST(Calibrate, SaysWhyABudgetCannotBeMet) {
  Experiment experiment = make_experiment();
  const LaneSettings settings = default_settings(EstimatorId::hellinger);
  auto found = calibrate(experiment, settings, {.passes = 15, .spp = 4.0});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->met);
  EXPECT_EQ(found->reason, "15 passes of vote take at least 15 spp");
  EXPECT_EQ(found->result.mean_spp, 15.0);
  found = calibrate(experiment, settings, {.passes = 3, .spp = 50.0});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->met);
  EXPECT_EQ(found->reason.substr(0, 30), "3 passes of vote take at most ");
  EXPECT_GT(found->result.mean_spp, 9.0);
  found =
      calibrate(experiment, settings, {.passes = 3, .error = ErrorTarget{MetricId::relmse, 1e-9}});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->met);
  EXPECT_EQ(found->reason.substr(0, 46), "3 passes of vote come no nearer than relmse 0.")
      << found->reason;
}

TEST(Calibrate, UniformTakesAsManyPassesAsTheBudgetHas) {
  Experiment experiment = make_experiment();
  const LaneSettings uniform = default_settings(EstimatorId::uniform);
  auto found = calibrate(experiment, uniform, {.passes = 15, .spp = 24.0});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->met);
  EXPECT_EQ(found->result.record.pass, 24u);
  found = calibrate(experiment, uniform, {.passes = 15, .spp = 2.5});
  EXPECT_FALSE(found->met);
  EXPECT_NE(found->reason.find("whole passes"), std::string::npos);
}

TEST(Calibrate, UniformTakesTheFirstPassThatMeetsAnError) {
  Experiment experiment = make_experiment();
  const LaneSettings uniform = default_settings(EstimatorId::uniform);
  const auto errors = *experiment.run({.settings = uniform,
                                       .stop = {.passes = 8},
                                       .metrics = {MetricId::relmse},
                                       .measure_at = MeasureAt::every_pass});
  const double between = std::sqrt(errors[4].values[0] * errors[5].values[0]);
  CommonBudget budget{.passes = 15, .error = ErrorTarget{MetricId::relmse, between}};
  auto found = calibrate(experiment, uniform, budget);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->met) << found->reason;
  EXPECT_EQ(found->note, "");
  EXPECT_EQ(found->result.record.pass, 6u);
  EXPECT_EQ(found->result.values[0], errors[5].values[0]);

  budget.uniform_passes = 5;
  found = calibrate(experiment, uniform, budget);
  EXPECT_FALSE(found->met);
  EXPECT_EQ(found->reason.substr(0, 28), "5 whole passes give relmse 0");

  budget.error->value = 2.0 * errors[0].values[0];
  found = calibrate(experiment, uniform, budget);
  EXPECT_TRUE(found->met) << found->reason;
  EXPECT_EQ(found->result.record.pass, 1u);
  EXPECT_EQ(found->note.substr(0, 24), "already better than aske");
}

/// As noisy_source(), but the samples of each pixel from the 20th to the 23rd are light that the
/// truth does not have: who stops before never sees it, and who goes on needs many samples more
/// until it hardly counts.
SampleSource late_light_source(int width) {
  return [base = test::noisy_source(width)](int x, int y, std::uint32_t first,
                                            std::span<glm::vec3> radiance) {
    base(x, y, first, radiance);
    for (std::uint32_t i = 0; i < radiance.size(); ++i) {
      radiance[i] *= first + i >= 20 && first + i < 24 ? 8.0f : 1.0f;
    }
  };
}

/// An error that first rises and then falls with the samples.
class LateLight : public testing::Test {
 protected:
  LateLight() {
    settings_.max_spp = 400;
    settings_.policy = {};
    settings_.policy.kind = PolicyId::batch;
  }
  double error_at(double factor) { return measured_at(factor).values[0]; }
  Measurement measured_at(double factor) {
    return experiment_
        .run({.settings = scaled_thresholds(settings_, factor),
              .stop = {.passes = passes},
              .metrics = {MetricId::relmse}})
        ->back();
  }
  std::optional<Calibration> found_for(double error) {
    return calibrate(experiment_, settings_,
                     {.passes = passes, .error = ErrorTarget{MetricId::relmse, error}});
  }

  static constexpr int width = 48;
  static constexpr int height = 24;
  static constexpr std::uint32_t passes = 60;
  LaneSettings settings_ = default_settings(EstimatorId::confidence);
  Experiment experiment_ =
      Experiment(late_light_source(width), width, height, {},
                 std::make_shared<const RadianceImage>(test::noisy_truth(width, height)));
};

TEST_F(LateLight, OfTheThresholdsThatMeetAnErrorTheCheapestIsTaken) {
  const Measurement first = measured_at(1e6);
  const Measurement middle = measured_at(0x1p2);
  const Measurement all = measured_at(1e-6);
  // Not monotone: neither few samples nor many are as wrong as those in between.
  ASSERT_LT(first.values[0], 0.8 * middle.values[0]);
  ASSERT_LT(all.values[0], 0.5 * first.values[0]);
  ASSERT_LT(10.0 * middle.mean_spp, all.mean_spp * 2.0);

  // Only in reach with many samples: the lower crossing.
  const double hard = std::sqrt(all.values[0] * first.values[0]);
  auto found = found_for(hard);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->met) << found->reason;
  EXPECT_LE(found->result.values[0], hard);
  EXPECT_GE(found->result.values[0], 0.98 * hard);
  EXPECT_GT(found->result.mean_spp, 5.0 * first.mean_spp);
  EXPECT_LT(found->result.mean_spp, 0.9 * all.mean_spp);

  // Also in reach before the light comes: bisection from the given thresholds would take the first
  // crossing that it meets, with many times the samples.
  const double easy = std::sqrt(first.values[0] * middle.values[0]);
  found = found_for(easy);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->met) << found->reason;
  EXPECT_LE(found->result.values[0], easy);
  EXPECT_EQ(found->result.mean_spp, first.mean_spp);
  EXPECT_EQ(found->note.substr(0, 55), "better than asked: the cheapest threshold that meets it");
  EXPECT_LT(found->runs, 60);
}

TEST_F(LateLight, BetterThanAskedIsNotThatItCannotBeMet) {
  const auto found = found_for(1.0);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->met);
  EXPECT_EQ(found->reason, "");
  EXPECT_EQ(found->note.substr(0, 73),
            "already better than asked at every threshold; the cheapest gives relmse 0");
  EXPECT_EQ(found->result.record.samples, measured_at(1e6).record.samples);
  EXPECT_LT(found->factor, 1e6) << "the nearest of those that do nothing";
}

TEST_F(LateLight, WhatNoThresholdReachesIsSaidWithTheNearest) {
  const auto found = found_for(1e-3);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->met);
  EXPECT_EQ(found->note, "");
  EXPECT_EQ(found->reason.substr(0, 50), "60 passes of batch come no nearer than relmse 0.00");
  // The least error is that of neither end.
  EXPECT_LT(found->result.values[0], 0.95 * error_at(1e-6));
  EXPECT_LT(found->result.values[0], 0.95 * error_at(1e6));
}

TEST(CommonBudget, IsWhatItSaysOfARun) {
  Measurement run;
  run.mean_spp = 3.0;
  run.record.seconds = 5.0;
  run.record.samples = 7;
  run.values = {11.0};
  const CommonBudget spp{.spp = 24.0};
  const CommonBudget seconds{.seconds = 1.5};
  const CommonBudget error{.error = ErrorTarget{MetricId::flip, 0.25}};
  EXPECT_EQ(spp.of(run), 3.0);
  EXPECT_EQ(seconds.of(run), 5.0);
  EXPECT_EQ(error.of(run), 11.0);
  EXPECT_EQ(spp.text(), "24 spp");
  EXPECT_EQ(seconds.text(), "1.5 s");
  EXPECT_EQ(error.text(), "flip 0.25");
}

TEST(Calibrate, UniformAtABudgetIsTheNearestOfItsPasses) {
  Experiment experiment = make_experiment();
  // Two passes are 20 % under 2.5 samples a pixel, three are 20 % above: as a ratio 3 is nearer.
  const auto found = calibrate(experiment, default_settings(EstimatorId::uniform), {.spp = 2.5});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->result.mean_spp, 3.0);
  EXPECT_EQ(found->factor, 1.0);
  EXPECT_EQ(found->runs, 1);
  EXPECT_EQ(found->reason, "whole passes come no nearer than 3 spp");
}

TEST(Calibrate, CanBeStopped) {
  Experiment experiment = make_experiment();
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(
      calibrate(experiment, default_settings(EstimatorId::kl), {.spp = 24.0}, stop.get_token()));
}

TEST(Calibrate, WantsExactlyOneBudget) {
  Experiment experiment = make_experiment();
  const LaneSettings settings = default_settings(EstimatorId::kl);
  EXPECT_NE(error_of([&] { calibrate(experiment, settings, {}); }), "");
  EXPECT_NE(error_of([&] { calibrate(experiment, settings, {.spp = 3.0, .seconds = 3.0}); }), "");
  Experiment blind(test::noisy_source(calibrated_width), calibrated_width, calibrated_height, {});
  const CommonBudget error{.error = ErrorTarget{}};
  EXPECT_NE(error_of([&] { calibrate(blind, settings, error); }).find("reference"),
            std::string::npos);
}

}  // namespace
}  // namespace quartet
