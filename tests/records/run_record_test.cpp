#include "app/records/run_record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "renderer/base/version.h"
#include "renderer/measure/top_share.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/store/sample_store.h"
#include "renderer/view/views.h"
#include "tests/records/csv.h"
#include "tests/trace/require.h"
#include "tests/view/snapshot_cases.h"

// Records of lanes made by hand, in which every number is another.

namespace quartet {
namespace {

using nlohmann::json;

constexpr std::array record_lanes{EstimatorId::contrast, EstimatorId::kl};

Snapshot numbered_snapshot() {
  Snapshot snapshot = test::blank_snapshot(2, 1, record_lanes);
  static const auto scene = std::make_shared<const TraceScene>(open_scene("synthetic:bernoulli"));
  snapshot.scene = scene;
  snapshot.settings = default_settings(scene->scene());
  snapshot.settings.width = 2;
  snapshot.settings.height = 1;
  snapshot.settings.seed = 77;
  snapshot.settings.max_depth = 9;
  snapshot.settings.integrator = IntegratorId::kajiya;
  snapshot.settings.camera.origin = {1, 2, 3};
  snapshot.settings.camera.right = {0, 0, 1};
  snapshot.settings.camera.up = {0, -1, 0};
  snapshot.settings.camera.forward = {1, 0, 0};

  LaneSnapshot& contrast = snapshot.lanes[0];
  contrast.settings.thresholds = {0.5f, 0.25f, 0.125f};
  contrast.settings.policy = {PolicyId::two_level, 3, 5, 0.75f, true};
  contrast.settings.max_spp = 4321;
  contrast.settings.mode = SampleMode::unbiased;
  contrast.rejected = {4, 7};
  contrast.mean = {{{0.5f, 0.25f}, {0.125f, 1.0f}, {0.75f, 2.0f}}};
  contrast.history = {
      {.pass = 1,
       .samples = 6,
       .pilot_samples = 3,
       .rays = 31,
       .max_spp = 2,
       .not_done = 1,
       .seconds = 0.5},
      {.pass = 2,
       .samples = 10,
       .pilot_samples = 5,
       .rays = 52,
       .max_spp = 4,
       .not_done = 2,
       .seconds = 1.25},
  };
  LaneSnapshot& kl = snapshot.lanes[1];
  kl.settings.thresholds = {0.0625f, 0.0f, 0.0f};
  kl.settings.policy.kind = PolicyId::batch;
  kl.mean = {{{0.25f, 0.25f}, {0.25f, 0.25f}, {0.25f, 0.25f}}};
  kl.history = {
      {.pass = 3, .samples = 15, .rays = 77, .max_spp = 13, .not_done = 0, .seconds = 2.5}};
  return snapshot;
}

std::shared_ptr<const RadianceImage> numbered_truth() {
  auto truth = std::make_shared<RadianceImage>(2, 1);
  truth->pixels()[0] = {1.0f, 0.25f, 0.5f};
  truth->pixels()[1] = {0.5f, 0.5f, 1.0f};
  return truth;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

TEST(CsvRecord, HasEveryNumberInItsColumn) {
  Snapshot snapshot = numbered_snapshot();
  const std::string scene = snapshot.scene->scene().name;
  const std::string contrast =
      scene + ",independent,contrast,two-level,unbiased,0.5 0.25 0.125,77,";
  const std::string kl = scene + ",independent,kl,batch,reuse,0.0625,77,";
  EXPECT_EQ(lines_of(csv_record(snapshot)),
            (std::vector<std::string>{
                ("scene,sampler,estimator,policy,mode,thresholds,seed,pass,seconds,rays,samples,"
                 "mean_spp,metric,value"),
                contrast + "1,0.500000,31,6,3.000000,max_spp,2",
                contrast + "1,0.500000,31,6,3.000000,pilot_samples,3",
                contrast + "1,0.500000,31,6,3.000000,share_not_done,0.500000",
                contrast + "2,1.250000,52,10,5.000000,max_spp,4",
                contrast + "2,1.250000,52,10,5.000000,pilot_samples,5",
                contrast + "2,1.250000,52,10,5.000000,share_not_done,1.000000",
                kl + "3,2.500000,77,15,7.500000,max_spp,13",
                kl + "3,2.500000,77,15,7.500000,pilot_samples,0",
                kl + "3,2.500000,77,15,7.500000,share_not_done,0.000000",
            }));

  snapshot.reference = numbered_truth();
  std::vector<std::string> errors;
  for (const auto& row : rows_of(csv_record(snapshot))) {
    if (row[2] == "kl" && row[12].find("spp") == std::string::npos && row[12] != "pilot_samples" &&
        row[12] != "share_not_done") {
      EXPECT_EQ(row[7], "3");
      errors.push_back(row[12] + " " + row[13]);
    }
  }
  std::vector<std::string> expected;
  RadianceImage shown(2, 1, glm::vec3(0.25f));
  for (const Metric& row : metrics()) {
    expected.push_back(fmt::format("{} {:.9g}", row.id, row.compute(shown, *snapshot.reference)));
    if (row.key == MetricId::relmse) {
      // Of two pixels the worse one: 0.75, 0 and 0.25 off 1, 0.25 and 0.5, of both.
      const double first = 0.5625 / 1.01 + 0.0625 / 0.26;
      const double second = 2 * 0.0625 / 0.26 + 0.5625 / 1.01;
      expected.push_back(fmt::format("relmse_top_thousandth {:.9g}",
                                     relmse_top_share(shown, *snapshot.reference)));
      EXPECT_NEAR(relmse_top_share(shown, *snapshot.reference), second / (first + second), 1e-6);
    }
  }
  // Off by 0.75, 0, 0.25 and 0.25, 0.25, 0.75.
  const double mse = (2 * 0.5625 + 3 * 0.0625) / 6.0;
  expected.push_back(fmt::format("efficiency {:.9g}", 1.0 / (mse * 2.5)));
  ASSERT_FALSE(errors.empty());
  const std::string energy = errors.back();
  errors.pop_back();
  EXPECT_EQ(errors, expected);
  // Luminances of the truth: 0.4275 and 0.5361.
  const std::string name = "energy_error ";
  ASSERT_TRUE(energy.starts_with(name)) << energy;
  EXPECT_NEAR(std::stod(energy.substr(name.size())), 0.25 / 0.4818 - 1.0, 1e-6);
  EXPECT_EQ(errors.front(), fmt::format("mse {:.9g}", mse));
}

TEST(JsonRecord, HasEveryNumberUnderItsName) {
  Snapshot snapshot = numbered_snapshot();
  snapshot.reference = numbered_truth();
  const json record = json::parse(json_record("quartet figure x", snapshot, std::nullopt));
  EXPECT_EQ(record.at("program"), "quartet");
  EXPECT_EQ(record.at("version"), version());
  EXPECT_EQ(record.at("command_line"), "quartet figure x");
  EXPECT_EQ(record.at("scene"), snapshot.scene->scene().name);
  EXPECT_EQ(record.at("scene_file"), snapshot.scene->scene().path.string());
  EXPECT_EQ(record.at("settings"), json::parse(R"({"width": 2, "height": 1, "integrator": "kajiya",
      "sampler": "independent", "max_depth": 9, "seed": 77, "camera": {"origin": [1.0, 2.0, 3.0], "right": [0.0, 0.0, 1.0],
      "up": [0.0, -1.0, 0.0], "forward": [1.0, 0.0, 0.0]}, "filter": "box"})"));
  EXPECT_FALSE(record.contains("threads"));
  EXPECT_FALSE(record.contains("store"));
  EXPECT_FALSE(record.contains("reference"));
  ASSERT_EQ(record.at("lanes").size(), 2u);

  json lane = record.at("lanes")[0];
  EXPECT_EQ(lane.at("metrics").size(), metrics().size() + 3)
      << "what of relmse is at the top, efficiency and energy_error";
  lane.erase("metrics");
  EXPECT_EQ(lane.at("unit"), estimator(EstimatorId::contrast).unit);
  lane.erase("unit");
  EXPECT_EQ(lane, json::parse(R"({"estimator": "contrast", "thresholds": [0.5, 0.25, 0.125],
      "policy": "two-level", "mode": "unbiased", "first_samples": 3, "batch_samples": 5,
      "multiplier": 0.75, "stochastic_rounding": true, "max_spp": 4321, "rejected": 11,
      "history": [
        {"pass": 1, "samples": 6, "pilot_samples": 3, "mean_spp": 3.0, "max_spp": 2,
         "pixels_not_done": 1, "rays": 31, "seconds": 0.5},
        {"pass": 2, "samples": 10, "pilot_samples": 5, "mean_spp": 5.0, "max_spp": 4,
         "pixels_not_done": 2, "rays": 52, "seconds": 1.25}]})"));
  const RadianceImage shown = radiance_image(snapshot, 1);
  for (const Metric& row : metrics()) {
    EXPECT_DOUBLE_EQ(record.at("lanes")[1].at("metrics").at(row.id).get<double>(),
                     row.compute(shown, *snapshot.reference))
        << row.id;
  }
  EXPECT_DOUBLE_EQ(record.at("lanes")[1].at("metrics").at("efficiency").get<double>(),
                   1.0 / ((2 * 0.5625 + 3 * 0.0625) / 6.0 * 2.5));
  EXPECT_EQ(record.at("lanes")[1].at("thresholds"), json::parse("[0.0625]"));
}

/// A store that holds some of the samples that it has traced.
SampleStore used_store(std::uint32_t traced, std::size_t budget) {
  const SampleSource source = [](std::span<SampleJob> jobs) {
    for (SampleJob& job : jobs) {
      std::ranges::fill(job.radiance, glm::vec3(0.5f));
    }
  };
  SampleStore store(2, 1, budget);
  test::require(store, std::vector<std::uint32_t>{0, 0}, std::vector<std::uint32_t>{traced, traced},
                source);
  store.trim(std::vector<std::uint32_t>{1, 2});
  return store;
}

TEST(JsonRecord, SaysWhatTheRunTookAndWhatItIsComparedWith) {
  const Snapshot snapshot = numbered_snapshot();
  const SampleStore shown = used_store(5, std::size_t(1) << 20);
  const SampleStore pilot = used_store(9, 1);
  Reference reference;
  reference.path = "some/reference.exr";
  reference.spp = 300;
  reference.scene_hash = "abc";
  reference.image = *numbered_truth();
  reference.halves = {reference.image, reference.image};
  reference.halves[0].pixels()[0] += glm::vec3(0.5f);
  const json record = json::parse(
      json_record("quartet figure x", snapshot, RunCost{7, &shown, &pilot}, &reference));
  EXPECT_EQ(record.at("threads"), 7);
  for (const auto& [name, store] : {std::pair{"store", &shown}, {"pilot_store", &pilot}}) {
    SCOPED_TRACE(name);
    const json& made = record.at(name);
    EXPECT_EQ(made.size(), 5u);
    EXPECT_EQ(made.at("samples_traced"), store->traced());
    EXPECT_EQ(made.at("samples_stored"), store->stored());
    EXPECT_EQ(made.at("bytes"), store->bytes());
    EXPECT_DOUBLE_EQ(made.at("seconds").get<double>(), store->seconds());
    EXPECT_EQ(made.at("partial"), store->partial());
  }
  EXPECT_EQ(record.at("store").at("samples_traced"), 10);
  EXPECT_EQ(record.at("pilot_store").at("samples_traced"), 18);
  EXPECT_NE(record.at("pilot_store").at("samples_stored"), 18);
  EXPECT_EQ(record.at("store").at("partial"), false);
  EXPECT_EQ(record.at("pilot_store").at("partial"), true);
  EXPECT_EQ(record.at("reference").at("file"), "some/reference.exr");
  EXPECT_EQ(record.at("reference").at("spp"), 300);
  EXPECT_EQ(record.at("reference").at("sampler"), "sobol");
  for (const Metric& row : metrics()) {
    EXPECT_DOUBLE_EQ(record.at("reference").at("noise_floor").at(row.id).get<double>(),
                     reference.noise_floor(row.key))
        << row.id;
  }
  // A quarter of the squared difference of the halves, in half of the channels.
  EXPECT_DOUBLE_EQ(record.at("reference").at("noise_floor").at("mse").get<double>(), 0.0625 / 2.0);
}

TEST(ExrAttributes, HaveEveryNumberUnderItsName) {
  Snapshot snapshot = numbered_snapshot();
  std::map<std::string, std::string> attributes = exr_attributes("quartet render x", snapshot, 0);
  const json settings = json::parse(attributes.at("settings"));
  EXPECT_EQ(settings.at("passes"), 2);
  EXPECT_EQ(settings.at("seed"), 77);
  EXPECT_EQ(settings.at("lane").at("estimator"), "contrast");
  EXPECT_EQ(settings.at("lane").at("max_spp"), 4321);
  attributes.erase("settings");
  EXPECT_EQ(attributes.at("varianceMeaning"),
            "Variance.*: s²/n, an unbiased estimate of the variance of the pixel mean");
  attributes.erase("varianceMeaning");
  EXPECT_EQ(attributes, (std::map<std::string, std::string>{
                            {"scene", snapshot.scene->scene().name},
                            {"seed", "77"},
                            {"version", std::string(version())},
                            {"commandLine", "quartet render x"},
                            {"mode", "unbiased"},
                            {"sampler", "independent"},
                            {"seconds", "1.25"},
                            {"rays", "52"},
                            {"samples", "10"},
                            {"pilotSamples", "5"},
                        }));
  EXPECT_EQ(exr_attributes("", snapshot, 1).at("seconds"), "2.5");
  snapshot.lanes[1].history.clear();
  EXPECT_FALSE(exr_attributes("", snapshot, 1).contains("samples"));
}

}  // namespace
}  // namespace quartet
