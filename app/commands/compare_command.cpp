#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.h"
#include "app/options/usage_error.h"
#include "app/records/json_text.h"
#include "app/terminal/messages.h"
#include "renderer/base/image.h"
#include "renderer/base/version.h"
#include "renderer/files/picture.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/energy.h"
#include "renderer/measure/left_out.h"
#include "renderer/measure/reference/noise_floors.h"
#include "renderer/measure/reference/reference.h"
#include "renderer/measure/top_share.h"
#include "ui/paper/error_figure.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

struct CompareOptions {
  std::string test;
  std::string layer;
  std::string reference;
  std::string reference_layer;
  std::string metric;  ///< empty: relmse
  std::string picture;
  bool json = false;
  bool strict = false;
};

/// Two pictures, as far as both have pixels.
struct CompareResult {
  int width = 0;  ///< of the whole pictures
  int height = 0;
  RadianceImage test;
  Reference reference;
  LeftOut not_finite;
  std::size_t uncovered = 0;  ///< pixels that a file says nothing of
  std::vector<std::string> test_notes;
  std::vector<std::string> reference_notes;
  std::optional<double> seconds;  ///< that the test took, if its header says so

  std::size_t left_out() const { return uncovered + not_finite.either; }
};

std::optional<double> seconds_of(const std::map<std::string, std::string>& attributes) {
  const auto it = attributes.find("seconds");
  double value = 0.0;
  if (it == attributes.end()) {
    return std::nullopt;
  }
  const std::string& text = it->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value > 0.0
             ? std::optional(value)
             : std::nullopt;
}

/// The pixels of `window`, of a picture that begins at (from_left, from_top).
RadianceImage cut(const RadianceImage& image, int from_left, int from_top,
                  const ExrWindow& window) {
  RadianceImage result(window.width, window.height);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      result.at(x, y) = image.at(window.x + x - from_left, window.y + y - from_top);
    }
  }
  return result;
}

ExrWindow covered_by(const Picture& picture) {
  return {picture.left, picture.top, picture.image.width(), picture.image.height()};
}

/// A reference of ours, or another picture in the same form; `placed` says where it lies.
Reference read_compared(const CompareOptions& options, Picture& placed) {
  const std::filesystem::path path = options.reference;
  if (options.reference_layer.empty()) {
    if (std::optional<Reference> own = load_own_reference(path)) {
      placed.width = own->image.width();
      placed.height = own->image.height();
      placed.image = own->image;
      return std::move(*own);
    }
  }
  placed = read_picture(path, {options.reference_layer, "--reference-layer"});
  Reference reference;
  reference.path = path;
  reference.image = placed.image;
  return reference;
}

CompareResult load(const CompareOptions& options) {
  const Picture test = read_picture(options.test, {options.layer, "--layer"});
  Picture placed;
  CompareResult result;
  result.reference = read_compared(options, placed);
  if (test.width != placed.width || test.height != placed.height) {
    throw std::runtime_error(fmt::format(
        "{} has {}x{} pixels and {} has {}x{}; the same size would be right", options.test,
        test.width, test.height, options.reference, placed.width, placed.height));
  }
  const ExrWindow window = intersection(covered_by(test), covered_by(placed));
  if (window.width == 0 || window.height == 0) {
    throw std::runtime_error(
        fmt::format("{} and {} cover no pixel both; the same part of the picture would be right",
                    options.test, options.reference));
  }
  result.width = test.width;
  result.height = test.height;
  result.test = cut(test.image, test.left, test.top, window);
  result.reference.image = cut(placed.image, placed.left, placed.top, window);
  for (RadianceImage& half : result.reference.halves) {
    if (!half.empty()) {
      half = cut(half, 0, 0, window);
    }
  }
  result.not_finite = left_out_of(result.test, result.reference.image);
  // So that the noise of the reference, too, is that of the pixels that are compared.
  for (std::size_t i = 0; i < result.reference.image.size(); ++i) {
    if (result.not_finite.is_left_out[i] != 0) {
      result.reference.image.pixels()[i] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    }
  }
  result.uncovered = std::size_t(test.width) * std::size_t(test.height) - result.test.size();
  result.test_notes = test.notes;
  result.reference_notes = placed.notes;
  result.seconds = seconds_of(test.attributes);
  if (result.not_finite.either == result.test.size()) {
    throw std::runtime_error(
        fmt::format("no pixel is finite in both {} and {}; one at least "
                    "would be right",
                    options.test, options.reference));
  }
  return result;
}

/// "5 of 300 pixels are left out of every number: ...".
std::string left_out_text(const CompareOptions& options, const CompareResult& comparison) {
  std::vector<std::string> reasons;
  const auto add = [&](std::size_t count, const std::string& reason) {
    if (count > 0) {
      reasons.push_back(fmt::format("{} {}", count, reason));
    }
  };
  add(comparison.not_finite.test, "NaN or infinite in " + options.test);
  add(comparison.not_finite.reference, "NaN or infinite in " + options.reference);
  add(comparison.uncovered, "outside of what both files cover");
  return fmt::format("{} of {} pixels are left out of every number: {}", comparison.left_out(),
                     std::size_t(comparison.width) * std::size_t(comparison.height),
                     fmt::join(reasons, ", "));
}

/// Of the pixels that count.
glm::dvec3 mean(const RadianceImage& image, const LeftOut& left_out) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (left_out.is_left_out[i] == 0) {
      sum += glm::dvec3(image.pixels()[i]);
    }
  }
  return sum / double(image.size() - left_out.either);
}

/// energy_error() of the pixels that count; NaN if the reference is black.
double energy_error_of(const CompareResult& comparison) {
  const glm::dvec3 x = mean(comparison.test, comparison.not_finite);
  const glm::dvec3 r = mean(comparison.reference.image, comparison.not_finite);
  return energy_error(luminance(x.r, x.g, x.b), luminance(r.r, r.g, r.b));
}

/// JSON has no infinity: the decibels of two equal pictures are null.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json rgb(glm::dvec3 c) {
  return ordered_json::array({c.r, c.g, c.b});
}

ordered_json record_of(const CompareOptions& options, const CompareResult& comparison) {
  const Reference& reference = comparison.reference;
  ordered_json json;
  json["test"] = options.test;
  json["reference"] = options.reference;
  json["width"] = comparison.width;
  json["height"] = comparison.height;
  json["test_notes"] = comparison.test_notes;
  json["reference_notes"] = comparison.reference_notes;
  json["left_out"] = {{"pixels", comparison.left_out()},
                      {"test_not_finite", comparison.not_finite.test},
                      {"reference_not_finite", comparison.not_finite.reference},
                      {"not_covered", comparison.uncovered}};
  json["test_mean"] = rgb(mean(comparison.test, comparison.not_finite));
  json["reference_mean"] = rgb(mean(reference.image, comparison.not_finite));
  NoiseFloors floors(reference);
  for (const Metric& row : metrics()) {
    json["metrics"][row.id] = number(compute_over_finite(row, comparison.test, reference.image));
    json["noise_floor"][row.id] = number(floors.of(row));
    if (row.key == MetricId::relmse) {
      json["metrics"][top_share_id] = number(relmse_top_share(comparison.test, reference.image));
    }
  }
  json["metrics"]["energy_error"] = number(energy_error_of(comparison));
  json["seconds"] = comparison.seconds ? ordered_json(*comparison.seconds) : ordered_json(nullptr);
  json["metrics"]["efficiency"] =
      comparison.seconds
          ? number(efficiency(json["metrics"]["mse"].get<double>(), *comparison.seconds))
          : ordered_json(nullptr);
  return json;
}

void print_table(const CompareOptions& options, const CompareResult& comparison) {
  const Reference& reference = comparison.reference;
  fmt::print("{} against {}, {}x{}\n", options.test, options.reference, comparison.width,
             comparison.height);
  NoiseFloors floors(reference);
  const bool known = !std::isnan(floors.of(metric(MetricId::mse)));
  fmt::print("{:<15} {:>12} {:>12}  {:<9} {}\n", "metric", "value", known ? "noise floor" : "",
             "unit", "definition (x test, r reference)");
  for (const Metric& row : metrics()) {
    const std::string floor = known ? fmt::format("{:.6g}", floors.of(row)) : std::string();
    fmt::print("{:<15} {:>12.6g} {:>12}  {:<9} {}\n", row.id,
               compute_over_finite(row, comparison.test, reference.image), floor, row.unit,
               row.definition);
    if (row.key == MetricId::relmse) {
      fmt::print("{:<15} {:>12} {:>12}  {:<9} of relmse sits in the largest thousandth of pixels\n",
                 "", top_share_text(relmse_top_share(comparison.test, reference.image)), "", "");
    }
  }
  fmt::print("{:<15} {:>+12.6g} {:>12}  {:<9} mean luminance of x over that of r, less 1\n",
             "energy_error", energy_error_of(comparison), "", "");
  if (comparison.seconds) {
    const double mse = compute_over_finite(metric(MetricId::mse), comparison.test, reference.image);
    fmt::print("{:<15} {:>12.6g} {:>12}  {:<9} 1/(mse · seconds), {:.4g} s\n", "efficiency",
               efficiency(mse, *comparison.seconds), "", "", *comparison.seconds);
  } else {
    fmt::print("{:<15} {:>12} {:>12}  {:<9} the test's header has no seconds\n", "efficiency", "-",
               "", "");
  }
  const glm::dvec3 x = mean(comparison.test, comparison.not_finite);
  const glm::dvec3 r = mean(reference.image, comparison.not_finite);
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
  for (const std::string& note : comparison.test_notes) {
    warn("{}: {}", options.test, note);
  }
  for (const std::string& note : comparison.reference_notes) {
    warn("{}: {}", options.reference, note);
  }
  if (!picture.empty()) {
    StagedFiles files(picture.parent_path(), {picture.filename().string()});
    const Figure figure = error_figure(
        comparison.test, comparison.reference.image, row,
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
  if (comparison.left_out() > 0) {
    const std::string text = left_out_text(options, comparison);
    if (options.strict) {
      throw std::runtime_error("--strict: " + text);
    }
    warn("{}", text);
  }
}

}  // namespace

void add_compare_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("compare", "How far a picture is from a reference, in every metric");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("test", options->test, "An EXR, PFM, HDR or PNG of any program")->required();
  command->add_option("reference", options->reference, "The same, of the same size")->required();
  command
      ->add_option("--layer", options->layer,
                   "Of the test, an EXR with several of colour, e.g. ViewLayer.Combined")
      ->type_name("NAME");
  command->add_option("--reference-layer", options->reference_layer, "The same of the reference")
      ->type_name("NAME");
  command->add_flag("--strict", options->strict,
                    "Fail, after all is printed, if any pixel had to be left out");
  command->add_flag("--json", options->json, "As JSON; numbers that are not finite are null");
  command->add_option("--picture", options->picture, "Write where the error is as a .png");
  command->add_option("--metric", options->metric,
                      "Of the picture, relmse if not given; see quartet list");
  command->footer(
      "The noise floor is what a metric would say of a perfect picture, because the reference has\n"
      "noise of its own; references of quartet reference know theirs.\n"
      "Pixels that are NaN or infinite in either picture, or outside of a cropped one, are left "
      "out\n"
      "of every number, and counted. Of an EXR with layers the only one of colour is taken (R G B\n"
      "without a name first), or luminance alone for all three. PNG is decoded from sRGB.\n"
      "Examples:\n"
      "  quartet compare kl.exr ref.exr\n"
      "  quartet compare kl.exr ref.exr --json\n"
      "  quartet compare cycles.exr ref.pfm --layer ViewLayer.Combined --strict\n"
      "  quartet compare kl.exr ref.exr --metric flip --picture error.png");
  command->callback([options, &program] { run_compare(*options, program); });
}

}  // namespace quartet
