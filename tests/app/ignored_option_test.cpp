// Options that would change nothing are refused, with what they would need.

#include <gtest/gtest.h>

#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

struct Ignored {
  std::vector<std::string> words;
  std::string message;
};

TEST(IgnoredOptions, AreRefused) {
  const TempFolder folder;
  const std::string exr = (folder / "a.exr").string();
  const std::string png = (folder / "a.png").string();
  const std::string out = (folder / "out").string();
  const std::vector<std::string> synthetic{"render", "synthetic:constant", "-o", exr};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const std::vector<std::string> render{"render", "cornell-box", "-o", exr};
  const std::vector<std::string> shot{"screenshot", "cornell-box", "-o", png};
  const std::vector<std::string> bias{"bias", "cornell-box", "--out", out};
  const std::vector<Ignored> all{
      {with(synthetic, {"--integrator", "mis"}), "--integrator has no effect"},
      {with(synthetic, {"--sampler", "independent"}), "--sampler has no effect"},
      {with(synthetic, {"--rays", "10"}), "--rays has no effect"},
      {with(synthetic, {"--max-depth", "3"}), "--max-depth has no effect"},
      {with(synthetic, {"--camera=0,0,0,1,0,0,0,1,0,0,0,1"}), "--camera has no effect"},
      {with(synthetic, {"-D", "a=1"}), "-D: synthetic:constant: takes no parameters"},
      {with(render, {"-D", "a=1"}), "has no parameter 'a'"},
      {{"info", "cornell-box", "-D", "a=1"}, "has no parameter 'a'"},
      {with(render, {"--reference", ""}), "the word after '--reference' is empty"},
      {with(render, {"--reference="}), "'--reference=' has no value"},
      {{"figure", "cornell-box", "--out", ""}, "the word after '--out' is empty"},
      {{"trace", "synthetic:constant", "--pixel", "1,1", "--integrator", "mis"},
       "--integrator has no effect"},
      {with(render, {"--first-samples", "4"}), "--first-samples has no effect"},
      {with(render, {"--policy", "vote"}), "uniform estimates no error"},
      {with(render, {"--estimator", "kl", "--batch-samples", "0"}), "kl runs under vote"},
      {with(render, {"--estimator", "cycles", "--multiplier", "4"}), "cycles runs under converge"},
      {with(render, {"--estimator", "cycles", "--stochastic-rounding"}), "policy vote"},
      {with(render, {"--spp", "100", "--max-spp", "20"}), "--spp 100: never reached"},
      {with(shot, {"--metric", "mse"}), "--reference"},
      {with(shot, {"--views", "error", "--heat", "report"}), "--heat has no effect"},
      {with(shot, {"--views", "heatmap", "--exposure", "1"}), "--exposure has no effect"},
      {with(shot, {"--views", "heatmap,error", "--tone-map", "filmic"}),
       "--tone-map has no effect"},
      {with(shot, {"--views", "image,reference"}), "--views reference has no effect"},
      {with(shot, {"--views", "true-error"}), "--views true-error has no effect"},
      {with(shot, {"--estimators", "kl", "--views", "difference"}),
       "--views difference has no effect: it is for two lanes or more"},
      {with(shot, {"--estimators", "kl,chi2,hellinger,contrast,cycles"}),
       "--estimators: 5 lanes are more than the 4"},
      {with(shot, {"--lane", "kl", "--lane", "kl", "--lane", "kl", "--lane", "kl", "--lane", "kl"}),
       "--lane: 5 lanes are more than the 4"},
      {with(shot, {"--lane", "kl", "--estimators", "kl"}), "--lane"},
      {with(shot, {"--size", "16385x600"}), "at most 16384x16384"},
      {with(bias, {"--mode", "reuse"}), "--mode"},
      {with(bias, {"--lane", "kl:mode=reuse"}), "both modes"},
      {{"claims", "--policy", "vote"}, "--policy"},
      {{"claims", "--multiplier", "1"}, "--multiplier"},
      {{"claims", "--max-spp", "100"}, "--max-spp"},
      {{"claims", "--reference", exr, "--reference-spp", "8"}, "--reference-spp"},
      {{"sweep", "cornell-box", "--out", out, "--reference", exr, "--reference-spp", "8"},
       "--reference-spp"},
      {{"calibrate", "cornell-box", "--spp", "20", "--reference-spp", "8"}, "--error"},
      {{"calibrate", "cornell-box", "--spp", "20", "--reference", exr},
       "--reference has no effect"},
      {{"calibrate", "cornell-box", "--spp", "20", "--estimators", "uniform", "--passes", "9"},
       "--passes has no effect"},
      {{"compare", exr, exr, "--metric", "mse"}, "--picture"},
      {{"--ui-scale", "2", "list"}, "--ui-scale has no effect before list"},
      {{"--reset-settings", "list"}, "--reset-settings has no effect before list"},
      {{"furnace", "list"}, "'furnace' has no effect before list"}};
  for (const Ignored& each : all) {
    expect_usage_error(each.words, each.message);
  }
  EXPECT_EQ(names_in(folder.path()), std::set<std::string>());
}

}  // namespace
}  // namespace quartet
