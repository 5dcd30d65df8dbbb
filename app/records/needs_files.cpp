#include "app/records/needs_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/records/csv_field.h"
#include "app/records/interval_text.h"
#include "app/records/json_text.h"
#include "renderer/base/number_text.h"
#include "renderer/base/version.h"
#include "renderer/scene/write_scene.h"
#include "renderer/view/needs_charts.h"
#include "ui/paper/chart_figure.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

std::string_view need_id(const NeedsRow& row) {
  const bool same_mean = part(row.simplification.part).same_mean;
  switch (row.need) {
    case Need::needed:
      return same_mean ? "pays" : "needed";
    case Need::not_needed:
      return same_mean ? "does not pay" : "not needed";
    case Need::undecided:
      return "undecided";
  }
  return "";
}

std::string short_interval(const Interval& interval) {
  return fmt::format("{} ({} to {})", format_number(interval.mean), format_number(interval.low),
                     format_number(interval.high));
}

std::string ratio_number(double ratio) {
  return std::isnan(ratio) ? "–" : fmt::format("{:.3f}", ratio);
}

std::string limit_name(const NeedsReport& report) {
  return fmt::format("{} {}", report.plan.error ? "the error asked for," : "the noise floor,",
                     format_number(report.result.limit));
}

/// What the columns are, for table and chart alike.
std::string measure_text(const NeedsReport& report) {
  return fmt::format("{}x{}, {} seeds of {} spp, sampler {}", report.run.settings.width,
                     report.run.settings.height, report.plan.seeds, report.plan.spp,
                     sampler_row(report.run.settings.sampler).id);
}

std::string depth_word(int depth) {
  return depth == std::numeric_limits<int>::max() ? "no limit" : fmt::format("depth {}", depth);
}

/// What has the same mean with and without is a matter of time and noise.
std::string same_mean_text(const NeedsReport& report) {
  std::string text;
  for (const NeedsRow& row : report.result.rows) {
    const Part& kind = part(row.simplification.part);
    if (kind.same_mean) {
      const Interval cost = row.cost();
      text += fmt::format(
          "{}: the same picture in the mean; takes {} × the rays, {} × the variance, and {} to {} "
          "× the\nrays for the same noise: {} {}.\n",
          row.simplification.label, ratio_number(row.rays_ratio),
          format_number(row.measured.variance.mean), format_number(cost.low),
          format_number(cost.high), kind.label,
          row.need == Need::undecided ? "is undecided" : need_id(row));
    }
  }
  return text;
}

std::string undecided_text(const NeedsReport& report) {
  std::vector<std::string> labels;
  for (const NeedsRow& row : report.result.rows) {
    if (row.need == Need::undecided) {
      labels.push_back(row.simplification.label);
    }
  }
  return labels.empty() ? ""
                        : fmt::format(" Undecided, and kept: {}; more --seeds or --spp would tell.",
                                      fmt::join(labels, ", "));
}

std::string row_text(const std::string& label, const NeedsRow& row, std::string_view need) {
  return fmt::format("{:<32} {:>6} {:>7} {:>8} {:>32} {:>28} {:>12}\n", label,
                     ratio_number(row.rays_ratio), ratio_number(row.seconds_ratio),
                     format_number(row.measured.variance.mean), short_interval(row.measured.error),
                     percent_text(row.measured.energy), need);
}

ordered_json row_json(const NeedsRow& row) {
  const auto finite = [](const Interval& interval) {
    return std::isfinite(interval.mean) ? interval_json(interval) : ordered_json(nullptr);
  };
  ordered_json json;
  json["model"] = row.simplification.label;
  json["rays"] = row.rays;
  json["rays_ratio"] = row.rays_ratio;
  json["seconds_ratio"] = row.seconds_ratio;
  json["error"] = interval_json(row.measured.error);
  json["noise_taken_off"] = row.measured.noise;
  json["energy_error"] = finite(row.measured.energy);
  json["variance_ratio"] = finite(row.measured.variance);
  return json;
}

ChartFigure needs_figure(const NeedsReport& report) {
  const Metric& row = metric(report.plan.metric);
  ChartFigure figure;
  figure.title = report.run.scene->scene().name + " · what the picture needs";
  figure.lines = {
      fmt::format("{} · {}: {}, less the noise of the difference · {:g} % intervals, all together",
                  measure_text(report), row.label, row.definition, 100.0 * report.plan.confidence),
      "One part is taken out at a time. Diamond: needed; dot: not needed; cross: undecided. What "
      "lies under the line is not needed; the numbers at the points of the line are depths.",
      needs_sentence(report)};
  figure.charts = needs_charts(report.result, report.plan);
  figure.footer = fmt::format("quartet {} · {}", version(), report.command_line);
  return figure;
}

}  // namespace

std::string needs_sentence(const NeedsReport& report) {
  const NeedsResult& result = report.result;
  if (!result.smallest) {
    return result.rows.empty() ? std::string("There is nothing to take out of this model.")
                               : "Nothing can be taken out of this model." + undecided_text(report);
  }
  const NeedsRow& row = *result.smallest;
  std::string text = fmt::format(
      "The smallest model found: {}. Its {} is {}, below {}; energy {}; it takes {} × the rays and "
      "{} × the time.",
      row.simplification.label, metric(report.plan.metric).id, short_interval(row.measured.error),
      limit_name(report), percent_text(row.measured.energy), ratio_number(row.rays_ratio),
      ratio_number(row.seconds_ratio));
  if (result.smallest_model.integrator != report.run.settings.integrator) {
    text += fmt::format(" Render it with --integrator {}.",
                        integrator(result.smallest_model.integrator).id);
  }
  return text + undecided_text(report);
}

std::string needs_text(const NeedsReport& report) {
  const NeedsResult& result = report.result;
  const Metric& row = metric(report.plan.metric);
  std::string text =
      fmt::format("{}: {}; the whole model takes {:.2f} rays a sample, {:.3f} s a picture ({})\n",
                  report.run.scene->scene().name, measure_text(report), result.rays, result.seconds,
                  depth_word(report.run.settings.max_depth));
  text += fmt::format("noise floor, {} of its mean over all seeds: {}\n\n", row.id,
                      short_interval(result.noise_floor));
  text += fmt::format("{:<32} {:>6} {:>7} {:>8} {:>32} {:>28} {:>12}\n", "model", "rays", "seconds",
                      "variance", row.id, "energy", "");
  for (const NeedsRow& each : result.rows) {
    text += row_text(each.simplification.label, each, need_id(each));
  }
  if (result.smallest && result.taken_out.size() > 1) {
    text += row_text("the smallest model", *result.smallest, "");
  }
  text += fmt::format(
      "\nRays, seconds and variance are over those of the whole model; {} is of the mean over all "
      "seeds against\nthat of the whole model, less noise. {:g} % intervals, those of a column all "
      "together.\n",
      row.id, 100.0 * report.plan.confidence);
  if (const std::string same = same_mean_text(report); !same.empty()) {
    text += "\n" + same;
  }
  return text + "\n" + needs_sentence(report) + "\n";
}

std::string needs_json(const NeedsReport& report) {
  const NeedsResult& result = report.result;
  ordered_json json;
  json["program"] = "quartet";
  json["version"] = version();
  json["command_line"] = report.command_line;
  json["scene"] = report.run.scene->scene().name;
  json["scene_file"] = report.run.scene->scene().path.string();
  json["width"] = report.run.settings.width;
  json["height"] = report.run.settings.height;
  json["sampler"] = sampler_row(report.run.settings.sampler).id;
  json["seed"] = report.run.settings.seed;
  json["seeds"] = report.plan.seeds;
  json["spp"] = report.plan.spp;
  json["confidence"] = report.plan.confidence;
  json["metric"] = metric(report.plan.metric).id;
  json["limit"] = result.limit;
  json["noise_floor"] = interval_json(result.noise_floor);
  json["whole"] = {{"rays", result.rays}, {"seconds", result.seconds}};
  json["rows"] = ordered_json::array();
  for (const NeedsRow& row : result.rows) {
    ordered_json entry{{"part", part(row.simplification.part).id}, {"need", need_id(row)}};
    entry.update(row_json(row));
    json["rows"].push_back(std::move(entry));
  }
  json["taken_out"] = ordered_json::array();
  for (const std::size_t i : result.taken_out) {
    json["taken_out"].push_back(result.rows[i].simplification.label);
  }
  json["smallest"] = result.smallest ? row_json(*result.smallest) : ordered_json(nullptr);
  json["sentence"] = needs_sentence(report);
  return json_text(json);
}

std::string needs_csv(const NeedsReport& report) {
  std::string csv = "scene,sampler,spp,seeds,part,model,need,metric,value,low,high\n";
  const std::string run =
      fmt::format("{},{},{},{}", csv_field(report.run.scene->scene().name),
                  sampler_row(report.run.settings.sampler).id, report.plan.spp, report.plan.seeds);
  const std::string_view id = metric(report.plan.metric).id;
  std::string head;
  const auto number = [&](std::string_view name, double value) {
    csv += fmt::format("{},{},{:.9g},,\n", head, name, value);
  };
  const auto interval = [&](std::string_view name, const Interval& value) {
    csv +=
        fmt::format("{},{},{:.9g},{:.9g},{:.9g}\n", head, name, value.mean, value.low, value.high);
  };
  const auto add = [&](const NeedsRow& row) {
    interval(id, row.measured.error);
    number(fmt::format("{}_noise", id), row.measured.noise);
    interval("energy_error", row.measured.energy);
    interval("variance_ratio", row.measured.variance);
    number("rays", row.rays);
    number("rays_ratio", row.rays_ratio);
    number("seconds_ratio", row.seconds_ratio);
  };
  head = run + ",,whole,";
  interval(fmt::format("{}_noise_floor", id), report.result.noise_floor);
  number("rays", report.result.rays);
  number("seconds", report.result.seconds);
  for (const NeedsRow& row : report.result.rows) {
    head = fmt::format("{},{},{},{}", run, part(row.simplification.part).id,
                       csv_field(row.simplification.label), need_id(row));
    add(row);
  }
  if (report.result.smallest) {
    head = run + ",,smallest,";
    add(*report.result.smallest);
  }
  return csv;
}

void write_needs_files(StagedFiles& files, const NeedsReport& report) {
  files.write("needs.csv", needs_csv(report));
  files.write("needs.json", needs_json(report) + "\n");
  write_chart_files(files, "needs", needs_figure(report));
  for (const SceneFile& file : scene_files(report.result.smallest_model.scene, "smallest")) {
    files.write(file.name, file.text);
  }
}

}  // namespace quartet
