#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/adaptive/pixel_state.h"
#include "renderer/base/interval.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet {

/// A hidden look at pixels: a random subset of them keeps receiving samples that no estimator sees,
/// so that what a criterion says of them can be checked without a reference.
class Audit {
 public:
  struct Pixel {
    std::size_t pixel;
    glm::dvec3 mean;              ///< of the hidden samples
    glm::dvec3 variance_of_mean;  ///< of it
  };

  /// Takes `samples` samples, at least 2, of each pixel with probability `share`; `hidden` must
  /// know nothing of the samples that the audited lanes see. Runs on the threads of the current TBB
  /// arena.
  Audit(const SampleSource& hidden, int width, int height, double share, std::uint32_t samples,
        std::uint64_t seed);

  std::span<const Pixel> pixels() const { return pixels_; }

  /// Pixels that were audited and are done, and how many of them are wrong.
  struct Finding {
    double done = 0.0;
    double wrong = 0.0;
  };
  /// A pixel is wrong if its squared relative error, as squared_errors() has it and less what the
  /// audit's own noise adds to it, is above `target`. `means` are red, green and blue.
  Finding check(std::span<const PixelState> states,
                const std::array<std::span<const float>, 3>& means, double target) const;

 private:
  std::vector<Pixel> pixels_;
};

}  // namespace quartet
