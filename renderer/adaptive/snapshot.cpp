#include "renderer/adaptive/snapshot.h"

#include <algorithm>
#include <cassert>

#include "renderer/adaptive/lab.h"

namespace quartet {
namespace {

template <class T>
void copy(std::span<const T> from, std::vector<T>& to) {
  to.assign(from.begin(), from.end());
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
    variance[i] = float(of_mean.x);
    variance[pixels + i] = float(of_mean.y);
    variance[2 * pixels + i] = float(of_mean.z);
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
  snapshot.true_errors.clear();
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
  std::span<const Lane> lanes = lab.lanes();
  if (last_is_baseline) {
    if (!snapshot.baseline) {
      snapshot.baseline.emplace();
    }
    copy_lane(lanes.back(), *snapshot.baseline);
    lanes = lanes.first(lanes.size() - 1);
  } else {
    snapshot.baseline.reset();
  }
  snapshot.lanes.resize(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    copy_lane(lanes[i], snapshot.lanes[i]);
  }
}

}  // namespace quartet
