#include "renderer/adaptive/snapshot.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "renderer/adaptive/lab.h"
#include "renderer/parallel.h"

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

void copy_lane(const Lane& lane, LaneSnapshot& snapshot) {
  const Film& film = lane.film();
  snapshot.policy = lane.policy();
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

}  // namespace

void copy_lanes(const Lab& lab, Snapshot& snapshot, bool last_is_baseline) {
  snapshot.width = lab.width();
  snapshot.height = lab.height();
  snapshot.frame = lab.frame();
  assert(std::ranges::all_of(lab.lanes(),
                             [&](const Lane& lane) { return lane.frame() == snapshot.frame; }));
  const std::span<const Lane> lanes = lab.lanes();
  const std::size_t compared = last_is_baseline ? lanes.size() - 1 : lanes.size();
  snapshot.lanes.resize(compared);
  if (!last_is_baseline) {
    snapshot.baseline.reset();
  } else if (!snapshot.baseline) {
    snapshot.baseline.emplace();
  }
  lab.threads().execute([&] {
    parallel_for(lanes.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        copy_lane(lanes[i], i < compared ? snapshot.lanes[i] : *snapshot.baseline);
      }
    });
  });
}

}  // namespace quartet
