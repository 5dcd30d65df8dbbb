#include "renderer/image/views.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>
#include <stdexcept>

#include "renderer/adaptive/lab.h"
#include "renderer/image/lane_exr.h"
#include "renderer/image/pixel_values.h"
#include "tests/image/snapshot_cases.h"

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
  const SamplingPolicy policy = default_policy(EstimatorId::variance);
  Lab lab(source, 3, 2, std::span(&policy, 1), options);
  ASSERT_TRUE(lab.run_frame());
  Snapshot snapshot;
  copy_lanes(lab, snapshot);
  snapshot.reference = std::make_shared<const RadianceImage>(3, 2, glm::vec3(0.0f));
  const ExrImage exr = lane_exr(snapshot, 0);
  for (const char* name : {"Variance.R", "Variance.B", "SquaredError", "Error.variance"}) {
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
  const float threshold = kl.policy.thresholds[0];
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
  contrast.policy.thresholds = {0.4f, 0.2f, 0.5f};
  //                red         green       blue
  contrast.error = {0.4f, 0.0f, 0.1f, 0.4f, 0.25f, 0.25f};
  EXPECT_EQ(relative_error(contrast), (std::vector<float>{1.0f, 2.0f}));
  EXPECT_EQ(pixel_values(contrast, 1).relative_error, 2.0f);
  EXPECT_EQ(pixel_values(contrast, 1).error, (std::array{0.0f, 0.4f, 0.25f}));
}

TEST(Views, StopStatesAreThoseOfThePolicy) {
  Snapshot snapshot = blank_snapshot(4, 1, two);
  LaneSnapshot& kl = snapshot.lanes[1];
  const float threshold = kl.policy.thresholds[0];
  kl.policy.max_spp = 9;
  kl.error = {0.0f, threshold, 1.5f * threshold, 1.5f * threshold};
  kl.taken = {9, 1, 8, 9};
  const View view = draw_view(snapshot, 1, ViewKind::stop_state, {});
  ASSERT_EQ(view.legend.size(), 3u);
  const auto active = view.legend[0].color;
  const auto satisfied = view.legend[1].color;
  const auto at_maximum = view.legend[2].color;
  EXPECT_EQ(view.image.at(0, 0), at_maximum);
  EXPECT_EQ(view.image.at(1, 0), satisfied) << "at the threshold is not above it";
  EXPECT_EQ(view.image.at(2, 0), active);
  EXPECT_EQ(view.image.at(3, 0), at_maximum);
  EXPECT_EQ(view.legend[0].pixels, 1u);
  EXPECT_EQ(view.legend[1].pixels, 1u);
  EXPECT_EQ(view.legend[2].pixels, 2u);
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
  snapshot.lanes[1].policy.max_spp = 40;
  const View view = draw_view(snapshot, 1, ViewKind::heatmap, {});
  EXPECT_EQ(view.image.at(1, 0), kCapColor);
  EXPECT_EQ(view.bar->cap_label, "at the maximum of 40 spp");
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
  const ExrImage exr = lane_exr(snapshot, 0);
  for (const char* name : {"R", "G", "B", "Rejected", "Error.contrast.R", "Error.contrast.G",
                           "Error.contrast.B", "Variance.R", "Variance.G", "Variance.B"}) {
    EXPECT_TRUE(exr.find(name)) << name;
  }
  EXPECT_EQ(std::get<std::vector<std::uint32_t>>(exr.find("SampleCount")->pixels),
            (std::vector<std::uint32_t>{3, 5}));
  const ExrImage other = lane_exr(snapshot, 1);
  EXPECT_TRUE(other.find("Error.kl"));
  EXPECT_FALSE(other.find("Variance.R"));
}

}  // namespace
}  // namespace quartet
