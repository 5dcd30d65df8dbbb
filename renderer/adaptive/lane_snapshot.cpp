#include "renderer/adaptive/lane_snapshot.h"

#include <algorithm>
#include <limits>

namespace quartet {
namespace {

template <class T>
void copy(std::span<const T> from, std::vector<T>& to) {
  to.assign(from.begin(), from.end());
}

/// The square of a large radiance can be more than a float holds: then the largest, as infinity
/// would say that something went wrong.
float as_float(double number) {
  return float(std::min(number, double(std::numeric_limits<float>::max())));
}

void copy_variance(const Film& film, std::vector<float>& variance) {
  if (!film.statistics().variance) {
    variance.clear();
    return;
  }
  const std::size_t pixels = film.size();
  variance.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const glm::dvec3 of_mean = film.variance_of_mean(i);
    variance[i] = as_float(of_mean.x);
    variance[pixels + i] = as_float(of_mean.y);
    variance[2 * pixels + i] = as_float(of_mean.z);
  }
}

}  // namespace

void copy_lane(const Lane& lane, LaneSnapshot& snapshot) {
  const Film& film = lane.film();
  snapshot.settings = lane.settings();
  for (int c = 0; c < 3; ++c) {
    copy(film.mean(c), snapshot.mean[std::size_t(c)]);
  }
  copy(lane.taken(), snapshot.taken);
  if (film.total_rejected() > 0) {
    copy(film.rejected(), snapshot.rejected);
  } else {
    snapshot.rejected.clear();
  }
  copy(lane.error(), snapshot.error);
  copy_variance(film, snapshot.variance);
  copy(lane.history(), snapshot.history);
  snapshot.plan = lane.plan();
  fill_histogram(lane.taken(), snapshot.sample_histogram);
  snapshot.error_histograms.resize(lane.error().size() / film.size());
  for (std::size_t c = 0; c < snapshot.error_histograms.size(); ++c) {
    fill_histogram(lane.error().subspan(c * film.size(), film.size()),
                   snapshot.error_histograms[c]);
  }
}

}  // namespace quartet
