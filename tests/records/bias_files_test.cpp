#include "app/records/bias_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "renderer/base/version.h"
#include "renderer/files/exr.h"
#include "tests/files/temp_folder.h"
#include "tests/records/study_cases.h"

namespace quartet {
namespace {

BiasRuns counted_bias(SampleMode mode, float first) {
  BiasRuns runs;
  runs.settings = test::kl_settings(0.25f, mode);
  runs.mean_spp = {first + 1, first + 2};
  runs.mean_rays = {first + 6, first + 8};
  runs.seconds = {first + 3, first + 5};
  runs.luminance = {9, 11};
  runs.uniform_luminance = {8, 8};
  runs.mean = RadianceImage(2, 1, glm::vec3(first));
  runs.uniform = RadianceImage(2, 1);
  runs.uniform.pixels()[0] = {first + 10, first + 11, first + 12};
  runs.uniform.pixels()[1] = {first + 13, first + 14, first + 15};
  runs.difference = ScalarImage(2, 1);
  runs.difference.pixels()[0] = first + 20;
  runs.difference.pixels()[1] = first + 21;
  runs.standard_error = ScalarImage(2, 1);
  runs.standard_error.pixels()[0] = first + 22;
  runs.standard_error.pixels()[1] = first + 23;
  runs.noise = first + 0.5;
  return runs;
}

TEST(BiasFiles, EveryColumnAndChannelHoldsItsOwnNumber) {
  const TempFolder folder;
  const auto run = test::tiny_run();
  const std::vector<BiasRuns> all{counted_bias(SampleMode::reuse, 100),
                                  counted_bias(SampleMode::unbiased, 200),
                                  counted_bias(SampleMode::reuse, 300)};
  const BiasReport report{run, all, 6, 0.875, "quartet bias"};
  {
    StagedFiles files(folder.path());
    write_bias_files(files, report);
    files.commit();
  }
  const std::string head = run.scene->scene().name + ",independent,kl,converge,";
  // Each of the three intervals misses with probability 1 − 0.875^(1/3). Of two values t is
  // Cauchy's, and the standard error of their mean half their distance.
  const double rate = 1.0 - std::cbrt(0.875);
  const double half = 0.125 * std::tan(0.5 * M_PI * (1.0 - rate));
  const double p = 1.0 - 2.0 / M_PI * std::atan(0.25 / 0.125);
  std::vector<std::string> expected{
      "scene,sampler,estimator,policy,mode,thresholds,seed,pass,seconds,rays,samples,mean_spp,"
      "metric,value"};
  for (const auto& [mode, first] : {std::tuple{"reuse", 100}, {"unbiased", 200}, {"reuse", 300}}) {
    const std::string lane = head + mode + ",0.25,";
    expected.push_back(fmt::format("{}40,6,{}.000000,{},{},{}.000000,energy_less_uniform,0.125",
                                   lane, first + 3, 2 * (first + 6), 2 * (first + 1), first + 1));
    expected.push_back(fmt::format("{}41,6,{}.000000,{},{},{}.000000,energy_less_uniform,0.375",
                                   lane, first + 5, 2 * (first + 8), 2 * (first + 2), first + 2));
    const std::string both = fmt::format("{}all,6,{}.000000,{},{},{}.500000,", lane, first + 4,
                                         2 * first + 14, 2 * first + 3, first + 1);
    expected.push_back(both + "energy_less_uniform,0.25");
    expected.push_back(both + fmt::format("energy_less_uniform_low,{:.9g}", 0.25 - half));
    expected.push_back(both + fmt::format("energy_less_uniform_high,{:.9g}", 0.25 + half));
    expected.push_back(both + fmt::format("energy_p,{:.9g}", p));
    expected.push_back(both + fmt::format("noise,{}.5", first));
  }
  test::expect_lines(bytes_of(folder / "bias.csv"), expected);

  const ExrImage exr = read_exr(folder / "bias.exr");
  const auto expect_channel = [&](const char* name, std::vector<float> values) {
    const ExrChannel* channel = exr.find(name);
    ASSERT_NE(channel, nullptr) << name;
    EXPECT_EQ(std::get<std::vector<float>>(channel->pixels), values) << name;
  };
  EXPECT_EQ(exr.channels.size(), 9u);
  expect_channel("R", {110, 113});
  expect_channel("G", {111, 114});
  expect_channel("B", {112, 115});
  expect_channel("Bias.kl.reuse", {120, 121});
  expect_channel("BiasError.kl.reuse", {122, 123});
  expect_channel("Bias.kl.unbiased", {220, 221});
  expect_channel("BiasError.kl.unbiased", {222, 223});
  expect_channel("Bias.kl.reuse-2", {320, 321});
  expect_channel("BiasError.kl.reuse-2", {322, 323});
  EXPECT_EQ(exr.attributes.at("scene"), run.scene->scene().name);
  EXPECT_EQ(exr.attributes.at("version"), version());
  EXPECT_EQ(exr.attributes.at("commandLine"), "quartet bias");
  EXPECT_EQ(energy_text(report, all[0]), fmt::format("+25.000 % ± {:.3f} %", 100.0 * half));
}

}  // namespace
}  // namespace quartet
