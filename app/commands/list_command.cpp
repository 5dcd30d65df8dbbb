#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.h"
#include "app/records/json_text.h"
#include "renderer/adaptive/lane_settings.h"
#include "renderer/adaptive/policies/policy.h"
#include "renderer/adaptive/sample_mode.h"
#include "renderer/measure/metrics.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/synthetic.h"
#include "renderer/study/stability/failure_case.h"
#include "renderer/trace/integrator.h"
#include "renderer/view/color_map.h"
#include "renderer/view/tone_map.h"
#include "ui/paper/lab_figure.h"

namespace quartet {
namespace {

using nlohmann::ordered_json;

ordered_json tables() {
  ordered_json json;
  for (const Estimator& row : estimators()) {
    json["estimators"].push_back(
        {{"id", row.id},
         {"label", row.label},
         {"unit", row.unit},
         {"source", row.source},
         {"default", std::vector<float>(row.default_thresholds.begin(),
                                        row.default_thresholds.begin() + row.channels)},
         {"default_source", row.threshold_source},
         {"default_policy", policy(row.default_policy).id},
         {"needs_reference", row.needs_reference},
         {"assumes", row.assumes},
         {"judges_variance", row.judges_variance}});
  }
  for (const PolicyRow& row : policies()) {
    json["policies"].push_back({{"id", row.id}, {"label", row.label}, {"source", row.source}});
  }
  for (const Metric& row : metrics()) {
    json["metrics"].push_back({{"id", row.id},
                               {"label", row.label},
                               {"unit", row.unit},
                               {"definition", row.definition},
                               {"higher_is_better", row.higher_is_better}});
  }
  for (const SampleModeRow& row : sample_modes()) {
    json["modes"].push_back({{"id", row.id}, {"label", row.label}, {"source", row.source}});
  }
  for (const Integrator& row : integrators()) {
    json["integrators"].push_back(
        {{"id", row.id}, {"label", row.label}, {"description", row.description}});
  }
  for (const SamplerRow& row : samplers()) {
    json["samplers"].push_back({{"id", row.id},
                                {"label", row.label},
                                {"description", row.description},
                                {"knows_variance", row.knows_variance},
                                {"variance", row.variance}});
  }
  for (const ToneMapRow& row : tone_maps()) {
    json["tone_maps"].push_back({{"id", row.id}, {"label", row.label}, {"source", row.source}});
  }
  json["scenes"] = builtin_scenes();
  for (const Synthetic& row : synthetics()) {
    json["synthetic"].push_back({{"id", fmt::format("synthetic:{}", row.id)},
                                 {"label", row.label},
                                 {"mean", row.mean},
                                 {"variance", row.variance}});
  }
  for (const FailureCase& row : failure_cases()) {
    json["failure_cases"].push_back(
        {{"id", row.id}, {"scene", row.scene}, {"mode", row.mode}, {"watch", row.watch}});
  }
  return json;
}

/// What an estimator that judges by the variance of the mean does under each sampler.
std::string variance_text() {
  std::string text = "judges by variance: ";
  for (const SamplerRow& row : samplers()) {
    text += fmt::format("{}{} under {}", &row == samplers().data() ? "" : ", ",
                        row.knows_variance ? "right" : "as published, too wary,", row.id);
  }
  return text;
}

void print_tables() {
  fmt::print("estimators\n");
  for (const Estimator& row : estimators()) {
    fmt::print("  {:<15} {}\n", row.id, row.source);
    if (row.channels > 0) {
      fmt::print("  {:<15} default {}, {}; policy {}\n", "",
                 threshold_text(default_settings(row.key)), row.threshold_source,
                 policy(row.default_policy).id);
      fmt::print("  {:<15} assumes {}\n", "", row.assumes);
      if (row.judges_variance) {
        fmt::print("  {:<15} {}\n", "", variance_text());
      }
    }
  }
  fmt::print("policies\n");
  for (const PolicyRow& row : policies()) {
    fmt::print("  {:<15} {}\n", row.id, row.source);
  }
  fmt::print("modes\n");
  for (const SampleModeRow& row : sample_modes()) {
    fmt::print("  {:<15} {}\n", row.id, row.source);
  }
  fmt::print("metrics (x test, r reference)\n");
  for (const Metric& row : metrics()) {
    fmt::print("  {:<15} {}\n", row.id, row.definition);
  }
  fmt::print("  {:<15} 1/(mse · seconds)\n", "efficiency");
  fmt::print("integrators\n");
  for (const Integrator& row : integrators()) {
    fmt::print("  {:<15} {}\n", row.id, row.description);
  }
  fmt::print("samplers, and what each tells of the variance of a pixel's mean\n");
  for (const SamplerRow& row : samplers()) {
    fmt::print("  {:<15} {}\n", row.id, row.description);
    fmt::print("  {:<15} {}\n", "", row.variance);
  }
  fmt::print("tone maps\n");
  for (const ToneMapRow& row : tone_maps()) {
    fmt::print("  {:<15} {}\n", row.id, row.source);
  }
  fmt::print("scenes\n");
  for (const std::string& name : builtin_scenes()) {
    fmt::print("  {}\n", name);
  }
  fmt::print("distributions that stand in for a scene\n");
  for (const Synthetic& row : synthetics()) {
    fmt::print("  {:<21} {}\n", fmt::format("synthetic:{}", row.id), row.label);
  }
  fmt::print("failure cases\n");
  for (const FailureCase& row : failure_cases()) {
    fmt::print("  {:<16} {}, in {}\n", row.id, row.mode, row.scene);
  }
}

}  // namespace

void add_list_command(CLI::App& app, const Program&) {
  CLI::App* command = app.add_subcommand("list",
                                         "Estimators, policies, modes, metrics, integrators, "
                                         "samplers, tone maps and scenes, with their sources");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As JSON");
  command->footer("Examples:\n  quartet list\n  quartet list --json");
  command->callback([as_json] {
    if (*as_json) {
      fmt::print("{}\n", json_text(tables()));
    } else {
      print_tables();
    }
  });
}

}  // namespace quartet
