#pragma once

#include "renderer/files/exr.h"
#include "renderer/session/snapshot.h"

namespace quartet {

/// At most, of an estimator with three channels and with a reference.
inline constexpr std::size_t lane_exr_channels = 12;

/// Everything a snapshot knows about a lane's pixels: R, G, B, SampleCount (samples in the mean),
/// Rejected, Error.<estimator> (Error.<estimator>.R/G/B where it has three), Variance.R/G/B of the
/// mean where it has them, by that name where the sampler tells it (sampler_row.h), and
/// SquaredError (mean over the channels) where there is a reference. Of what is more than a float
/// holds, the largest float.
ExrImage lane_exr(const Snapshot& snapshot, std::size_t lane);

}  // namespace quartet
