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

class UniformRun;

/// What a trial's pixels are judged by.
struct Judgement {
  Truth truth;
  /// In every channel of a pixel, the squared relative error that one sample has in expectation, so
  /// that n samples have an nth of it; see expected_errors().
  std::shared_ptr<const RadianceImage> expected;
  /// What an oracle that knows `expected` brings every pixel down to with the common budget.
  double limit = 0.0;
  PixelRegion region{};  ///< where the failure lives
};

/// Twice the relative error that an oracle leaves: above it a squared error is wrong.
inline constexpr double wrong_over_limit = 4.0;

/// What is measured of one lane that has run to its end; NaN: it was not. Shares are of pixels
/// unless said otherwise.
struct Outcome {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double mean_spp = unknown;   ///< the pilot's samples included
  double mean_rays = unknown;  ///< a pixel
  double seconds = unknown;    ///< as if alone

  // Of the picture:
  double relmse = unknown;         ///< mean squared relative error
  double regions = unknown;        ///< MetricId::relmse_regions
  double worst = unknown;          ///< the same of the worst 0.1 % of pixels
  double fireflies = unknown;      ///< share of pixels more than 5 × (truth + 0.1) too bright
  double energy = unknown;         ///< mean luminance of the picture over the true one, less 1
  double region_energy = unknown;  ///< the same of the region

  // Of the decisions:
  double done = unknown;       ///< share of the region that the criterion is done with
  double missed = unknown;     ///< share of those done that are wrong nevertheless
  double too_early = unknown;  ///< share of those done whose expected error is wrong
  /// Share of the region that is at the maximum, though an oracle is done with so many samples.
  double never_done = unknown;
  double never_done_cost = unknown;  ///< share of all samples that those pixels took
  /// Share of the samples after the first pass, of pixels that an oracle was done with.
  double wasted = unknown;
  double off_oracle = unknown;  ///< share of the samples that an oracle would have put elsewhere
  double region_spp = unknown;  ///< mean samples of the region's pixels
  double rejected = unknown;    ///< share of the samples

  // Beside uniform sampling with the same seed, run to the lane's own effort:
  double over_uniform = unknown;       ///< its `regions` over that at equal samples
  double over_uniform_rays = unknown;  ///< the same at equal rays
  /// `region_energy`, where the truth is rendered less that of as many uniform samples as any pixel
  /// may have: they share samples and so much of the noise, and unlike that of the truth, their
  /// noise is seen in the spread over seeds.
  double off = unknown;

  std::vector<Audit::Look> audit;  ///< over the region
};

/// Luminance of a region of the picture over that of the truth, less 1; their difference where the
/// truth is black.
double energy_of(const RadianceImage& picture, const RadianceImage& truth,
                 const PixelRegion& region);

/// What can be said of a picture alone.
Outcome outcome_of(const RadianceImage& picture, const RadianceImage& truth,
                   const PixelRegion& region);
/// Adds what a lane took.
void set_cost(Outcome& outcome, const Lane& lane);

/// Adds what stands beside uniform sampling.
void set_beside(Outcome& outcome, const UniformRun& uniform, const Truth& truth);

/// Follows a lane from pass to pass.
class Observation {
 public:
  explicit Observation(const Judgement& judgement) : judgement_(judgement) {}

  /// Before a lane takes its next pass.
  void before_pass(const Lane& lane);
  /// `oracle` is samples per pixel of a lane that knows what is expected.
  Outcome outcome(const Lane& lane, std::span<const std::uint32_t> oracle, const Audit& audit);

 private:
  const Judgement& judgement_;
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
