#include "renderer/measure/error_history.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace quartet {

void ErrorHistory::measure(std::shared_ptr<const RadianceImage> reference, MetricId metric) {
  reference_ = std::move(reference);
  metric_ = metric;
  errors_.clear();
}

void ErrorHistory::rewind(std::span<const Lane> lanes) {
  errors_.resize(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    errors_[i].resize(std::min<std::size_t>(errors_[i].size(), lanes[i].frame()));
  }
}

void ErrorHistory::update(std::span<const Lane> lanes) {
  if (!reference_) {
    return;
  }
  assert(errors_.size() == lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    if (errors_[i].size() + 1 == lanes[i].frame()) {
      errors_[i].push_back(quartet::metric(metric_).compute(lanes[i].film().image(), *reference_));
    }
  }
}

}  // namespace quartet
