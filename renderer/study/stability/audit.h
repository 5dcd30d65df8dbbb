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

  /// A pixel that is done, and whether it is wrong nevertheless.
  struct Look {
    std::size_t pixel;
    bool wrong;
  };
  /// Of all pixels that are audited and done. One is wrong if its squared relative error, as
  /// squared_errors() has it and less what the audit's own noise adds to it, is above `target`.
  /// `means` are red, green and blue.
  std::vector<Look> check(std::span<const PixelState> states,
                          const std::array<std::span<const float>, 3>& means, double target) const;

 private:
  std::vector<Pixel> pixels_;
};

/// The share of wrong ones in looks at the same pixels by several runs, as an interval at
/// confidence 1 − p. Pixels are what was drawn at random, each with all its runs (Cochran 1977,
/// Sampling Techniques, section 9A.3 on clusters of unequal size): so many independent looks as
/// would give the share that variance go into Wilson's interval. Of no looks: 0 to 1.
Interval wrong_share_interval(std::span<const Audit::Look> looks, double p);

}  // namespace quartet
