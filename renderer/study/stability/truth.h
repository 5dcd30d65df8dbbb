#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/trace/integrator.h"

namespace quartet {

/// What a picture should be.
struct Truth {
  std::shared_ptr<const RadianceImage> image;
  /// Of the truth itself, as squared_errors() gives it, on average; 0 where it is exact.
  double noise = 0.0;
  std::uint64_t spp = 0;  ///< that it was made of; 0: it is exact
};

/// How much a truth may cost: it gets samples until its noise is below `noise`, or it has
/// `most_spp`.
struct TruthEffort {
  double noise = 0.002;
  std::uint32_t most_spp = 8192;
};

/// Of a synthetic source exact, else rendered with seeds of its own on the threads of the current
/// TBB arena. `go_on` is called now and then with the share of most_spp that is done; if it returns
/// false, the truth is given up and null comes back.
std::shared_ptr<const Truth> find_truth(std::shared_ptr<const TraceScene> scene,
                                        const RenderSettings& settings, const TruthEffort& effort,
                                        const std::function<bool(double)>& go_on);

/// Squared relative error of each pixel, the mean over the channels of (x − r)² / (r² + 0.01): a
/// map of relmse.
std::vector<float> squared_errors(const RadianceImage& picture, const RadianceImage& truth);

}  // namespace quartet
