#include "app/records/sweep_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/records/run_record.h"
#include "app/records/sweep_json.h"
#include "app/records/sweep_table.h"
#include "tests/records/study_cases.h"
#include "tests/study/sweep_cases.h"

namespace quartet {
namespace {

/// Of two values, at 95 %: t is Cauchy's, and the standard error of their mean half their distance.
Interval of_two(double a, double b) {
  const double half = std::tan(0.475 * M_PI) * 0.5 * std::abs(a - b);
  return {0.5 * (a + b), 0.5 * (a + b) - half, 0.5 * (a + b) + half};
}

Interval geometric_of_two(double a, double b) {
  const Interval logarithm = of_two(std::log(a), std::log(b));
  return {std::exp(logarithm.mean), std::exp(logarithm.low), std::exp(logarithm.high)};
}

/// The sweep made by hand, with what its files hold beside: 2 × 1 pixels.
struct HandSweep {
  Run run = test::tiny_run();
  SweepPlan plan = test::hand_plan();
  SweepResult result = test::hand_result();
  SweepSummary summary;
  SweepReport report{run, plan, result, summary, Effort::rays, 128, "quartet sweep"};

  HandSweep() {
    result.runs[0].quality.rank_correlation = 0.125;
    result.runs[0].quality.stops = {8, 2, 3};
    result.runs[0].quality.calibration = {{0.5, 0.25, 60}, {2.0, 4.0, 70}};
    result.runs[0].oracle_distance = 0.75;
    for (SweepRun& each : result.runs) {
      each.end.record.rays = 7;
      each.end.record.samples = 9;
      if (each.lane.settings.estimator == EstimatorId::uniform_clamp) {
        each.end.relmse_top = each.seed == 40 ? 0.5 : 0.75;
      }
    }
    summary = summarize(result, plan, 0.004);
  }
};

class JointLines {
 public:
  JointLines(std::vector<std::string>& lines, std::string head)
      : lines_(lines), head_(std::move(head)) {}
  void number(const std::string& name, double value) {
    lines_.push_back(fmt::format("{},{},{:.9g}", head_, name, value));
  }
  void interval(const std::string& name, const Interval& value) {
    number(name, value.mean);
    number(name + "_low", value.low);
    number(name + "_high", value.high);
  }
  /// What every point has.
  void point(const Interval& error, double squared_bias, double variance, const Interval& energy) {
    interval("mse", error);
    number("mse_squared_bias", squared_bias);
    number("mse_variance", variance);
    interval("energy_error", energy);
  }
  void of_uniform(const Interval& ratio) {
    for (const char* effort : {"seconds", "rays", "spp"}) {
      interval(std::string("mse_of_uniform_") + effort, ratio);
    }
  }

 private:
  std::vector<std::string>& lines_;
  std::string head_;
};

TEST(SweepFiles, EveryColumnHoldsItsOwnNumber) {
  const HandSweep sweep;
  const std::string scene = sweep.run.scene->scene().name + ",independent,";
  const std::string uniform = scene + "uniform,vote,reuse,,";
  const std::string thresholds = thresholds_text(default_settings(EstimatorId::kl));
  const std::string kl = scene + "kl,vote,reuse," + thresholds + ",";
  const std::string twin = scene + "kl,vote,unbiased," + thresholds + ",";
  const std::string clamp = scene + "uniform-clamp,vote,reuse,,";
  const std::string header =
      "scene,sampler,estimator,policy,mode,thresholds,seed,pass,seconds,rays,samples,"
      "mean_spp,metric,value";
  std::vector<std::string> lines{
      header,
      uniform + "40,1,0.500000,0,0,1.000000,mse,1.6",
      uniform + "40,1,0.500000,0,0,1.000000,energy_error,0",
      uniform + "40,4,2.000000,0,0,4.000000,mse,0.4",
      uniform + "40,4,2.000000,0,0,4.000000,energy_error,0",
      uniform + "40,16,8.000000,0,0,16.000000,mse,0.1",
      uniform + "40,16,8.000000,0,0,16.000000,energy_error,0",
      uniform + "41,1,0.500000,0,0,1.000000,mse,2.4",
      uniform + "41,1,0.500000,0,0,1.000000,energy_error,0",
      uniform + "41,4,2.000000,0,0,4.000000,mse,0.6",
      uniform + "41,4,2.000000,0,0,4.000000,energy_error,0",
      uniform + "41,16,8.000000,0,0,16.000000,mse,0.15",
      uniform + "41,16,8.000000,0,0,16.000000,energy_error,0",
      kl + "40,1,1.000000,0,0,2.000000,mse,0.5",
      kl + "40,1,1.000000,0,0,2.000000,energy_error,-0.02",
      kl + "40,2,2.000000,0,0,4.000000,mse,0.3",
      kl + "40,2,2.000000,0,0,4.000000,energy_error,-0.04",
      kl + "40,3,3.000000,7,9,6.000000,mse,0.2",
      kl + "40,3,3.000000,7,9,6.000000,energy_error,-0.06",
      kl + "40,3,3.000000,7,9,6.000000,rank_correlation,0.125000",
      kl + "40,3,3.000000,7,9,6.000000,false_stops,0.375000",
      kl + "40,3,3.000000,7,9,6.000000,oracle_distance,0.750000",
      twin + "40,1,2.000000,0,0,4.000000,mse,0.6",
      twin + "40,1,2.000000,0,0,4.000000,energy_error,0",
      twin + "40,2,5.000000,7,9,10.000000,mse,0.4",
      twin + "40,2,5.000000,7,9,10.000000,energy_error,0.01",
      twin + "40,2,5.000000,7,9,10.000000,oracle_distance,0.000000",
      clamp + "40,3,1.500000,7,9,3.000000,mse,0.9",
      clamp + "40,3,1.500000,7,9,3.000000,energy_error,-0.1",
      clamp + "40,3,1.500000,7,9,3.000000,oracle_distance,0.000000",
      kl + "41,1,2.000000,0,0,2.000000,mse,0.6",
      kl + "41,1,2.000000,0,0,2.000000,energy_error,-0.02",
      kl + "41,2,3.000000,0,0,4.000000,mse,0.4",
      kl + "41,2,3.000000,0,0,4.000000,energy_error,-0.04",
      kl + "41,3,4.000000,7,9,8.000000,mse,0.4",
      kl + "41,3,4.000000,7,9,8.000000,energy_error,-0.04",
      kl + "41,3,4.000000,7,9,8.000000,oracle_distance,0.000000",
      twin + "41,1,2.000000,0,0,4.000000,mse,0.6",
      twin + "41,1,2.000000,0,0,4.000000,energy_error,0",
      twin + "41,3,5.000000,7,9,10.000000,mse,0.4",
      twin + "41,3,5.000000,7,9,10.000000,energy_error,0.01",
      twin + "41,3,5.000000,7,9,10.000000,oracle_distance,0.000000",
      clamp + "41,3,1.500000,7,9,3.000000,mse,0.9",
      clamp + "41,3,1.500000,7,9,3.000000,energy_error,-0.1",
      clamp + "41,3,1.500000,7,9,3.000000,oracle_distance,0.000000",
  };
  const Interval none = of_two(0.0, 0.0);
  JointLines(lines, uniform + "all,1,0.500000,40,2,1.000000")
      .point(of_two(1.6, 2.4), 0.02, 1.98, none);
  JointLines(lines, uniform + "all,4,2.000000,160,8,4.000000")
      .point(of_two(0.4, 0.6), 0.01, 0.49, none);
  JointLines(lines, uniform + "all,16,8.000000,640,32,16.000000")
      .point(of_two(0.1, 0.15), -0.001, 0.126, none);
  JointLines(lines, kl + "all,1,1.500000,80,4,2.000000")
      .point(of_two(0.5, 0.6), 0.1, 0.45, of_two(-0.02, -0.02));
  JointLines(lines, kl + "all,2,2.500000,160,8,4.000000")
      .point(of_two(0.3, 0.4), 0.05, 0.3, of_two(-0.04, -0.04));
  JointLines kl_end(lines, kl + "all,3,3.500000,280,14,7.000000");
  kl_end.point(of_two(0.2, 0.4), 0.2, 0.1, of_two(-0.06, -0.04));
  kl_end.of_uniform(geometric_of_two(0.75, 4.0 / 3.0));
  JointLines(lines, twin + "all,1,2.000000,160,8,4.000000")
      .point(of_two(0.6, 0.6), 0.01, 0.59, none);
  JointLines twin_end(lines, twin + "all,end,5.000000,400,20,10.000000");
  twin_end.point(of_two(0.4, 0.4), -0.01, 0.41, of_two(0.01, 0.01));
  twin_end.of_uniform(geometric_of_two(0.4 / 0.16, 0.4 / 0.24));
  JointLines clamp_end(lines, clamp + "all,3,1.500000,120,6,3.000000");
  clamp_end.point(of_two(0.9, 0.9), 0.8, 0.1, of_two(-0.1, -0.1));
  clamp_end.of_uniform(geometric_of_two(0.9 * 3 / 1.6, 0.9 * 3 / 2.4));
  clamp_end.number("relmse_top_thousandth", 0.625);

  // Numbers that are worked out in another order differ in their last digits.
  const std::vector<std::string> found = test::lines_in(sweep_csv(sweep.report));
  ASSERT_EQ(found.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t a = found[i].rfind(',');
    const std::size_t b = lines[i].rfind(',');
    EXPECT_EQ(found[i].substr(0, a), lines[i].substr(0, b)) << i;
    if (i > 0) {
      const double expected = std::stod(lines[i].substr(b + 1));
      EXPECT_NEAR(std::stod(found[i].substr(a + 1)), expected, 1e-7 + 1e-7 * std::abs(expected))
          << lines[i];
    }
  }
  test::expect_lines(calibration_csv(sweep.report),
                     {"scene,sampler,estimator,policy,mode,thresholds,seed,"
                      "estimated_error,true_squared_error,pixels",
                      kl + "40,0.5,0.25,60", kl + "40,2,4,70"});
}

TEST(SweepFiles, JsonHoldsEveryLineWithItsRole) {
  const HandSweep sweep;
  const auto json = nlohmann::json::parse(sweep_json(sweep.report));
  EXPECT_EQ(json.at("scene"), sweep.run.scene->scene().name);
  EXPECT_EQ(json.at("width"), 2);
  EXPECT_EQ(json.at("height"), 1);
  EXPECT_EQ(json.at("sampler"), "independent");
  EXPECT_EQ(json.at("command_line"), "quartet sweep");
  EXPECT_EQ(json.at("seeds"), 2);
  EXPECT_EQ(json.at("confidence"), 0.95);
  EXPECT_EQ(json.at("metric"), "mse");
  EXPECT_EQ(json.at("parts_of"), "mse");
  EXPECT_EQ(json.at("noise_floor"), 0.004);
  EXPECT_EQ(json.at("reference_spp"), 128);
  const auto& lanes = json.at("lanes");
  ASSERT_EQ(lanes.size(), 4u);
  const auto expect_lane = [&](std::size_t i, const std::string& id, const std::string& mode,
                               const std::string& role, std::size_t passes) {
    EXPECT_EQ(lanes[i].at("estimator"), id);
    EXPECT_EQ(lanes[i].at("mode"), mode);
    EXPECT_EQ(lanes[i].at("role"), role);
    EXPECT_EQ(lanes[i].at("factor"), 1.0);
    EXPECT_EQ(lanes[i].at("passes").size(), passes);
    EXPECT_TRUE(lanes[i].at("lane").get<std::string>().starts_with(id));
    EXPECT_EQ(lanes[i].contains("end"), i > 0);
  };
  expect_lane(0, "uniform", "reuse", "baseline", 3);
  expect_lane(1, "kl", "reuse", "method", 3);
  expect_lane(2, "kl", "unbiased", "unbiased twin, its pilot charged", 2);
  expect_lane(3, "uniform-clamp", "reuse", "baseline that loses light by design", 1);
  const auto expect_interval = [](const nlohmann::json& found, const Interval& expected) {
    EXPECT_NEAR(found.at("mean").get<double>(), expected.mean, 1e-9);
    EXPECT_NEAR(found.at("low").get<double>(), expected.low, 1e-7);
    EXPECT_NEAR(found.at("high").get<double>(), expected.high, 1e-7);
  };
  const auto& end = lanes[1].at("passes")[2];
  EXPECT_EQ(end.at("pass"), 3);
  EXPECT_EQ(end.at("seconds"), 3.5);
  EXPECT_EQ(end.at("mean_rays"), 140.0);
  EXPECT_EQ(end.at("mean_spp"), 7.0);
  expect_interval(end.at("error"), of_two(0.2, 0.4));
  expect_interval(end.at("energy_error"), of_two(-0.06, -0.04));
  EXPECT_EQ(end.at("squared_bias"), 0.2);
  EXPECT_EQ(end.at("variance"), 0.1);
  expect_interval(lanes[1].at("end").at("of_uniform").at("rays"),
                  geometric_of_two(0.75, 4.0 / 3.0));
  expect_interval(lanes[1].at("end").at("metrics").at("mse"), of_two(0.2, 0.4));
  EXPECT_TRUE(lanes[1].at("end").at("metrics").at("relmse_top_thousandth").is_null());
  EXPECT_EQ(lanes[3].at("end").at("metrics").at("relmse_top_thousandth"), 0.625);
  EXPECT_TRUE(lanes[2].at("passes")[1].at("pass").is_null());
}

TEST(SweepFiles, TableNamesEveryLineForWhatItIs) {
  const HandSweep sweep;
  const std::vector<std::string> lines = test::lines_in(sweep_table(sweep.summary));
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_TRUE(lines[0].starts_with("± and brackets: 95 % intervals over 2 seeds, each by itself."));
  const std::string kl(estimator(EstimatorId::kl).label);
  const auto row = [](const std::string& label, const char* factor, const char* spp,
                      const char* seconds, const char* error, const char* energy, const char* bias,
                      const char* variance, const char* ratio, const char* top, const char* note) {
    return fmt::format("{:<22} {:>6} {:>8} {:>8} {:>17} {:>15} {:>10} {:>10} {:>24} {:>5}  {}",
                       label, factor, spp, seconds, error, energy, bias, variance, ratio, top,
                       note);
  };
  EXPECT_EQ(lines[5], row(kl, "1", "7.00", "3.500", "0.3 ±1.3", "-5.00 ±12.71 %", "0.2", "0.1",
                          "1.000 (0.026 to 38.681)", "–", "at its default threshold"));
  EXPECT_EQ(lines[6], row("", "1", "10.00", "5.000", "0.4 ±0", "+1.00 ±0.00 %", "-0.01", "0.41",
                          "2.041 (0.155 to 26.830)", "–", "unbiased twin, its pilot charged"));
  EXPECT_EQ(lines[7],
            row(std::string(estimator(EstimatorId::uniform_clamp).label), "1", "3.00", "1.500",
                "0.9 ±0", "-10.00 ±0.00 %", "0.8", "0.1", "1.378 (0.105 to 18.110)", "62 %",
                "baseline that loses light by design"));
  EXPECT_EQ(lines[8], row("uniform", "", "4.00", "2.000", "0.5 ±1.3", "+0.00 ±0.00 %", "0.01",
                          "0.49", "1.000 (1.000 to 1.000)", "–", "baseline"));
  EXPECT_EQ(lines[9], row("", "", "16.00", "8.000", "0.125 ±0.32", "+0.00 ±0.00 %", "-0.001",
                          "0.126", "1.000 (1.000 to 1.000)", "–", "baseline, where it ends"));
}

}  // namespace
}  // namespace quartet
