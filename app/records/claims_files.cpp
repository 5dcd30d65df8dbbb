#include "app/records/claims_files.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <tuple>
#include <vector>

#include "app/records/csv_field.h"
#include "app/records/interval_text.h"
#include "app/records/json_text.h"
#include "renderer/base/table.h"
#include "renderer/measure/top_share.h"

namespace quartet {
namespace {

/// A number of each criterion with each seed.
struct Quantity {
  std::string region;  ///< "all" for the whole picture
  std::size_t pixels = 0;
  std::string name;
  std::array<Interval, report_criterion_count> values;
};

using RunValue = std::function<double(const ClaimRun&)>;

Quantity quantity(const ClaimsReport& report, std::string region, std::size_t pixels,
                  std::string name, const RunValue& value) {
  Quantity made{std::move(region), pixels, std::move(name), {}};
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    made.values[c] =
        over_seeds(report.data, [&](const ClaimSeed& seed) { return value(seed.runs[c]); });
  }
  return made;
}

Quantity ratio_to_uniform(const ClaimsReport& report, MetricId id) {
  Quantity made{"all",
                report.run.settings.width * std::size_t(report.run.settings.height),
                fmt::format("{}_of_uniform_at_equal_time", metric(id).id),
                {}};
  for (std::size_t c = 0; c < report_criterion_count; ++c) {
    made.values[c] = against_uniform(report.data, c, id);
  }
  return made;
}

std::vector<Quantity> quantities(const ClaimsReport& report) {
  std::vector<Quantity> all;
  for (std::size_t r = 0; r < regions().size(); ++r) {
    const Region& row = regions()[r];
    const std::size_t pixels = report.data.pixels[r];
    if (pixels == 0) {
      continue;
    }
    all.push_back(quantity(report, std::string(row.id), pixels, "mean_spp",
                           [r](const ClaimRun& run) { return run.spp[r]; }));
    all.push_back(quantity(report, std::string(row.id), pixels, "share",
                           [r](const ClaimRun& run) { return run.share[r]; }));
  }
  const std::size_t pixels =
      std::size_t(report.run.settings.width) * std::size_t(report.run.settings.height);
  const auto whole = [&](std::string name, const RunValue& value) {
    all.push_back(quantity(report, "all", pixels, std::move(name), value));
  };
  whole("mean_spp", [](const ClaimRun& run) { return run.mean_spp; });
  whole("lit_mean_spp", [](const ClaimRun& run) { return run.lit_spp; });
  whole("seconds", [](const ClaimRun& run) { return run.seconds; });
  whole("relmse", [](const ClaimRun& run) { return run.relmse; });
  whole(std::string(top_share_id), [](const ClaimRun& run) { return run.relmse_top; });
  whole("flip", [](const ClaimRun& run) { return run.flip; });
  whole("energy_error", [](const ClaimRun& run) { return run.energy; });
  all.push_back(ratio_to_uniform(report, MetricId::relmse));
  all.push_back(ratio_to_uniform(report, MetricId::flip));
  return all;
}

double half_width(const Interval& interval) {
  return 0.5 * (interval.high - interval.low);
}

std::string plus_minus(const Interval& interval, double factor, int decimals) {
  const double half = factor * half_width(interval);
  return std::isfinite(half)
             ? fmt::format("{:.{}f} ±{:.{}f}", factor * interval.mean, decimals, half, decimals)
             : fmt::format("{:.{}f}", factor * interval.mean, decimals);
}

void add_header(std::string_view first, std::string& text) {
  text += fmt::format("{:<40} {:>7}", first, "pixels");
  for (const EstimatorId id : report_criteria) {
    text += fmt::format(" {:>14}", estimator(id).id);
  }
  text += '\n';
}

void add_region_tables(const std::vector<Quantity>& all, std::string& text) {
  for (const auto& [name, title, factor] : {std::tuple{"mean_spp", "mean samples per pixel", 1.0},
                                            {"share", "share of all samples, %", 100.0}}) {
    add_header(title, text);
    for (const Quantity& each : all) {
      if (each.name != name || each.region == "all") {
        continue;
      }
      const Region& row = find_row(regions(), each.region, "region");
      text += fmt::format("{:<40} {:>7}", row.label, each.pixels);
      for (const Interval& value : each.values) {
        text += fmt::format(" {:>14}", plus_minus(value, factor, 1));
      }
      text += '\n';
    }
    text += '\n';
  }
}

void add_totals(const std::vector<Quantity>& all, std::string& text) {
  add_header("whole picture", text);
  for (const Quantity& each : all) {
    if (each.region != "all") {
      continue;
    }
    text += fmt::format("{:<40} {:>7}", each.name, each.pixels);
    for (const Interval& value : each.values) {
      const int decimals = value.mean >= 1.0 ? 2 : 4;
      text += fmt::format(" {:>14}", plus_minus(value, 1.0, decimals));
    }
    text += '\n';
  }
  text += '\n';
}

std::string check_text(const ClaimCheck& check) {
  return fmt::format("{:<70} {:>7.3f} [{:.3f}, {:.3f}]  {}", check.text, check.value.mean,
                     check.value.low, check.value.high, verdict_text(check.verdict));
}

/// Whether a criterion beats uniform sampling, from the ratio of their errors.
std::string race_text(const Interval& ratio) {
  return ratio.high < 1.0  ? "beats uniform"
         : ratio.low > 1.0 ? "is beaten by uniform"
                           : "undecided";
}

void add_races(const ClaimsReport& report, std::string& text) {
  text += "Error over that of uniform sampling at equal as-if-alone time:\n";
  for (const MetricId id : {MetricId::relmse, MetricId::flip}) {
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      const Interval ratio = against_uniform(report.data, c, id);
      const Interval energy =
          over_seeds(report.data, [&](const ClaimSeed& seed) { return seed.runs[c].energy; });
      text += fmt::format("  {:<8} {:<10} {:.3f} [{:.3f}, {:.3f}]  {}; energy {}\n", metric(id).id,
                          estimator(report_criteria[c]).id, ratio.mean, ratio.low, ratio.high,
                          race_text(ratio), percent_text(energy));
    }
  }
}

}  // namespace

std::string claims_text(const ClaimsReport& report) {
  const std::vector<Quantity> all = quantities(report);
  const std::size_t seeds = report.data.seeds.size();
  std::string text = fmt::format(
      "{}, {}x{}, {}, {} passes, {} seed{}, 95 % intervals over the seeds{}, of findings all "
      "together; luminance\nas the report has it, {:g} R + {:g} G + {:g} B; reference of {} "
      "spp\n\n",
      report.run.scene->scene().name, report.run.settings.width, report.run.settings.height,
      sampler_row(report.run.settings.sampler).id, report.passes, seeds, seeds == 1 ? "" : "s",
      seeds == 1 ? " (one seed has none)" : "", report_weights.r, report_weights.g,
      report_weights.b, report.reference_spp);
  add_region_tables(all, text);
  add_totals(all, text);
  for (const Claim& claim : judge_claims(report.data)) {
    text += fmt::format("{} {}: {}\n  {}\n", claim.added ? "Added to finding" : "Finding",
                        claim.number, verdict_text(claim.verdict), claim.text);
    for (const ClaimCheck& check : claim.checks) {
      text += "  " + check_text(check) + '\n';
    }
    text += '\n';
  }
  add_races(report, text);
  return text;
}

std::string claims_json(const ClaimsReport& report) {
  nlohmann::ordered_json json;
  json["scene"] = report.run.scene->scene().name;
  json["width"] = report.run.settings.width;
  json["height"] = report.run.settings.height;
  json["sampler"] = sampler_row(report.run.settings.sampler).id;
  json["passes"] = report.passes;
  json["seeds"] = report.data.seeds.size();
  json["reference_spp"] = report.reference_spp;
  json["command_line"] = report.command_line;
  json["quantities"] = nlohmann::ordered_json::array();
  for (const Quantity& each : quantities(report)) {
    nlohmann::ordered_json entry{
        {"region", each.region}, {"pixels", each.pixels}, {"quantity", each.name}};
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      entry[std::string(estimator(report_criteria[c]).id)] = interval_json(each.values[c]);
    }
    json["quantities"].push_back(std::move(entry));
  }
  json["findings"] = nlohmann::ordered_json::array();
  for (const Claim& claim : judge_claims(report.data)) {
    nlohmann::ordered_json entry{{"number", claim.number},
                                 {"added", claim.added},
                                 {"text", claim.text},
                                 {"verdict", verdict_text(claim.verdict)}};
    for (const ClaimCheck& check : claim.checks) {
      nlohmann::ordered_json condition = interval_json(check.value);
      condition["condition"] = check.text;
      condition["verdict"] = verdict_text(check.verdict);
      entry["conditions"].push_back(std::move(condition));
    }
    json["findings"].push_back(std::move(entry));
  }
  return json_text(json) + "\n";
}

std::string claims_csv(const ClaimsReport& report) {
  const std::string scene = fmt::format("{},{}", csv_field(report.run.scene->scene().name),
                                        sampler_row(report.run.settings.sampler).id);
  std::string csv = "scene,sampler,criterion,region,pixels,quantity,mean,low,high\n";
  for (const Quantity& each : quantities(report)) {
    for (std::size_t c = 0; c < report_criterion_count; ++c) {
      const Interval& value = each.values[c];
      csv += fmt::format("{},{},{},{},{},{:.9g},{:.9g},{:.9g}\n", scene,
                         estimator(report_criteria[c]).id, each.region, each.pixels, each.name,
                         value.mean, value.low, value.high);
    }
  }
  return csv;
}

}  // namespace quartet
