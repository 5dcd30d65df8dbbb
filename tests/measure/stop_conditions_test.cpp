#include "renderer/measure/stop_conditions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/adaptive/lab.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

constexpr std::size_t measured_pixels = 100;
constexpr double no_error = 0.0;

PassRecord record(std::uint32_t pass, double mean_spp, double seconds) {
  PassRecord record;
  record.pass = pass;
  record.samples = std::uint64_t(mean_spp * double(measured_pixels));
  record.seconds = seconds;
  return record;
}

StopConditions passes(std::uint32_t count) {
  StopConditions stop;
  stop.passes = count;
  return stop;
}

/// Samples that are 0 and 2 in turn: a mean of 1 after each second one, and the error 1/n else.
void alternate(int, int, std::uint32_t first, std::span<glm::vec3> radiance) {
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    radiance[i] = glm::vec3((first + i) % 2 == 0 ? 0.0f : 2.0f);
  }
}

std::uint32_t passes_until(const StopConditions& stop, const RadianceImage* reference,
                           const LaneSettings& settings = default_settings(EstimatorId::uniform)) {
  Lab lab(alternate, 10, 10, std::span(&settings, 1));
  double last = 0.0;
  while (stop.progress(lab.lanes()[0], reference) < 1.0) {
    EXPECT_GE(stop.progress(lab.lanes()[0], reference), 0.0);
    lab.run_pass();
    last += 1.0;
  }
  return std::uint32_t(last);
}

TEST(StopConditions, EachAloneCountsItsOwn) {
  StopConditions stop = passes(8);
  EXPECT_DOUBLE_EQ(stop.progress(record(2, 500, 500), measured_pixels, no_error), 0.25);
  EXPECT_DOUBLE_EQ(stop.progress(record(8, 0, 0), measured_pixels, no_error), 1.0);
  stop = {};
  stop.spp = 24.0;
  EXPECT_DOUBLE_EQ(stop.progress(record(1000, 6, 500), measured_pixels, no_error), 0.25);
  stop = {};
  stop.seconds = 0.5;
  EXPECT_DOUBLE_EQ(stop.progress(record(1000, 500, 0.4), measured_pixels, no_error), 0.8);
  stop = {};
  EXPECT_FALSE(stop.any());
  EXPECT_EQ(stop.progress(record(1000, 500, 500), measured_pixels, no_error), 0.0)
      << "without an end";
}

TEST(StopConditions, OfSeveralTheNearestCounts) {
  StopConditions stop = passes(10);
  stop.spp = 100.0;
  stop.seconds = 1.0;
  stop.error = ErrorTarget{MetricId::mse, 0.01};
  EXPECT_DOUBLE_EQ(stop.progress(record(5, 20, 0.3), measured_pixels, 0.04), 0.5);
  EXPECT_DOUBLE_EQ(stop.progress(record(5, 70, 0.3), measured_pixels, 0.04), 0.7);
  EXPECT_DOUBLE_EQ(stop.progress(record(5, 70, 0.8), measured_pixels, 0.04), 0.8);
  EXPECT_DOUBLE_EQ(stop.progress(record(5, 70, 0.8), measured_pixels, 0.0125), 0.8);
  EXPECT_DOUBLE_EQ(stop.progress(record(5, 70, 0.8), measured_pixels, 0.01), 1.0);
}

// A quarter of the error of mse takes 4 times the samples, of rmse 16 times, and 6.02 dB twice.
TEST(StopConditions, ErrorTargetsCountSamplesStillNeeded) {
  for (const Metric& row : metrics()) {
    const ErrorTarget target{row.key, row.higher_is_better ? 40.0 : 0.01};
    const double off = row.higher_is_better ? 40.0 - 10 * std::log10(4.0) : 0.04;
    EXPECT_NEAR(target.progress(off), row.scale == MetricScale::error ? 0.0625 : 0.25, 1e-12)
        << row.id;
    EXPECT_GE(target.progress(target.value), 1.0) << row.id;
    const double nearly = std::nextafter(target.value, row.higher_is_better ? 0.0 : 1.0);
    EXPECT_LE(target.progress(nearly), 1.0) << row.id;
    const double perfect = row.higher_is_better ? std::numeric_limits<double>::infinity() : 0.0;
    EXPECT_GE(target.progress(perfect), 1.0) << row.id;
  }
}

TEST(StopConditions, LanesStopAtTheFirstOne) {
  const RadianceImage truth(10, 10, glm::vec3(1.0f));
  StopConditions stop = passes(7);
  EXPECT_EQ(passes_until(stop, nullptr), 7u);
  stop.spp = 3.0;
  EXPECT_EQ(passes_until(stop, nullptr), 3u);
  stop = passes(7);
  stop.error = ErrorTarget{MetricId::rmse, 0.2};  // 1, 0, …
  EXPECT_EQ(passes_until(stop, &truth), 2u);
  stop.passes = 1;
  EXPECT_EQ(passes_until(stop, &truth), 1u);
  const RadianceImage two(10, 10, glm::vec3(2.0f));
  stop = {};
  stop.error = ErrorTarget{MetricId::rmse, 0.5};
  stop.spp = 50.0;
  EXPECT_EQ(passes_until(stop, &two), 50u) << "an error that is never reached";
}

TEST(StopConditions, AlsoWhereNoPixelWantsMore) {
  LaneSettings settings = default_settings(EstimatorId::uniform);
  settings.max_spp = 5;
  EXPECT_EQ(passes_until(passes(1000), nullptr, settings), 5u);
}

/// The end of a lane that has long passed it, and where it would have stopped.
void expect_end(std::uint32_t pass, const StopConditions& stop, const LaneSnapshot& lane) {
  EXPECT_EQ(stop.end_of(lane), pass);
  LaneSnapshot before = lane;
  before.plan.total = 1;
  before.history.resize(pass - 1);
  EXPECT_EQ(stop.end_of(before), std::nullopt);
  EXPECT_LT(stop.progress(before), 1.0);
}

TEST(StopConditions, TheEndIsFoundInTheHistoryOfALane) {
  LaneSnapshot lane;
  lane.taken.assign(measured_pixels, 12);
  lane.plan.total = 40;
  for (std::uint32_t pass = 1; pass <= 12; ++pass) {
    lane.history.push_back(record(pass, 2.0 * pass, 0.1 * pass));
    lane.history.back().truth.error = 1.0 / pass;
    lane.history.back().rays = 3 * lane.history.back().samples;
  }
  expect_end(7, passes(7), lane);
  StopConditions stop;
  stop.spp = 9.0;
  expect_end(5, stop, lane);
  stop.rays = 22.0;
  expect_end(4, stop, lane);
  stop.seconds = 0.25;
  expect_end(3, stop, lane);
  stop = passes(12);
  stop.error = ErrorTarget{MetricId::mse, 0.125};
  expect_end(8, stop, lane);
  for (PassRecord& each : lane.history) {
    each.truth.error = std::nan("");
  }
  expect_end(12, stop, lane);
  EXPECT_EQ(passes(13).end_of(lane), std::nullopt);
  // No pixel wants more: the lane ended with its last samples.
  lane.plan.total = 0;
  for (std::size_t i = 9; i < 12; ++i) {
    lane.history[i].samples = lane.history[8].samples;
  }
  expect_end(9, passes(100), lane);
  EXPECT_EQ(passes(100).progress(lane), 1.0);
}

TEST(StopConditions, AnEndThatWasMetIsFoundInALongRunThatWasThinned) {
  // Samples that are 0 and 2 in turn, against a truth of 1: the error is 0 after every second
  // pass and 1/pass² after the others. Of a long run, every second record is kept, then every
  // fourth.
  const LaneSettings settings = default_settings(EstimatorId::uniform);
  Lab lab(alternate, 2, 2, std::span(&settings, 1));
  const RadianceImage truth(2, 2, glm::vec3(1.0f));
  constexpr std::uint32_t long_run = 9001;
  while (lab.pass() < long_run) {
    ASSERT_TRUE(lab.run_pass());
    lab.measure([&](const Film& film) {
      // Distinct at every pass, so that a record's error tells whose it is.
      return TrueError{metric(MetricId::mse).compute(film.image(), truth) + 1.0 / lab.pass()};
    });
  }
  LaneSnapshot lane;
  copy_lane(lab.lanes()[0], lane);
  ASSERT_LE(lane.history.size(), PassHistory::most_records);
  for (const PassRecord& each : lane.history) {
    const double odd = each.pass % 2 == 1 ? 1.0 / (double(each.pass) * each.pass) : 0.0;
    ASSERT_NEAR(each.truth.error, 1.0 / each.pass + odd, 1e-6);
  }
  StopConditions stop;
  stop.error = ErrorTarget{MetricId::mse, 1.0 / 6000.5};
  const auto end = stop.end_of(lane);
  ASSERT_TRUE(end);
  EXPECT_GE(*end, 6001u);
  EXPECT_LE(*end, 6004u) << "the first that is kept of those after it";
}

TEST(StopConditions, AnErrorTargetNeedsAReferenceOfTheSameSize) {
  const LaneSettings settings = default_settings(EstimatorId::uniform);
  Lab lab(alternate, 10, 10, std::span(&settings, 1));
  StopConditions stop;
  stop.error = ErrorTarget{MetricId::mse, 0.5};
  const RadianceImage small(4, 4, glm::vec3(1.0f));
  EXPECT_EQ(stop.progress(lab.lanes()[0], nullptr), 0.0) << "nothing to measure yet";
  lab.run_pass();
  EXPECT_NE(error_of([&] { stop.progress(lab.lanes()[0], nullptr); }).find("needs a reference"),
            std::string::npos);
  EXPECT_NE(error_of([&] { stop.progress(lab.lanes()[0], &small); }).find("4x4"),
            std::string::npos);
}

TEST(ErrorTarget, IsReadFromText) {
  const ErrorTarget target = parse_error_target("relmse_trimmed=2.5e-3");
  EXPECT_EQ(target.metric, MetricId::relmse_trimmed);
  EXPECT_EQ(target.value, 2.5e-3);
  EXPECT_EQ(parse_error_target("psnr=40").metric, MetricId::psnr);
}

TEST(ErrorTarget, RefusesWhatIsNone) {
  for (const char* text : {"", "relmse", "0.01", "ssim=0.1", "=0.1"}) {
    const std::string message = error_of([&] { parse_error_target(text); });
    EXPECT_NE(message.find("relmse_trimmed"), std::string::npos)
        << text << " should list the metrics: " << message;
  }
  for (const char* value : {"", "0", "-1", "nan", "inf", "1e999", "0.1x", "0,1", " 0.1"}) {
    const std::string message = error_of([&] { parse_error_target(std::string("mse=") + value); });
    EXPECT_NE(message.find("no number above 0"), std::string::npos) << value << ": " << message;
  }
}

}  // namespace
}  // namespace quartet
