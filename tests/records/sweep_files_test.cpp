#include "app/records/sweep_files.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/records/study_cases.h"

namespace quartet {
namespace {

Measurement counted_measurement(std::uint32_t pass, double first) {
  Measurement measurement;
  measurement.record.pass = pass;
  measurement.record.rays = std::uint64_t(first) + 4;
  measurement.record.samples = std::uint64_t(first) + 1;
  measurement.record.seconds = first + 0.5;
  measurement.mean_spp = first + 0.25;
  measurement.values = {first + 2, first + 3};
  measurement.energy = first + 4;
  return measurement;
}

TEST(SweepFiles, EveryColumnHoldsItsOwnNumber) {
  const auto run = test::tiny_run();
  const std::string scene = run.scene->scene().name;
  SweepPlan plan;
  plan.metrics = {MetricId::mse, MetricId::flip};
  SweepResult result;
  result.first_seed = 40;
  result.uniform = {{counted_measurement(1, 10), counted_measurement(2, 20)},
                    {counted_measurement(1, 30)}};
  for (const std::uint64_t seed : {40, 41}) {
    SweepRun each{
        .settings = test::kl_settings(0.25f, SampleMode::unbiased), .factor = 2.0, .seed = seed};
    each.end = counted_measurement(5, seed == 40 ? 40 : 50);
    each.quality.rank_correlation = seed == 40 ? 0.125 : std::nan("");
    each.quality.stops = {8, 2, seed == 40 ? 3u : 5u};
    each.oracle_distance = seed == 40 ? 0.75 : 0.625;
    each.quality.calibration = {{double(seed) + 0.1, double(seed) + 0.2, 60 + seed},
                                {double(seed) + 0.3, double(seed) + 0.4, 70 + seed}};
    result.runs.push_back(each);
  }
  const SweepReport report{run, plan, result, 0.0, 0, "quartet sweep"};
  const std::string uniform = scene + ",independent,uniform,vote,reuse,,";
  const std::string kl = scene + ",independent,kl,converge,unbiased,0.25,";
  test::expect_lines(
      sweep_csv(report),
      {
          ("scene,sampler,estimator,policy,mode,thresholds,seed,pass,seconds,rays,samples,"
           "mean_spp,metric,value"),
          uniform + "40,1,10.500000,14,11,10.250000,mse,12",
          uniform + "40,1,10.500000,14,11,10.250000,flip,13",
          uniform + "40,1,10.500000,14,11,10.250000,energy_error,14",
          uniform + "40,2,20.500000,24,21,20.250000,mse,22",
          uniform + "40,2,20.500000,24,21,20.250000,flip,23",
          uniform + "40,2,20.500000,24,21,20.250000,energy_error,24",
          uniform + "41,1,30.500000,34,31,30.250000,mse,32",
          uniform + "41,1,30.500000,34,31,30.250000,flip,33",
          uniform + "41,1,30.500000,34,31,30.250000,energy_error,34",
          kl + "40,5,40.500000,44,41,40.250000,mse,42",
          kl + "40,5,40.500000,44,41,40.250000,flip,43",
          kl + "40,5,40.500000,44,41,40.250000,energy_error,44",
          kl + "40,5,40.500000,44,41,40.250000,rank_correlation,0.125000",
          kl + "40,5,40.500000,44,41,40.250000,false_stops,0.375000",
          kl + "40,5,40.500000,44,41,40.250000,oracle_distance,0.750000",
          kl + "41,5,50.500000,54,51,50.250000,mse,52",
          kl + "41,5,50.500000,54,51,50.250000,flip,53",
          kl + "41,5,50.500000,54,51,50.250000,energy_error,54",
          kl + "41,5,50.500000,54,51,50.250000,false_stops,0.625000",
          kl + "41,5,50.500000,54,51,50.250000,oracle_distance,0.625000",
      });
  const std::string header =
      "scene,sampler,estimator,policy,mode,thresholds,seed,"
      "estimated_error,true_squared_error,pixels";
  test::expect_lines(calibration_csv(report),
                     {header, kl + "40,40.1,40.2,100", kl + "40,40.3,40.4,110",
                      kl + "41,41.1,41.2,101", kl + "41,41.3,41.4,111"});
}

}  // namespace
}  // namespace quartet
