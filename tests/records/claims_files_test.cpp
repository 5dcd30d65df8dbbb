#include "app/records/claims_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/records/csv.h"
#include "tests/records/study_cases.h"
#include "tests/study/claim_data.h"

namespace quartet {
namespace {

/// The two values that the seeds have of a quantity.
struct TwoSeeds {
  std::string region;
  std::size_t pixels;
  std::string name;
  std::array<std::pair<double, double>, report_criterion_count> values;
  bool geometric = false;
};

std::vector<TwoSeeds> expected_quantities(const ClaimData& data) {
  std::vector<TwoSeeds> all;
  const auto add = [&](const std::string& region, std::size_t pixels, const std::string& name,
                       const auto& value, bool geometric = false) {
    TwoSeeds made{region, pixels, name, {}, geometric};
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      made.values[c] = {value(data.seeds[0].runs[c]), value(data.seeds[1].runs[c])};
    }
    all.push_back(made);
  };
  for (std::size_t r = 0; r < regions().size(); ++r) {
    if (data.pixels[r] > 0) {
      const std::string id(regions()[r].id);
      add(id, data.pixels[r], "mean_spp", [r](const ClaimRun& run) { return run.spp[r]; });
      add(id, data.pixels[r], "share", [r](const ClaimRun& run) { return run.share[r]; });
    }
  }
  add("all", 2, "mean_spp", [](const ClaimRun& run) { return run.mean_spp; });
  add("all", 2, "lit_mean_spp", [](const ClaimRun& run) { return run.lit_spp; });
  add("all", 2, "seconds", [](const ClaimRun& run) { return run.seconds; });
  add("all", 2, "relmse", [](const ClaimRun& run) { return run.relmse; });
  add("all", 2, "relmse_top_thousandth", [](const ClaimRun& run) { return run.relmse_top; });
  add("all", 2, "flip", [](const ClaimRun& run) { return run.flip; });
  add("all", 2, "energy_error", [](const ClaimRun& run) { return run.energy; });
  add(
      "all", 2, "relmse_of_uniform_at_equal_time",
      [](const ClaimRun& run) { return run.relmse / run.uniform_relmse; }, true);
  add(
      "all", 2, "flip_of_uniform_at_equal_time",
      [](const ClaimRun& run) { return run.flip / run.uniform_flip; }, true);
  return all;
}

/// At 95 %: of two values t is Cauchy's, and the standard error of their mean half their distance.
Interval interval_of(const std::pair<double, double>& values, bool geometric) {
  const double t = std::tan(0.475 * M_PI);
  const auto& [a, b] = values;
  if (geometric) {
    const double middle = std::sqrt(a * b);
    const double factor = std::pow(std::max(a, b) / middle, t);
    return {middle, middle / factor, middle * factor};
  }
  const double half = t * 0.5 * std::abs(a - b);
  return {0.5 * (a + b), 0.5 * (a + b) - half, 0.5 * (a + b) + half};
}

void expect_same_interval(const Interval& a, const Interval& b) {
  EXPECT_NEAR(a.mean, b.mean, 1e-7 * std::abs(b.mean));
  EXPECT_NEAR(a.low, b.low, 1e-6 * (std::abs(b.low) + std::abs(b.mean)));
  EXPECT_NEAR(a.high, b.high, 1e-6 * (std::abs(b.high) + std::abs(b.mean)));
}

TEST(ClaimsFiles, EveryColumnHoldsItsOwnNumber) {
  const auto run = test::tiny_run();
  ClaimData data = test::numbered_claim_data();
  data.pixels[4] = 0;  // a region that the picture does not show
  const std::string csv = claims_csv({run, data, 15, 300, "quartet claims"});
  const auto rows = rows_of(csv);
  EXPECT_EQ(test::lines_in(csv).front(),
            "scene,sampler,criterion,region,pixels,quantity,mean,low,high");
  const std::vector<TwoSeeds> expected = expected_quantities(data);
  ASSERT_EQ(rows.size(), 1 + expected.size() * report_criterion_count);
  std::size_t line = 1;
  for (const TwoSeeds& each : expected) {
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      const auto& row = rows[line++];
      ASSERT_EQ(row.size(), 9u);
      EXPECT_EQ(row[0], run.scene->scene().name);
      EXPECT_EQ(row[1], "independent");
      EXPECT_EQ(row[2], estimator(report_criteria[c]).id);
      EXPECT_EQ(row[3], each.region);
      EXPECT_EQ(row[4], std::to_string(each.pixels));
      EXPECT_EQ(row[5], each.name);
      SCOPED_TRACE(row[2] + " " + each.region + " " + each.name);
      expect_same_interval({std::stod(row[6]), std::stod(row[7]), std::stod(row[8])},
                           interval_of(each.values[c], each.geometric));
    }
  }
}

TEST(ClaimsFiles, ARaceIsToldWithItsEnergy) {
  const auto run = test::tiny_run();
  const std::string text =
      claims_text({run, test::numbered_claim_data(), 15, 300, "quartet claims"});
  // Of contrast −1 and −3 %, whose interval is 12.706 % wide to either side.
  EXPECT_NE(text.find("; energy -2.00 % (-14.71 to +10.71)\n"), std::string::npos) << text;
}

TEST(ClaimsFiles, JsonHoldsTheSameAndEveryFinding) {
  const auto run = test::tiny_run();
  const ClaimData data = test::numbered_claim_data();
  const auto json =
      nlohmann::json::parse(claims_json({run, data, 15, 300, "quartet claims --json"}));
  EXPECT_EQ(json.at("scene"), run.scene->scene().name);
  EXPECT_EQ(json.at("width"), 2);
  EXPECT_EQ(json.at("height"), 1);
  EXPECT_EQ(json.at("sampler"), "independent");
  EXPECT_EQ(json.at("passes"), 15);
  EXPECT_EQ(json.at("seeds"), 2);
  EXPECT_EQ(json.at("reference_spp"), 300);
  EXPECT_EQ(json.at("command_line"), "quartet claims --json");
  const auto interval = [](const nlohmann::json& from) {
    return Interval{from.at("mean").get<double>(), from.at("low").get<double>(),
                    from.at("high").get<double>()};
  };
  const std::vector<TwoSeeds> expected = expected_quantities(data);
  ASSERT_EQ(json.at("quantities").size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& entry = json.at("quantities")[i];
    EXPECT_EQ(entry.at("region"), expected[i].region);
    EXPECT_EQ(entry.at("pixels"), expected[i].pixels);
    EXPECT_EQ(entry.at("quantity"), expected[i].name);
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      expect_same_interval(interval(entry.at(std::string(estimator(report_criteria[c]).id))),
                           interval_of(expected[i].values[c], expected[i].geometric));
    }
  }
  const std::vector<Claim> claims = judge_claims(data);
  ASSERT_EQ(json.at("findings").size(), claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const auto& entry = json.at("findings")[i];
    EXPECT_EQ(entry.at("number"), claims[i].number);
    EXPECT_EQ(entry.at("text"), claims[i].text);
    EXPECT_EQ(entry.at("verdict"), verdict_text(claims[i].verdict));
    ASSERT_EQ(entry.at("conditions").size(), claims[i].checks.size());
    for (std::size_t k = 0; k < claims[i].checks.size(); ++k) {
      const ClaimCheck& check = claims[i].checks[k];
      EXPECT_EQ(entry.at("conditions")[k].at("condition"), check.text);
      EXPECT_EQ(entry.at("conditions")[k].at("verdict"), verdict_text(check.verdict));
      expect_same_interval(interval(entry.at("conditions")[k]), check.value);
    }
  }
}

}  // namespace
}  // namespace quartet
