#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "renderer/adaptive/estimators/estimator.h"
#include "renderer/study/regions.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"
#include "tests/records/csv.h"

namespace quartet {
namespace {

/// A cache of its own, so that tests neither read nor leave references elsewhere.
class SweepCommands : public testing::Test {
 protected:
  SweepCommands() { ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1); }
  ~SweepCommands() override { ::unsetenv("XDG_CACHE_HOME"); }

  std::vector<std::string> sweep(std::vector<std::string> more) const {
    std::vector<std::string> words{"sweep", "cornell-box", "--size",  "16x16", "--passes",     "4",
                                   "--spp", "10",          "--seeds", "2",     "--thresholds", "3"};
    if (std::ranges::find(more, "--reference") == more.end()) {
      words.insert(words.end(), {"--reference-spp", "32"});
    }
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string out() const { return (folder_.path() / "out").string(); }

  TempFolder folder_;
};

TEST_F(SweepCommands, SweepWritesItsFilesAndPrintsWhatWasSaved) {
  const auto result = run(sweep({"--estimators", "kl,contrast", "--out", out()}));
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find("traced samples / samples used: "), std::string::npos);
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(out())) {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names,
            (std::set<std::string>{"sweep.csv", "sweep.json", "sweep.png", "sweep.pdf", "sweep.svg",
                                   "thresholds.png", "thresholds.pdf", "thresholds.svg",
                                   "calibration.csv", "calibration.png", "calibration.pdf",
                                   "calibration.svg", "quartet-files.txt"}));
  const auto rows = rows_of(bytes_of(folder_.path() / "out" / "sweep.csv"));
  EXPECT_EQ(rows[0], (std::vector<std::string>{"scene", "sampler", "estimator", "policy", "mode",
                                               "thresholds", "seed", "pass", "seconds", "rays",
                                               "samples", "mean_spp", "metric", "value"}));
  std::map<std::string, int> metrics;
  std::set<std::string> seeds;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 14u) << i;
    EXPECT_EQ(rows[i][0], "cornell-box");
    EXPECT_EQ(rows[i][1], "sobol");
    seeds.insert(rows[i][6]);
    metrics[rows[i][2] + (rows[i][4] == "unbiased" ? "~ " : " ") + rows[i][12] +
            (rows[i][6] == "all" ? " all" : "")]++;
    EXPECT_TRUE(std::isfinite(std::stod(rows[i][13])));
  }
  EXPECT_EQ(seeds, (std::set<std::string>{"0", "1", "all"}));
  for (const std::string lane : {"kl ", "kl~ ", "contrast ", "oracle ", "oracle~ "}) {
    for (const std::string name :
         {"relmse", "mse", "flip", "relmse_top_thousandth", "oracle_distance"}) {
      EXPECT_EQ(metrics[lane + name], 3 * 2) << lane << name << ": ends alone";
    }
    EXPECT_EQ(metrics[lane + "relmse all"], 3);
  }
  EXPECT_EQ(metrics["uniform-clamp relmse"], 2);
  EXPECT_EQ(metrics["uniform-clamp~ relmse"], 0) << "nothing decides there";
  // After passes 1, 2, 3 and at the end, which is the fourth or has 10 samples a pixel.
  EXPECT_GT(metrics["kl relmse_regions"], 2 * 3 * 2);
  EXPECT_LE(metrics["kl relmse_regions"], 4 * 3 * 2);
  EXPECT_EQ(metrics["kl energy_error"], metrics["kl relmse_regions"]);
  EXPECT_EQ(metrics["kl relmse_regions_squared_bias all"], metrics["kl relmse_regions_low all"]);
  EXPECT_EQ(metrics["kl relmse_regions_of_uniform_rays all"], 3);
  // The baseline at passes 1, 2, 4, 8 at least.
  EXPECT_GE(metrics["uniform relmse"], 4 * 2);
  EXPECT_EQ(metrics["uniform energy_error"], metrics["uniform relmse"]);
  EXPECT_GT(rows_of(bytes_of(folder_.path() / "out" / "calibration.csv")).size(), 10u);
}

TEST_F(SweepCommands, TwinsAndAxisAreChosen) {
  const auto none = run(sweep({"--estimators", "kl", "--twins", "none", "--metric", "mse", "--axis",
                               "seconds", "--out", out()}));
  ASSERT_EQ(none.code, 0) << none.error;
  EXPECT_EQ(none.out.find("unbiased twin"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("bound: knows the truth"), std::string::npos);
  EXPECT_NE(none.out.find("baseline that loses light"), std::string::npos);
  EXPECT_NE(bytes_of(out() + "/sweep.csv").find("mse_variance"), std::string::npos);
  const auto json = nlohmann::json::parse(bytes_of(out() + "/sweep.json"));
  EXPECT_EQ(json.at("lanes").size(), 1u + 3u + 3u + 1u) << "uniform, kl, the oracle, the clamp";
  expect_usage_error(sweep({"--out", out(), "--twins", "some"}), "there are: none, default, all");
  expect_usage_error(sweep({"--out", out(), "--axis", "miles"}), "there are: seconds, rays, spp");
}

TEST_F(SweepCommands, SumsThatOutgrowMemoryAreTold) {
  const auto result =
      run({"sweep",    "cornell-box", "--size",       "64x64", "--passes",        "2",
           "--seeds",  "2",           "--thresholds", "1",     "--estimators",    "kl",
           "--metric", "mse",         "--twins",      "none",  "--reference-spp", "4",
           "--memory", "0.001",       "--out",        out()});
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.error.find("bias² and variance of mse are those at the ends"), std::string::npos)
      << result.error;
}

TEST_F(SweepCommands, VerifyTimeComparesWithRunsAlone) {
  const auto result = run(sweep({"--estimators", "kl", "--verify-time", "--out", out()}));
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find("as if alone"), std::string::npos);
  EXPECT_NE(result.out.find("% on average"), std::string::npos);
}

TEST_F(SweepCommands, SweepIsTheSameWithAnyNumberOfThreads) {
  std::vector<std::vector<std::vector<std::string>>> sweeps;
  std::vector<std::string> calibrations;
  for (const std::string threads : {"1", "2", "8"}) {
    const auto result = run(sweep({"--estimators", "kl,variance", "--mode", "unbiased", "--threads",
                                   threads, "--out", out() + threads}));
    ASSERT_EQ(result.code, 0) << result.error;
    sweeps.push_back(without_seconds(bytes_of(out() + threads + "/sweep.csv")));
    std::erase_if(sweeps.back(), [](const std::vector<std::string>& row) {
      return row[11].find("_of_uniform_seconds") != std::string::npos;
    });
    calibrations.push_back(bytes_of(out() + threads + "/calibration.csv"));
    EXPECT_EQ(sweeps.back(), sweeps.front());
    EXPECT_EQ(calibrations.back(), calibrations.front());
  }
  EXPECT_GT(sweeps.front().size(), 50u);
}

TEST_F(SweepCommands, RejectedSamplesAreToldInOneLine) {
  const auto expect_told = [](const Result& result) {
    ASSERT_EQ(result.code, 0) << result.error;
    const std::size_t told = result.error.find("samples were NaN, infinite or negative");
    ASSERT_NE(told, std::string::npos) << result.error;
    EXPECT_EQ(result.error.find("samples were", told + 8), std::string::npos) << result.error;
    EXPECT_NE(result.error.find("quartet trace synthetic:non-finite --size 8x8"), std::string::npos)
        << result.error;
  };
  expect_told(
      run({"sweep", "synthetic:non-finite", "--size", "8x8", "--reference-spp", "4", "--passes",
           "4", "--seeds", "2", "--thresholds", "1", "--estimators", "kl", "--out", out()}));
  expect_told(run(
      {"calibrate", "synthetic:non-finite", "--size", "8x8", "--spp", "20", "--estimators", "kl"}));
}

TEST_F(SweepCommands, SweepRefusesBadInput) {
  expect_usage_error(sweep({"--out", out(), "--range", "2:1"}), "--range: '2:1' is no range");
  expect_usage_error(sweep({"--out", out(), "--range", "0:1"}), "LOW:HIGH");
  expect_usage_error(sweep({"--out", out(), "--range", "nan:1"}), "LOW:HIGH");
  expect_usage_error(sweep({"--out", out(), "--range", "1"}), "LOW:HIGH");
  expect_usage_error(sweep({"--out", out(), "--metric", "beauty"}), "there are: mse");
  expect_usage_error(sweep({"--out", out(), "--estimators", "none"}), "there are: contrast");
  expect_usage_error(sweep({"--out", out(), "--seeds", "0"}), "--seeds");
  expect_usage_error(sweep({"--out", out(), "--thresholds", "-1"}), "--thresholds");
  expect_usage_error(sweep({}), "--out");
  const auto missing = run(sweep({"--out", out(), "--reference", "/nowhere/ref.exr"}));
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.error.find("/nowhere/ref.exr"), std::string::npos);
  ASSERT_EQ(
      run({"reference", "cornell-box", "--size", "8x8", "--spp", "4", "-o", out() + ".exr"}).code,
      0);
  const auto size = run(sweep({"--out", out(), "--reference", out() + ".exr"}));
  EXPECT_EQ(size.code, 1);
  EXPECT_NE(size.error.find("it has 8x8 pixels, the run has 16x16"), std::string::npos)
      << size.error;
  EXPECT_FALSE(std::filesystem::exists(out())) << "nothing half-written";
  const auto unwritable = run(sweep({"--out", "/proc/nowhere"}));
  EXPECT_EQ(unwritable.code, 1);
  EXPECT_EQ(std::ranges::count(unwritable.error, '\n'), 1) << unwritable.error;
}

TEST_F(SweepCommands, CalibrateMeetsABudgetThatItsLanesReproduce) {
  const auto result = run({"calibrate", "cornell-box", "--size", "48x48", "--spp", "12", "--passes",
                           "8", "--estimators", "kl,contrast,uniform", "--json"});
  ASSERT_EQ(result.code, 0) << result.error;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("budget"), "12 spp");
  ASSERT_EQ(json.at("estimators").size(), 3u);
  for (const auto& entry : json.at("estimators")) {
    EXPECT_TRUE(entry.at("met").get<bool>()) << entry.dump();
    EXPECT_NEAR(entry.at("mean_spp").get<double>(), 12.0, 0.13);
    const Estimator& row = find_estimator(entry.at("estimator").get<std::string>());
    EXPECT_EQ(entry.at("passes"), row.channels > 0 ? 8 : 12);
    EXPECT_EQ(entry.at("thresholds").size(), std::size_t(row.channels));
    for (std::size_t c = 0; c < std::size_t(row.channels); ++c) {
      EXPECT_FLOAT_EQ(entry.at("thresholds")[c].get<float>(),
                      float(double(row.default_thresholds[c]) * entry.at("factor").get<double>()));
    }
    EXPECT_GT(entry.at("seconds").get<double>(), 0.0);
    EXPECT_GE(entry.at("runs"), 1);
    EXPECT_FALSE(entry.contains("reason"));
  }
  EXPECT_EQ(json.at("scene"), "cornell-box");
  EXPECT_EQ(json.at("passes"), 8);
  const auto figure = run({"figure", "cornell-box", "--size", "48x48", "--passes", "8", "--lane",
                           json.at("estimators")[0].at("lane").get<std::string>(), "--out", out()});
  ASSERT_EQ(figure.code, 0) << figure.error;
  const auto panels = nlohmann::json::parse(bytes_of(folder_.path() / "out" / "panels.json"));
  EXPECT_DOUBLE_EQ(panels.at("lanes")[0].at("history").back().at("mean_spp").get<double>(),
                   json.at("estimators")[0].at("mean_spp").get<double>());
}

TEST_F(SweepCommands, CalibrateSaysWhatCannotBeMet) {
  const auto result =
      run({"calibrate", "cornell-box", "--size", "16x16", "--spp", "6", "--estimators", "kl,cycles",
           "--first-samples", "2", "--batch-samples", "1"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.error, "quartet: 6 spp cannot be met by kl\n");
  EXPECT_NE(result.out.find("kl: 6 spp cannot be met: 15 passes of vote take at least 15 spp"),
            std::string::npos)
      << result.out;
  // The command is of the other one, and says so where it can be pasted into a shell.
  const std::size_t command = result.out.find("quartet figure ");
  ASSERT_NE(command, std::string::npos) << result.out;
  EXPECT_NE(result.out.find("--lane cycles:", command), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("--out DIR  # without kl: cannot meet 6 spp\n", command),
            std::string::npos)
      << result.out;
  expect_usage_error({"calibrate", "cornell-box"}, "no budget given");
  expect_usage_error({"calibrate", "cornell-box", "--spp", "3", "--seconds", "2"},
                     "more than one budgets are given");
  expect_usage_error({"calibrate", "cornell-box", "--error", "relmse"}, "METRIC=VALUE");
  expect_usage_error({"calibrate", "cornell-box", "--spp", "nan"}, "--spp");
}

TEST_F(SweepCommands, CalibrateShowsUniformWhereItWasNotAskedFor) {
  const std::vector<std::string> words{"calibrate", "cornell-box", "--size",   "16x16",
                                       "--spp",     "9.5",         "--passes", "6"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  // Whole passes do not come to 9.5, which is no fault of who did not ask for them.
  const auto json_run = with({"--estimators", "cycles", "--policy", "batch", "--first-samples", "2",
                              "--batch-samples", "1", "--json"});
  const auto json = nlohmann::json::parse(json_run.out);
  ASSERT_EQ(json.at("estimators").size(), 2u);
  const auto& lane = json.at("estimators")[0];
  const auto& uniform = json.at("estimators")[1];
  EXPECT_FALSE(lane.at("baseline").get<bool>());
  EXPECT_EQ(uniform.at("estimator"), "uniform");
  EXPECT_TRUE(uniform.at("baseline").get<bool>());
  EXPECT_FALSE(uniform.at("met").get<bool>());
  EXPECT_NE(uniform.at("mean_spp"), 9.5);
  EXPECT_EQ(json_run.code, lane.at("met").get<bool>() ? 0 : 1) << json_run.error;

  const auto asked = with({"--estimators", "kl,uniform"});
  EXPECT_EQ(asked.code, 1);
  EXPECT_EQ(asked.error, "quartet: 9.5 spp cannot be met by uniform\n");
  EXPECT_EQ(asked.out.find("for comparison"), std::string::npos) << asked.out;
  const auto not_asked = with({"--estimators", "kl"});
  EXPECT_EQ(not_asked.code, 0) << not_asked.error;
  EXPECT_NE(not_asked.out.find("\nuniform, for comparison: whole passes come no nearer than "),
            std::string::npos)
      << not_asked.out;
  EXPECT_EQ(not_asked.out.find("# without"), std::string::npos) << not_asked.out;
}

TEST_F(SweepCommands, CalibrateTellsBetterThanAskedFromCannot) {
  const auto with = [&](const std::string& error) {
    return run({"calibrate", "cornell-box", "--size", "16x16", "--error", error, "--passes", "4",
                "--estimators", "kl,contrast", "--reference-spp", "64"});
  };
  const auto better = with("relmse=50");
  EXPECT_EQ(better.code, 0) << better.error;
  EXPECT_NE(better.out.find("\nkl: already better than asked at every threshold; the cheapest"),
            std::string::npos)
      << better.out;
  EXPECT_EQ(better.out.find("cannot"), std::string::npos) << better.out;
  const auto cannot = with("relmse=1e-7");
  EXPECT_EQ(cannot.code, 1);
  EXPECT_EQ(cannot.error, "quartet: relmse 1e-7 cannot be met by kl, contrast\n");
  EXPECT_NE(cannot.out.find("kl: relmse 1e-7 cannot be met: 4 passes of vote come no nearer than"),
            std::string::npos)
      << cannot.out;
  EXPECT_NE(cannot.out.find("\nuniform, for comparison: "), std::string::npos) << cannot.out;
}

TEST_F(SweepCommands, CalibrateMeetsAnErrorAgainstAReferenceThatItMakes) {
  const auto result =
      run({"calibrate", "cornell-box", "--size", "24x24", "--error", "relmse=0.02", "--passes", "8",
           "--estimators", "kl", "--reference-spp", "64", "--json"});
  const auto entry = nlohmann::json::parse(result.out).at("estimators")[0];
  EXPECT_EQ(result.code, entry.at("met").get<bool>() ? 0 : 1) << result.error;
  EXPECT_TRUE(entry.contains("relmse"));
  EXPECT_NE(entry.at("met").get<bool>(), entry.contains("reason"));
}

TEST_F(SweepCommands, ClaimsJudgesEveryFinding) {
  const std::string csv = (folder_.path() / "claims.csv").string();
  const std::vector<std::string> words{"claims", "--size",  "64x36", "--passes",
                                       "4",      "--seeds", "2",     "--reference-spp",
                                       "32",     "--csv",   csv};
  const auto text = run(words);
  ASSERT_EQ(text.code, 0) << text.error;
  for (int finding = 1; finding <= 5; ++finding) {
    EXPECT_NE(text.out.find("Finding " + std::to_string(finding) + ": "), std::string::npos);
  }
  EXPECT_NE(text.out.find("ceiling"), std::string::npos);
  const auto rows = rows_of(bytes_of(csv));
  double share = 0.0;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 9u);
    share += row[5] == "share" && row[2] == "kl" ? std::stod(row[6]) : 0.0;
  }
  EXPECT_NEAR(share, 1.0, 1e-6);
  std::vector<std::string> as_json = words;
  as_json.emplace_back("--json");
  const auto json = nlohmann::json::parse(run(as_json).out);
  EXPECT_EQ(json.at("findings").size(), 6u);
  EXPECT_EQ(json.at("seeds"), 2);

  const auto other = run({"claims", "veach-plates", "--size", "16x9"});
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.error.find("has no shape 'ceiling'"), std::string::npos) << other.error;
}

}  // namespace
}  // namespace quartet
