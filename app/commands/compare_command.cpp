#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.h"
#include "app/options/usage_error.h"
#include "app/records/json_text.h"
#include "renderer/base/version.h"
#include "renderer/files/exr.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/reference.h"
#include "ui/paper/error_figure.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

struct CompareOptions {
  std::string test;
  std::string reference;
  std::string metric;  ///< empty: relmse
  std::string picture;
  bool json = false;
};

struct CompareResult {
  RadianceImage test;
  std::shared_ptr<const Reference> reference;
  std::optional<double> seconds;  ///< that the test took, if its header says so
};

std::optional<double> seconds_of(const ExrImage& exr) {
  const auto it = exr.attributes.find("seconds");
  double value = 0.0;
  if (it == exr.attributes.end()) {
    return std::nullopt;
  }
  const std::string& text = it->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value > 0.0
             ? std::optional(value)
             : std::nullopt;
}

CompareResult load(const CompareOptions& options) {
  const ExrImage exr = read_exr(options.test);
  CompareResult comparison{radiance_of(exr, options.test), load_reference(options.reference),
                           seconds_of(exr)};
  try {
    require_finite(comparison.test, options.test);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
  const RadianceImage& reference = comparison.reference->image;
  if (comparison.test.width() != reference.width() ||
      comparison.test.height() != reference.height()) {
    throw std::runtime_error(
        fmt::format("{} has {}x{} pixels and {} has {}x{}; the same size would be right",
                    options.test, comparison.test.width(), comparison.test.height(),
                    options.reference, reference.width(), reference.height()));
  }
  return comparison;
}

glm::dvec3 mean(const RadianceImage& image) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& c : image.pixels()) {
    sum += glm::dvec3(c);
  }
  return sum / double(image.size());
}

/// JSON has no infinity: the decibels of two equal pictures are null.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json rgb(glm::dvec3 c) {
  return ordered_json::array({c.r, c.g, c.b});
}

ordered_json record_of(const CompareOptions& options, const CompareResult& comparison) {
  const Reference& reference = *comparison.reference;
  ordered_json json;
  json["test"] = options.test;
  json["reference"] = options.reference;
  json["width"] = comparison.test.width();
  json["height"] = comparison.test.height();
  json["test_mean"] = rgb(mean(comparison.test));
  json["reference_mean"] = rgb(mean(reference.image));
  for (const Metric& row : metrics()) {
    json["metrics"][row.id] = number(row.compute(comparison.test, reference.image));
    json["noise_floor"][row.id] = number(reference.noise_floor(row.key));
  }
  json["seconds"] = comparison.seconds ? ordered_json(*comparison.seconds) : ordered_json(nullptr);
  json["metrics"]["efficiency"] =
      comparison.seconds
          ? number(efficiency(json["metrics"]["mse"].get<double>(), *comparison.seconds))
          : ordered_json(nullptr);
  return json;
}

void print_table(const CompareOptions& options, const CompareResult& comparison) {
  const Reference& reference = *comparison.reference;
  fmt::print("{} against {}, {}x{}\n", options.test, options.reference, comparison.test.width(),
             comparison.test.height());
  const bool floors = !std::isnan(reference.noise_floor(MetricId::mse));
  fmt::print("{:<15} {:>12} {:>12}  {:<9} {}\n", "metric", "value", floors ? "noise floor" : "",
             "unit", "definition (x test, r reference)");
  for (const Metric& row : metrics()) {
    const std::string floor =
        floors ? fmt::format("{:.6g}", reference.noise_floor(row.key)) : std::string();
    fmt::print("{:<15} {:>12.6g} {:>12}  {:<9} {}\n", row.id,
               row.compute(comparison.test, reference.image), floor, row.unit, row.definition);
  }
  if (comparison.seconds) {
    const double mse = metric(MetricId::mse).compute(comparison.test, reference.image);
    fmt::print("{:<15} {:>12.6g} {:>12}  {:<9} 1/(mse · seconds), {:.4g} s\n", "efficiency",
               efficiency(mse, *comparison.seconds), "", "", *comparison.seconds);
  } else {
    fmt::print("{:<15} {:>12} {:>12}  {:<9} the test's header has no seconds\n", "efficiency", "-",
               "", "");
  }
  const glm::dvec3 x = mean(comparison.test);
  const glm::dvec3 r = mean(reference.image);
  fmt::print(
      "mean radiance   test {:.6g} {:.6g} {:.6g}, reference {:.6g} {:.6g} {:.6g}, ratio "
      "{:.5f} {:.5f} {:.5f}\n",
      x.r, x.g, x.b, r.r, r.g, r.b, x.r / r.r, x.g / r.g, x.b / r.b);
  if (!reference.ours()) {
    fmt::print("{} is no reference of Quartet's: its own noise is not known\n", options.reference);
  }
}

void run_compare(const CompareOptions& options, const Program& program) {
  const Metric& row =
      options.metric.empty() ? metric(MetricId::relmse) : find_metric(options.metric);
  if (!options.metric.empty() && options.picture.empty()) {
    throw UsageError(
        "--metric has no effect: it is for the --picture; the numbers are those of all metrics");
  }
  const std::filesystem::path picture = options.picture;
  if (!picture.empty() && picture.extension() != ".png") {
    throw UsageError(fmt::format("--picture: '{}' is no .png", options.picture));
  }
  const CompareResult comparison = load(options);
  if (!picture.empty()) {
    StagedFiles files(picture.parent_path(), {picture.filename().string()});
    const Figure figure = error_figure(
        comparison.test, comparison.reference->image, row,
        fmt::format("{} against {}", std::filesystem::path(options.test).filename().string(),
                    std::filesystem::path(options.reference).filename().string()),
        fmt::format("quartet {} · {}", version(), program.command_line));
    write_figure_png(figure, files.stage(picture.filename().string()));
    files.commit();
  }
  if (options.json) {
    fmt::print("{}\n", json_text(record_of(options, comparison)));
  } else {
    print_table(options, comparison);
  }
}

}  // namespace

void add_compare_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("compare", "How far a picture is from a reference, in every metric");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("test", options->test, "An .exr with R, G and B, of any program")->required();
  command->add_option("reference", options->reference, "The same, of the same size")->required();
  command->add_flag("--json", options->json, "As JSON; numbers that are not finite are null");
  command->add_option("--picture", options->picture, "Write where the error is as a .png");
  command->add_option("--metric", options->metric,
                      "Of the picture, relmse if not given; see quartet list");
  command->footer(
      "The noise floor is what a metric would say of a perfect picture, because the reference has\n"
      "noise of its own; references of quartet reference know theirs.\n"
      "Examples:\n"
      "  quartet compare kl.exr ref.exr\n"
      "  quartet compare kl.exr ref.exr --json\n"
      "  quartet compare kl.exr ref.exr --metric flip --picture error.png");
  command->callback([options, &program] { run_compare(*options, program); });
}

}  // namespace quartet
