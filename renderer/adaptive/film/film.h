#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "renderer/adaptive/estimators/divergence.h"
#include "renderer/adaptive/estimators/window_kernel.h"
#include "renderer/adaptive/film/replicates.h"
#include "renderer/base/image.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {

/// A part of a pixel's samples, about half of them, whose mean is kept beside that of all.
enum class SampleHalf {
  none,
  /// Samples 0, 2, 4, …: Dammertz et al. 2010. The sampler shuffles indices, so that these are no
  /// fixed half of the pixel's area.
  alternate,
  /// Samples with an odd number of ones among the bits 1, 3, 5, … of their index, as Cycles has it
  /// after Christensen, Kensler and Kilpatrick, "Progressive Multi-Jittered Sample Sequences",
  /// EGSR 2018, section 10.2: half of every whole four, and itself well stratified.
  class_a,
};

bool is_in_half(SampleHalf half, std::uint32_t index);

/// What a film keeps beside the mean. Each costs memory and time only where it is asked for.
struct FilmStatistics {
  bool variance = false;  ///< sample variance per channel
  /// How far the luminances of a pixel's samples spread, by each divergence: spread.h. That of
  /// chi2 is the sum of squared deviations, from which the variance of the luminance follows.
  bool chi2 = false;
  bool kl = false;
  bool hellinger = false;
  SampleHalf half = SampleHalf::none;
  /// Samples are those of SamplerId::replicated: where the variance of the mean is wanted, by
  /// `variance` or `chi2`, it is taken from the means of the sequences, which are kept for it.
  bool replicated = false;

  /// Each channel of a sample is cut at this before it enters mean and variance, except in pixels
  /// that see a light, whose first two samples are both above it. Infinite: none is.
  float clamp = std::numeric_limits<float>::infinity();

  /// Whether means of samples alone are not enough.
  bool any() const {
    return variance || chi2 || kl || hellinger || half != SampleHalf::none || clamps();
  }
  bool clamps() const { return clamp < std::numeric_limits<float>::infinity(); }
  bool operator==(const FilmStatistics&) const = default;
};

/// What either asks for. Where both want a half, it must be the same.
FilmStatistics operator|(const FilmStatistics& a, const FilmStatistics& b);

/// The variance of a pixel's mean luminance, in the shape in which tests know it: it is
/// squares / (freedom · n) of n samples. Of independent samples, `squares` are their squared
/// deviations from the mean, and `freedom` is n − 1.
struct LuminanceDeviations {
  double squares = 0.0;
  std::uint32_t freedom = 0;  ///< 0 if the variance is not known
};

/// What the first samples of a pixel say of a light behind it, for FilmStatistics::clamp.
enum class SeenAbove : std::uint8_t { nothing, first, light };

/// The statistics of the samples that each pixel has taken. What the estimators read is planar,
/// because they run over it in vectors.
///
/// A film gets its means in one of two ways, with the same result to the bit: it adds up samples,
/// or it is given means that somebody else has added up. Only the first takes memory for sums, and
/// only the first gives statistics.
/// Calls for different pixels may come from different threads, but for the first add().
class Film {
 public:
  Film(int width, int height, FilmStatistics statistics = {});

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return counts_.size(); }
  FilmStatistics statistics() const { return statistics_; }

  /// Adds samples (linear radiance) to a pixel, in this order: those with the indices from the
  /// number of samples before them on. A sample with a component that is negative or not finite
  /// does not enter any statistic; it is counted as rejected.
  void add(std::size_t pixel, std::span<const glm::vec3> samples);

  /// Replaces the mean of a pixel by that of `count` samples.
  void put(std::size_t pixel, std::uint32_t count, const glm::vec3& mean) {
    counts_[pixel] = count;
    means_[0][pixel] = mean.x;
    means_[1][pixel] = mean.y;
    means_[2][pixel] = mean.z;
  }
  /// Fetches what put() writes for a pixel and its neighbours to the right into the cache.
  void prefetch(std::size_t pixel) const {
    __builtin_prefetch(counts_.data() + pixel, 1);
    for (const std::vector<float>& plane : means_) {
      __builtin_prefetch(plane.data() + pixel, 1);
    }
  }
  /// The same for pixels that follow one another, from `first` on; `means` has one number a pixel.
  void put_row(std::size_t first, std::span<const std::uint32_t> counts, const MeanRow& means);
  /// Counts the samples that were left out of a mean given by put(); returns how many of these.
  std::uint32_t reject(std::size_t pixel, std::span<const glm::vec3> samples);

  /// Whether samples can be added to what is there.
  bool has_sums() const { return !sums_.empty(); }
  /// Makes room for sums; those of pixels that were given means must then be restored.
  void keep_sums();
  /// Takes the sum of a pixel from all samples that are in its mean.
  void restore_sum(std::size_t pixel, std::span<const glm::vec3> samples);

  /// Forgets all samples, and keeps these statistics of the next ones.
  void restart(FilmStatistics statistics);

  /// Mean radiance of one channel (0 red, 1 green, 2 blue) of every pixel; 0 before the first
  /// sample.
  std::span<const float> mean(int channel) const { return means_[std::size_t(channel)]; }
  /// Samples in the mean of every pixel.
  std::span<const std::uint32_t> counts() const { return counts_; }
  std::span<const std::uint32_t> rejected() const { return rejected_; }
  std::uint64_t total_rejected() const;

  /// The variance of a pixel's mean, a channel, as far as its samples tell (SamplerRow::variance):
  /// from replicates where the film keeps them, else s²/n, which is right of independent samples
  /// and too high of those of one scrambled sequence. 0 where it is not known, as below two
  /// samples. Needs FilmStatistics::variance.
  glm::dvec3 variance_of_mean(std::size_t pixel) const;
  /// The same of the mean luminance, for what judges by it. Needs FilmStatistics::chi2.
  LuminanceDeviations luminance_deviations(std::size_t pixel) const;

  /// Mean of the Rec. 709 luminances of a pixel's samples, exactly theirs where all are equal.
  /// Needs one of chi2, kl and hellinger.
  double mean_luminance(std::size_t pixel) const { return luminances_[pixel]; }
  /// B of spread.h over the samples of a pixel; needs that statistic.
  double spread(Divergence divergence, std::size_t pixel) const {
    return spreads_[std::size_t(divergence)][pixel];
  }
  /// The samples of a pixel that are in FilmStatistics::half, which must be asked for.
  const RunningMean& half(std::size_t pixel) const { return halves_[pixel]; }

  RadianceImage image() const;

  std::size_t bytes() const;  ///< memory in use

 private:
  void add_luminance(std::size_t pixel, double count, double luminance);
  glm::vec3 clamped(std::size_t pixel, const glm::vec3& sample, RunningMean& running);
  void allocate_statistics();

  int width_;
  int height_;
  FilmStatistics statistics_;
  std::array<std::vector<float>, 3> means_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> rejected_;
  std::vector<glm::dvec3> sums_;
  /// Sums of squared deviations from the mean.
  std::vector<glm::dvec3> deviations_;
  std::vector<double> luminances_;              // their means
  std::array<std::vector<double>, 3> spreads_;  // by Divergence
  std::vector<RunningMean> halves_;
  std::vector<Replicates> replicates_;
  std::vector<SeenAbove> seen_above_;  // of the clamp, where there is one
};

}  // namespace quartet
