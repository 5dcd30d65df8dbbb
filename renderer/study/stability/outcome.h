#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/adaptive/lane.h"
#include "renderer/study/stability/audit.h"
#include "renderer/study/stability/failure_case.h"
#include "renderer/study/stability/truth.h"

namespace quartet {

/// What is measured of one lane that has run to its end, against the truth; NaN: it was not. Shares
/// are of pixels unless said otherwise; `region` is where the failure lives. A pixel is wrong if
/// its squared relative error is above the common target.
struct Outcome {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double mean_spp = unknown;   ///< the pilot's samples included
  double mean_rays = unknown;  ///< a pixel
  double seconds = unknown;    ///< as if alone

  // Of the picture:
  double relmse = unknown;         ///< mean squared relative error
  double worst = unknown;          ///< the same of the worst 0.1 % of pixels
  double fireflies = unknown;      ///< share of pixels more than 5 × (truth + 0.1) too bright
  double energy = unknown;         ///< mean luminance of the picture over the true one, less 1
  double region_energy = unknown;  ///< the same of the region

  // Of the decisions:
  double done = unknown;        ///< share of the region that the criterion is done with
  double missed = unknown;      ///< share of those done that are wrong nevertheless
  double never_done = unknown;  ///< share of the region that is at the maximum though not wrong
  double never_done_cost = unknown;  ///< share of all samples that those pixels took
  double wasted = unknown;      ///< share of the samples after the first pass, of pixels not wrong
  double off_oracle = unknown;  ///< share of the samples that an oracle would have put elsewhere
  double region_spp = unknown;  ///< mean samples of the region's pixels
  double rejected = unknown;    ///< share of the samples
  Audit::Finding audit;         ///< over the region
};

/// What can be said of a picture alone.
Outcome outcome_of(const RadianceImage& picture, const RadianceImage& truth,
                   const PixelRegion& region);
/// Adds what a lane took.
void set_cost(Outcome& outcome, const Lane& lane);

/// Follows a lane from pass to pass.
class Observation {
 public:
  Observation(const Truth& truth, const PixelRegion& region, double target);

  /// Before a lane takes its next pass.
  void before_pass(const Lane& lane);
  /// `oracle` is samples per pixel of a lane that knows the truth.
  Outcome outcome(const Lane& lane, std::span<const std::uint32_t> oracle, const Audit& audit);

 private:
  const Truth& truth_;
  PixelRegion region_;
  double target_;
  double spent_ = 0.0;   // samples after the first pass
  double wasted_ = 0.0;  // of those
};

/// One row of the table of numbers in an outcome.
struct OutcomeColumn {
  std::string_view id;    ///< in files
  std::string_view unit;  ///< empty for shares and ratios
  double Outcome::*value;
};
std::span<const OutcomeColumn> outcome_columns();

}  // namespace quartet
