#include "app/records/versus_files.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/options/lane_option.h"
#include "app/records/interval_text.h"
#include "app/records/json_text.h"
#include "app/records/run_record.h"
#include "renderer/base/number_text.h"
#include "renderer/measure/top_share.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

constexpr std::array<char, 2> lane_letters{'A', 'B'};

/// Of what a lane's runs took.
double mean_end(const VersusReport& report, std::size_t lane, Effort effort) {
  return mean_of(over_seeds(report.result, [&](const VersusSeed& seed) {
    return effort_of(effort, seed.runs[lane].passes.back());
  }));
}

double mean_effort(const VersusReport& report) {
  return mean_of(over_seeds(report.result, [](const VersusSeed& seed) { return seed.effort; }));
}

std::string effort_text(const VersusReport& report, double effort) {
  switch (report.plan.effort) {
    case Effort::seconds:
      return format_number(effort) + " s";
    case Effort::rays:
      return format_number(effort) + " rays a pixel";
    case Effort::mean_spp:
      return format_number(effort) + " spp";
  }
  return "";
}

/// What of relMSE sits in the largest thousandth of the pixels at the ends of the runs, mean over
/// the seeds; NaN where relMSE was not measured.
double mean_top_share(const VersusReport& report, std::size_t lane) {
  return mean_of(over_seeds(report.result, [&](const VersusSeed& seed) {
    return seed.runs[lane].passes.back().relmse_top;
  }));
}

/// What the energies say of a gain: a lane that lost light may owe its lower error to that.
std::string energy_sentence(const VersusReport& report) {
  std::string text;
  for (std::size_t lane = 0; lane < lane_letters.size(); ++lane) {
    const Interval energy = energy_of(report.result, lane, report.each_rate());
    if (!std::isnan(energy.mean) && !energy.contains(0.0)) {
      text += fmt::format(" {} is too {}: energy {}.", lane_letters[lane],
                          energy.mean < 0.0 ? "dark" : "bright", percent_text(energy));
    }
  }
  return text.empty() ? " Neither is seen to lose or gain light." : text;
}

/// The finding in a sentence: which lane is better by how much, or that no difference was seen and
/// how large one could have been; and which of them has lost or gained light.
std::string versus_sentence(const VersusReport& report) {
  const Metric& row = metric(report.plan.metrics.front());
  const Interval ratio = error_ratio(report.result, 0, report.each_rate());
  const std::string at = effort_text(report, mean_effort(report));
  std::string text;
  if (std::isnan(ratio.mean) || !std::isfinite(ratio.high)) {
    text = fmt::format("At {} the {} of A and B cannot be compared.", at, row.label);
  } else if (ratio.contains(1.0)) {
    text = fmt::format(
        "No difference in {} is seen at {}: A's is {} of B's. With {} seeds one of {:.0f} % would "
        "have been.",
        row.label, at, ratio_text(ratio), report.result.seeds.size(),
        100.0 * (std::sqrt(ratio.high / ratio.low) - 1.0));
  } else {
    const bool a = ratio.high < 1.0;
    text = fmt::format("{} is better in {} at {}: A's is {} of B's.", a ? 'A' : 'B', row.label, at,
                       ratio_text(ratio));
  }
  if (const auto effort = crossing(report.result, report.plan, 0)) {
    text += fmt::format(" The lead changed last at {}.", effort_text(report, *effort));
  }
  return text + energy_sentence(report);
}

}  // namespace

double VersusReport::each_rate() const {
  return sidak(1.0 - confidence, double(plan.metrics.size()) + 2.0);
}

std::string versus_text(const VersusReport& report) {
  std::string text = fmt::format("{:<8} {:>9} {:>9} {:>9} {:>30} {:>12} {:>12}\n", "", "mean spp",
                                 "rays", "seconds", "energy", "bias²", "variance");
  for (std::size_t lane = 0; lane < lane_letters.size(); ++lane) {
    text +=
        fmt::format("{:<8} {:>9.2f} {:>9.2f} {:>9.3f} {:>30} {:>12.4g} {:>12.4g}\n",
                    std::string(1, lane_letters[lane]), mean_end(report, lane, Effort::mean_spp),
                    mean_end(report, lane, Effort::rays), mean_end(report, lane, Effort::seconds),
                    percent_text(energy_of(report.result, lane, report.each_rate())),
                    report.result.parts[lane].squared_bias, report.result.parts[lane].variance);
  }
  text += fmt::format("\n{:<16} {:>28}\n", "metric", "A over B");
  for (std::size_t m = 0; m < report.plan.metrics.size(); ++m) {
    text += fmt::format("{:<16} {:>28}", metric(report.plan.metrics[m]).id,
                        ratio_text(error_ratio(report.result, m, report.each_rate())));
    if (report.plan.metrics[m] == MetricId::relmse) {
      text += fmt::format("   of A's {}, of B's {} sits in the largest thousandth of pixels",
                          top_share_text(mean_top_share(report, 0)),
                          top_share_text(mean_top_share(report, 1)));
    }
    text += '\n';
  }
  const std::string floor =
      std::isnan(report.noise_floor)
          ? ""
          : fmt::format(" Of each bias², {:.2g} is the reference's own noise.", report.noise_floor);
  text += fmt::format(
      "\nA: {}\nB: {}\n{} seeds, sampler {}; {:g} % intervals, all together. Efforts, bias² and "
      "variance (of MSE,\nradiance²) are of the ends of the runs.{}\n\n{}\n",
      lane_text(report.plan.lanes[0]), lane_text(report.plan.lanes[1]), report.result.seeds.size(),
      sampler_row(report.run.settings.sampler).id, 100.0 * report.confidence, floor,
      versus_sentence(report));
  return text;
}

std::string versus_json(const VersusReport& report) {
  ordered_json json;
  json["scene"] = report.run.scene->scene().name;
  json["sampler"] = sampler_row(report.run.settings.sampler).id;
  json["command_line"] = report.command_line;
  json["seeds"] = report.result.seeds.size();
  json["confidence"] = report.confidence;
  json["effort"] = effort_row(report.plan.effort).id;
  json["at"] = mean_effort(report);
  for (std::size_t lane = 0; lane < lane_letters.size(); ++lane) {
    ordered_json& entry = json[std::string(1, lane_letters[lane])];
    entry["lane"] = lane_text(report.plan.lanes[lane]);
    entry["energy_error"] = interval_json(energy_of(report.result, lane, report.each_rate()));
    entry["squared_bias"] = report.result.parts[lane].squared_bias;
    entry["variance"] = report.result.parts[lane].variance;
    entry[std::string(top_share_id)] = mean_top_share(report, lane);
  }
  for (std::size_t m = 0; m < report.plan.metrics.size(); ++m) {
    ordered_json& entry = json["ratios"][std::string(metric(report.plan.metrics[m]).id)];
    entry = interval_json(error_ratio(report.result, m, report.each_rate()));
    const auto effort = crossing(report.result, report.plan, m);
    entry["cross_at"] = effort ? ordered_json(*effort) : ordered_json(nullptr);
  }
  json["sentence"] = versus_sentence(report);
  return json_text(json);
}

std::string versus_csv(const VersusReport& report) {
  std::string csv(csv_header);
  for (std::size_t k = 0; k < report.result.seeds.size(); ++k) {
    for (std::size_t lane = 0; lane < lane_letters.size(); ++lane) {
      const VersusRun& run = report.result.seeds[k].runs[lane];
      std::string head;
      for (const Measurement& pass : run.passes) {
        head = csv_measurement(report.run, report.plan.lanes[lane], report.run.settings.seed + k,
                               pass);
        csv += csv_metric_rows(head, report.plan.metrics, pass);
      }
      for (std::size_t m = 0; m < report.plan.metrics.size(); ++m) {
        csv += fmt::format("{},{}_at_goal,{:.9g}\n", head, metric(report.plan.metrics[m]).id,
                           run.errors[m]);
      }
      csv += fmt::format("{},energy_error_at_goal,{:.9g}\n", head, run.energy);
    }
  }
  return csv;
}

}  // namespace quartet
