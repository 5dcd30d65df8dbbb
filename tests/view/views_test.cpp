#include "renderer/view/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "renderer/adaptive/lab.h"
#include "renderer/scene/load_scene.h"
#include "renderer/study/stability/outcome.h"
#include "renderer/view/lane_exr.h"
#include "renderer/view/pixel_values.h"
#include "tests/view/snapshot_cases.h"

namespace quartet {
namespace {

using test::blank_snapshot;
using test::finish;

constexpr std::array two{EstimatorId::contrast, EstimatorId::kl};

TEST(LaneExr, NothingIsInfiniteWhereAFloatHoldsTooLittle) {
  // Two samples of a pixel: the largest, and none.
  constexpr float most = std::numeric_limits<float>::max();
  const SampleSource source([](int x, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = glm::vec3(x == 0 && (first + i) % 2 == 0 ? most : 0.0f);
    }
  });
  LabOptions options;
  options.statistics.variance = true;
  const LaneSettings settings = default_settings(EstimatorId::variance);
  Lab lab(source, 3, 2, std::span(&settings, 1), options);
  ASSERT_TRUE(lab.run_pass());
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  snapshot.reference = std::make_shared<const RadianceImage>(3, 2, glm::vec3(0.0f));
  const ExrImage exr = lane_exr(snapshot, 0);
  for (const char* name :
       {"VarianceIfIndependent.R", "VarianceIfIndependent.B", "SquaredError", "Error.variance"}) {
    SCOPED_TRACE(name);
    ASSERT_NE(exr.find(name), nullptr);
    const auto& values = std::get<std::vector<float>>(exr.find(name)->pixels);
    EXPECT_EQ(values[0], most);
    EXPECT_EQ(values[1], 0.0f);
  }
}

TEST(Views, EachRowDrawsEveryPixelOfEveryLane) {
  const std::array all{EstimatorId::contrast, EstimatorId::kl, EstimatorId::uniform};
  Snapshot snapshot = blank_snapshot(5, 3, all);
  finish(snapshot);
  std::set<std::string_view> ids;
  for (const ViewRow& row : views()) {
    SCOPED_TRACE(row.id);
    EXPECT_TRUE(ids.insert(row.id).second);
    EXPECT_EQ(&find_view(row.id), &row);
    EXPECT_EQ(row.has_bar, !row.quantity.empty());
    for (std::size_t lane = 0; lane < snapshot.lanes.size(); ++lane) {
      const View view = draw_view(snapshot, lane, row.key, {});
      EXPECT_EQ(view.image.width(), 5);
      EXPECT_EQ(view.image.height(), 3);
      EXPECT_EQ(view.bar.has_value(), row.has_bar && (view.note.empty() || view.bar));
      if (view.bar) {
        EXPECT_EQ(view.bar->label, row.quantity);
      }
    }
  }
  EXPECT_THROW(find_view("albedo"), std::invalid_argument);
}

TEST(Views, TheThresholdLiesInTheMiddleOfTheErrorScale) {
  Snapshot snapshot = blank_snapshot(4, 1, two);
  LaneSnapshot& kl = snapshot.lanes[1];
  const float threshold = kl.settings.thresholds[0];
  kl.error = {0.0f, threshold, 2.0f * threshold, 100.0f * threshold};
  const View view = draw_view(snapshot, 1, ViewKind::error, {});
  EXPECT_EQ(view.image.at(0, 0), sample(ColorMapId::turbo, 0.0f));
  EXPECT_EQ(view.image.at(1, 0), sample(ColorMapId::turbo, 0.5f));
  EXPECT_EQ(view.image.at(2, 0), sample(ColorMapId::turbo, 1.0f));
  EXPECT_EQ(view.image.at(3, 0), sample(ColorMapId::turbo, 1.0f));
  EXPECT_EQ(scale_position(view.bar->scale, 1.0), 0.5f);
}

TEST(Views, ContrastCountsItsChannelWithTheLargestErrorForItsThreshold) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  LaneSnapshot& contrast = snapshot.lanes[0];
  contrast.settings.thresholds = {0.4f, 0.2f, 0.5f};
  //                red         green       blue
  contrast.error = {0.4f, 0.0f, 0.1f, 0.4f, 0.25f, 0.25f};
  EXPECT_EQ(largest_scaled_errors(contrast), (std::vector<float>{1.0f, 2.0f}));
  EXPECT_EQ(pixel_values(contrast, 1).scaled_error, 2.0f);
  EXPECT_EQ(pixel_values(contrast, 1).error, (std::array{0.0f, 0.4f, 0.25f}));
}

TEST(Views, StopStatesAreThoseOfTheLaneSettings) {
  Snapshot snapshot = blank_snapshot(4, 1, two);
  LaneSnapshot& kl = snapshot.lanes[1];
  const float threshold = kl.settings.thresholds[0];
  kl.settings.max_spp = 9;
  kl.error = {0.0f, threshold, 1.5f * threshold, 1.5f * threshold};
  kl.taken = {9, 1, 8, 9};
  const View view = draw_view(snapshot, 1, ViewKind::stop_state, {});
  ASSERT_EQ(view.legend.size(), 3u);
  using enum PixelState;
  constexpr std::array expected{done, done, refining, at_maximum};
  for (int x = 0; x < 4; ++x) {
    const PixelState state = expected[std::size_t(x)];
    EXPECT_EQ(view.image.at(x, 0), view.legend[std::size_t(state)].color) << x;
    EXPECT_EQ(pixel_values(kl, std::size_t(x)).state, state) << x;
  }
  EXPECT_EQ(view.legend[0].label, "done");
  EXPECT_EQ(view.legend[1].label, "refining: error above its threshold");
  EXPECT_EQ(view.legend[2].label, "at the maximum of 9 spp");
  EXPECT_EQ(view.legend[0].pixels, 2u);
  EXPECT_EQ(view.legend[1].pixels, 1u);
  EXPECT_EQ(view.legend[2].pixels, 1u);
}

TEST(Views, TheLegendOfStopStatesSaysWhatKeepsAPixelFromBeingDone) {
  const std::array estimators{EstimatorId::cycles, EstimatorId::uniform};
  Snapshot snapshot = blank_snapshot(1, 1, estimators);
  snapshot.lanes[0].settings.thresholds[0] = 100.0f;
  const auto label = [&](std::size_t lane) {
    return draw_view(snapshot, lane, ViewKind::stop_state, {}).legend[1].label;
  };
  EXPECT_EQ(label(0), "refining: error above its threshold or below 5 spp");
  EXPECT_EQ(label(1), "refining");
}

// Two values at random: where the first samples agree, the variance is 0 and a pixel is done; the
// others take all that they may, until they are done too.
TEST(Views, StopStatesAreThoseOfAStudy) {
  constexpr int side = 32;
  const auto scene = std::make_shared<const TraceScene>(open_scene("synthetic:bernoulli"));
  RenderSettings settings = default_settings(scene->scene());
  settings.width = settings.height = side;
  LaneSettings lane_settings = default_settings(EstimatorId::variance);
  lane_settings.thresholds[0] = 0.05f;
  lane_settings.max_spp = 16;
  Lab lab(sample_source(scene, settings), side, side, std::span(&lane_settings, 1));
  while (lab.lanes()[0].plan().total > 0) {
    lab.run_pass();
  }
  const Lane& lane = lab.lanes()[0];
  ASSERT_EQ(std::ranges::count(lane.taken(), 16u), 580);

  Truth truth;
  truth.image = std::make_shared<const RadianceImage>(side, side, glm::vec3(1.0f));
  const Audit audit([](int, int, std::uint32_t, std::span<glm::vec3>) {}, side, side, 0.0, 2, 0);
  const Judgement judgement{
      truth, std::make_shared<RadianceImage>(side, side, glm::vec3(1.0f)), 1.0, {0, 0, side, side}};
  const Outcome outcome = Observation(judgement).outcome(lane, lane.taken(), audit);
  EXPECT_EQ(outcome.done, 1.0);
  EXPECT_EQ(outcome.never_done, 0.0);

  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  const View view = draw_view(snapshot, 0, ViewKind::stop_state, {});
  EXPECT_EQ(view.legend[std::size_t(PixelState::done)].pixels, 1024u);
  EXPECT_EQ(view.legend[std::size_t(PixelState::refining)].pixels, 0u);
  EXPECT_EQ(view.legend[std::size_t(PixelState::at_maximum)].pixels, 0u);
}

TEST(Views, LinkedHeatmapsShareAScaleAndReportOnesDoNot) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  snapshot.lanes[0].taken = {2, 10};
  snapshot.lanes[1].taken = {3, 40};
  finish(snapshot);
  for (std::size_t lane = 0; lane < 2; ++lane) {
    EXPECT_EQ(heat_scale(snapshot, lane, HeatRange::linked),
              (ColorScale{0, 40, ColorMapId::turbo}));
  }
  EXPECT_EQ(heat_scale(snapshot, 0, HeatRange::report), (ColorScale{2, 10, ColorMapId::report}));
  EXPECT_EQ(heat_scale(snapshot, 1, HeatRange::report), (ColorScale{3, 40, ColorMapId::report}));
  snapshot.lanes[1].settings.max_spp = 40;
  const View view = draw_view(snapshot, 1, ViewKind::heatmap, {});
  EXPECT_EQ(view.image.at(1, 0), cap_color);
  EXPECT_EQ(view.bar->cap_label, "the maximum of 40 spp");
}

TEST(Views, DifferencesAreSignedAndSymmetric) {
  Snapshot snapshot = blank_snapshot(3, 1, two);
  for (std::size_t c = 0; c < 3; ++c) {
    snapshot.lanes[0].mean[c] = {1.0f, 1.0f, 4.0f};
    snapshot.lanes[1].mean[c] = {1.0f, 5.0f, 1.0f};
  }
  ViewSettings settings;
  settings.other = 1;
  const View view = draw_view(snapshot, 0, ViewKind::difference, settings);
  EXPECT_EQ(view.bar->scale, (ColorScale{-5, 5, ColorMapId::coolwarm}));
  EXPECT_EQ(view.image.at(0, 0), sample(ColorMapId::coolwarm, 0.5f));
  EXPECT_EQ(view.image.at(1, 0), sample(ColorMapId::coolwarm, 0.1f));
  EXPECT_EQ(view.image.at(2, 0), sample(ColorMapId::coolwarm, 0.8f));
  EXPECT_FALSE(draw_view(snapshot, 1, ViewKind::difference, settings).note.empty());
  settings.other = 2;
  EXPECT_FALSE(draw_view(snapshot, 0, ViewKind::difference, settings).note.empty());
}

TEST(Views, VarianceIsLogarithmicAndLinked) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  EXPECT_FALSE(draw_view(snapshot, 0, ViewKind::variance, {}).note.empty());
  //                              red         green       blue
  snapshot.lanes[0].variance = {0.0f, 0.01f, 0.1f, 0.0f, 0.0f, 0.0f};
  snapshot.lanes[1].variance = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 30.0f};
  const View view = draw_view(snapshot, 0, ViewKind::variance, {});
  EXPECT_DOUBLE_EQ(view.bar->scale.max, 100.0);
  EXPECT_DOUBLE_EQ(view.bar->scale.min, 1e-4);
  EXPECT_EQ(view.image.at(0, 0), sample(ColorMapId::viridis, 0.5f));
  EXPECT_EQ(pixel_values(snapshot.lanes[0], 0).variance, glm::vec3(0.0f, 0.1f, 0.0f));
}

TEST(Views, RejectedSamplesAreShownAndNamedPerPixel) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  EXPECT_FALSE(draw_view(snapshot, 0, ViewKind::rejected, {}).note.empty());
  snapshot.lanes[1].rejected = {0, 4};
  const View view = draw_view(snapshot, 1, ViewKind::rejected, {});
  EXPECT_TRUE(view.note.empty());
  EXPECT_EQ(view.image.at(0, 0), sample(ColorMapId::viridis, 0.0f));
  EXPECT_EQ(view.image.at(1, 0), sample(ColorMapId::viridis, 1.0f));
  EXPECT_EQ(pixel_values(snapshot.lanes[1], 1).rejected, 4u);
  EXPECT_EQ(pixel_values(snapshot.lanes[0], 1).rejected, 0u);
}

/// What a display shows of linear radiance: sRGB, in 255 steps.
int shown(double linear) {
  const double cut = std::clamp(linear, 0.0, 1.0);
  const double encoded = cut <= 0.0031308 ? 12.92 * cut : 1.055 * std::pow(cut, 1.0 / 2.4) - 0.055;
  return int(std::lround(255.0 * encoded));
}

TEST(Views, ThePictureAndTheReferenceAreShownAlike) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  RadianceImage truth(2, 1);
  truth.pixels()[0] = {0.01f, 0.02f, 0.04f};
  truth.pixels()[1] = {0.1f, 0.2f, 0.3f};
  for (std::size_t i = 0; i < 2; ++i) {
    for (int c = 0; c < 3; ++c) {
      snapshot.lanes[1].mean[std::size_t(c)][i] = truth.pixels()[i][c];
    }
  }
  snapshot.reference = std::make_shared<const RadianceImage>(truth);
  for (const float exposure : {-1.5f, 0.0f, 1.0f, 2.0f}) {
    ViewSettings settings;
    settings.exposure = exposure;
    for (const ViewKind kind : {ViewKind::image, ViewKind::reference}) {
      SCOPED_TRACE(std::string(view_row(kind).id) + " at " + std::to_string(exposure));
      const View view = draw_view(snapshot, 1, kind, settings);
      for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 c = glm::dvec3(truth.pixels()[i]) * std::exp2(double(exposure));
        const Rgba8 pixel = view.image.pixels()[i];
        EXPECT_EQ(int(pixel.r), shown(c.r));
        EXPECT_EQ(int(pixel.g), shown(c.g));
        EXPECT_EQ(int(pixel.b), shown(c.b));
      }
    }
    for (const ToneMapRow& row : tone_maps()) {
      settings.tone_map = row.key;
      EXPECT_EQ(draw_view(snapshot, 1, ViewKind::reference, settings).image,
                draw_view(snapshot, 1, ViewKind::image, settings).image)
          << row.id;
    }
  }
}

TEST(Views, TrueErrorsAreRelativeAndLogarithmic) {
  Snapshot snapshot = blank_snapshot(3, 1, two);
  EXPECT_FALSE(draw_view(snapshot, 0, ViewKind::true_error, {}).note.empty());
  EXPECT_FALSE(draw_view(snapshot, 0, ViewKind::reference, {}).note.empty());
  // (x − r)² / (r² + 0.01), the mean over the channels: 1, 1/1000 and 1/3 of 0.01.
  RadianceImage truth(3, 1);
  for (std::size_t c = 0; c < 3; ++c) {
    snapshot.lanes[1].mean[c] = {0.1f, std::sqrt(1e-5f), 0.3f};
  }
  truth.pixels()[2] = glm::vec3(0.3f);
  snapshot.lanes[1].mean[1][2] += std::sqrt(0.001f);
  snapshot.reference = std::make_shared<const RadianceImage>(truth);
  const View view = draw_view(snapshot, 1, ViewKind::true_error, {});
  EXPECT_EQ(view.bar->scale, (ColorScale{1e-6, 1.0, ColorMapId::viridis, Spacing::logarithmic}));
  const auto expect_at = [&](int x, double error) {
    const double place = 1.0 + std::log10(error) / 6.0;
    EXPECT_EQ(view.image.at(x, 0), sample(ColorMapId::viridis, float(place))) << x;
  };
  expect_at(0, 1.0);
  expect_at(1, 1e-3);
  expect_at(2, 0.01 / 3.0);
}

TEST(Views, HeatmapsShowTheShareOfTheHighestCount) {
  Snapshot snapshot = blank_snapshot(3, 1, two);
  snapshot.lanes[0].taken = {0, 10, 30};
  snapshot.lanes[1].taken = {1, 2, 40};
  finish(snapshot);
  const View linked = draw_view(snapshot, 0, ViewKind::heatmap, {});
  EXPECT_EQ(linked.image.at(0, 0), sample(ColorMapId::turbo, 0.0f));
  EXPECT_EQ(linked.image.at(1, 0), sample(ColorMapId::turbo, 0.25f));
  EXPECT_EQ(linked.image.at(2, 0), sample(ColorMapId::turbo, 0.75f));
  ViewSettings report;
  report.heat = HeatRange::report;
  const View own = draw_view(snapshot, 0, ViewKind::heatmap, report);
  EXPECT_EQ(own.image.at(0, 0), sample(ColorMapId::report, 0.0f));
  EXPECT_EQ(own.image.at(1, 0), sample(ColorMapId::report, 1.0f / 3.0f));
  EXPECT_EQ(own.image.at(2, 0), sample(ColorMapId::report, 1.0f));
}

TEST(Views, RejectedSamplesShareAScale) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  snapshot.lanes[0].rejected = {2, 1};
  snapshot.lanes[1].rejected = {0, 8};
  const View view = draw_view(snapshot, 0, ViewKind::rejected, {});
  EXPECT_EQ(view.bar->scale, (ColorScale{0.0, 8.0, ColorMapId::viridis}));
  EXPECT_EQ(view.image.at(0, 0), sample(ColorMapId::viridis, 0.25f));
  EXPECT_EQ(view.image.at(1, 0), sample(ColorMapId::viridis, 0.125f));
  std::swap(snapshot.lanes[0].rejected, snapshot.lanes[1].rejected);
  EXPECT_EQ(draw_view(snapshot, 1, ViewKind::rejected, {}).bar->scale, view.bar->scale);
}

TEST(Views, DifferencesAreOfLuminance) {
  Snapshot snapshot = blank_snapshot(3, 1, two);
  for (std::size_t c = 0; c < 3; ++c) {
    snapshot.lanes[0].mean[c][c] = 0.5f;  // red, green and blue, side by side
  }
  ViewSettings settings;
  settings.other = 1;
  const View view = draw_view(snapshot, 0, ViewKind::difference, settings);
  ASSERT_EQ(view.bar->scale, (ColorScale{-0.5, 0.5, ColorMapId::coolwarm}));
  const auto expect_at = [&](int x, double weight) {
    EXPECT_EQ(view.image.at(x, 0), sample(ColorMapId::coolwarm, float(0.5 + 0.5 * weight))) << x;
  };
  expect_at(0, 0.2126);
  expect_at(1, 0.7152);
  expect_at(2, 0.0722);
}

TEST(Views, ImagesGoThroughExposureAndToneMap) {
  Snapshot snapshot = blank_snapshot(1, 1, two);
  for (std::vector<float>& plane : snapshot.lanes[0].mean) {
    plane[0] = 0.25f;
  }
  ViewSettings settings;
  settings.exposure = 1.0f;
  settings.tone_map = ToneMap::reinhard;
  EXPECT_EQ(draw_view(snapshot, 0, ViewKind::image, settings).image,
            to_display(RadianceImage(1, 1, glm::vec3(0.25f)), 1.0f, ToneMap::reinhard));
}

TEST(LaneExr, HoldsWhatTheSnapshotKnows) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  snapshot.lanes[0].taken = {3, 7};
  snapshot.lanes[0].rejected = {0, 2};
  snapshot.lanes[0].variance.assign(6, 0.5f);
  snapshot.settings.sampler = SamplerId::replicated;
  const ExrImage exr = lane_exr(snapshot, 0);
  for (const char* name : {"R", "G", "B", "Rejected", "Error.contrast.R", "Error.contrast.G",
                           "Error.contrast.B", "Variance.R", "Variance.G", "Variance.B"}) {
    EXPECT_TRUE(exr.find(name)) << name;
  }
  EXPECT_EQ(std::get<std::vector<float>>(exr.find("SampleCount")->pixels),
            (std::vector<float>{3, 5}));
  const ExrImage other = lane_exr(snapshot, 1);
  EXPECT_TRUE(other.find("Error.kl"));
  EXPECT_FALSE(other.find("Variance.R"));
}

// What one scrambled sequence tells is not the variance of its mean, and no file calls it that.
TEST(LaneExr, CallsTheVarianceWhatTheSamplerMakesOfIt) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  snapshot.lanes[0].variance.assign(6, 0.5f);
  for (const SamplerRow& row : samplers()) {
    SCOPED_TRACE(row.id);
    snapshot.settings.sampler = row.key;
    const ExrImage exr = lane_exr(snapshot, 0);
    EXPECT_EQ(exr.find("Variance.G") != nullptr, row.knows_variance);
    EXPECT_EQ(exr.find("VarianceIfIndependent.G") != nullptr, !row.knows_variance);
    const View view = draw_view(snapshot, 0, ViewKind::variance, {});
    EXPECT_EQ(view.bar.value().label.starts_with("variance of the mean"), row.knows_variance)
        << view.bar->label;
  }
}

TEST(LaneExr, EveryChannelHoldsItsOwnNumbers) {
  Snapshot snapshot = blank_snapshot(2, 1, two);
  LaneSnapshot& lane = snapshot.lanes[0];
  lane.mean = {{{1.0f, 2.0f}, {3.0f, 4.0f}, {5.0f, 6.0f}}};
  lane.taken = {107, 108};
  lane.rejected = {9, 10};
  lane.error = {11.0f, 12.0f, 13.0f, 14.0f, 15.0f, 16.0f};
  lane.variance = {21.0f, 22.0f, 23.0f, 24.0f, 25.0f, 26.0f};
  RadianceImage truth(2, 1);
  truth.pixels()[0] = {0.0f, 1.0f, 2.0f};  // off by 1, 2 and 3
  truth.pixels()[1] = {2.0f, 4.0f, 0.0f};  // by 0, 0 and 6
  snapshot.reference = std::make_shared<const RadianceImage>(truth);
  const ExrImage exr = lane_exr(snapshot, 0);
  const auto floats = [&](const char* name) {
    const ExrChannel* channel = exr.find(name);
    return channel ? std::get<std::vector<float>>(channel->pixels) : std::vector<float>();
  };
  using Floats = std::vector<float>;
  EXPECT_EQ(floats("R"), (Floats{1, 2}));
  EXPECT_EQ(floats("G"), (Floats{3, 4}));
  EXPECT_EQ(floats("B"), (Floats{5, 6}));
  EXPECT_EQ(floats("SampleCount"), (Floats{98, 98}));
  EXPECT_EQ(floats("Rejected"), (Floats{9, 10}));
  EXPECT_EQ(floats("Error.contrast.R"), (Floats{11, 12}));
  EXPECT_EQ(floats("Error.contrast.G"), (Floats{13, 14}));
  EXPECT_EQ(floats("Error.contrast.B"), (Floats{15, 16}));
  EXPECT_EQ(floats("VarianceIfIndependent.R"), (Floats{21, 22}));
  EXPECT_EQ(floats("VarianceIfIndependent.G"), (Floats{23, 24}));
  EXPECT_EQ(floats("VarianceIfIndependent.B"), (Floats{25, 26}));
  EXPECT_EQ(floats("SquaredError"), (Floats{14.0f / 3.0f, 12.0f}));
  EXPECT_EQ(exr.channels.size(), 12u);
  snapshot.lanes[1].error = {31.0f, 32.0f};
  EXPECT_EQ(std::get<Floats>(lane_exr(snapshot, 1).find("Error.kl")->pixels), (Floats{31, 32}));
}

}  // namespace
}  // namespace quartet
