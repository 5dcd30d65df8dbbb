#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/adaptive/lane_snapshot.h"
#include "renderer/measure/metrics.h"

namespace quartet {

/// An error that is good enough.
struct ErrorTarget {
  MetricId metric = MetricId::relmse;
  double value = 0.0;

  /// How much of the samples towards the target are taken, if errors fall as they do for samples at
  /// random; 1 or more where the target is met, and only there.
  double progress(double error) const;
};

/// "relmse=0.01". Throws std::invalid_argument that says what would be right and lists the metrics.
ErrorTarget parse_error_target(std::string_view text);

/// When a lane has had enough: at the first of these that holds. Looked at after whole passes.
struct StopConditions {
  std::optional<std::uint32_t> passes = {};
  std::optional<double> spp = {};      ///< mean over the pixels
  std::optional<double> rays = {};     ///< mean over the pixels
  std::optional<double> seconds = {};  ///< as if alone
  std::optional<ErrorTarget> error = {};

  bool any() const { return passes || spp || rays || seconds || error; }

  /// How much of the way to the nearest end is done; 1 or more at the end. `error` is that of the
  /// lane's picture in the metric of the target, if there is one.
  double progress(const PassRecord& last, std::size_t pixels, double measured_error) const;

  /// The same for a lane, whose picture is compared with `reference` if there is an error target
  /// (std::invalid_argument without one). At the end also where no pixel wants another sample,
  /// since no condition would ever be met.
  double progress(const Lane& lane, const RadianceImage* reference) const;

  /// The same for a lane as it was at the end of a pass. Its true errors are in the metric of the
  /// target; without any, that target is not looked at.
  double progress(const LaneSnapshot& lane) const;

  /// The pass where the lane met its end, of those that its history keeps; nothing if it has not.
  std::optional<std::uint32_t> end_of(const LaneSnapshot& lane) const;

 private:
  double progress_at(const LaneSnapshot& lane, const PassRecord& record) const;
};

}  // namespace quartet
