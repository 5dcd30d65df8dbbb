#include "renderer/measure/quality.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "renderer/adaptive/lane.h"
#include "renderer/base/interval.h"

namespace quartet {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t calibration_bins = 32;

/// Indices in the order of their values.
std::vector<std::uint32_t> order_of(std::span<const float> values) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return values[i]; });
  return order;
}

/// Twice the rank of each value, from 0, so that the mean of tied ranks is whole.
std::vector<double> doubled_ranks(std::span<const float> values) {
  const std::vector<std::uint32_t> order = order_of(values);
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) {
      ++end;
    }
    for (std::size_t i = begin; i < end; ++i) {
      ranks[order[i]] = double(begin + end - 1);
    }
    begin = end;
  }
  return ranks;
}

}  // namespace

std::vector<CalibrationBin> calibration_curve(std::span<const float> estimated,
                                              std::span<const float> true_squared_error,
                                              std::size_t bins) {
  assert(estimated.size() == true_squared_error.size() && bins > 0);
  std::vector<std::uint32_t> order = order_of(estimated);
  std::erase_if(order, [&](std::uint32_t i) { return !std::isfinite(estimated[i]); });
  std::vector<CalibrationBin> curve;
  for (std::size_t begin = 0; begin < order.size();) {
    // Where the bin would end without ties, seen from all that is left to share out.
    const std::size_t left = bins > curve.size() ? bins - curve.size() : 1;
    std::size_t end = begin + std::max<std::size_t>(1, (order.size() - begin) / left);
    while (end < order.size() && estimated[order[end]] == estimated[order[end - 1]]) {
      ++end;
    }
    CalibrationBin bin;
    bin.pixels = end - begin;
    for (std::size_t i = begin; i < end; ++i) {
      bin.estimated += double(estimated[order[i]]);
      bin.true_squared_error += double(true_squared_error[order[i]]);
    }
    bin.estimated /= double(bin.pixels);
    bin.true_squared_error /= double(bin.pixels);
    curve.push_back(bin);
    begin = end;
  }
  return curve;
}

double rank_correlation(std::span<const float> a, std::span<const float> b) {
  assert(a.size() == b.size());
  const std::vector<double> x = doubled_ranks(a);
  const std::vector<double> y = doubled_ranks(b);
  const double mean = double(x.size()) - 1.0;  // of doubled ranks, whatever ties
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
    xy += (x[i] - mean) * (y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : nan;
}

double FalseStops::share() const {
  return done > 0 && not_done > 0 ? double(wrong) / double(done) : nan;
}

FalseStops false_stops(std::span<const PixelState> states,
                       std::span<const float> true_squared_error) {
  assert(states.size() == true_squared_error.size());
  std::vector<double> others;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != PixelState::done) {
      others.push_back(double(true_squared_error[i]));
    }
  }
  FalseStops stops;
  stops.not_done = others.size();
  stops.done = states.size() - others.size();
  if (others.empty()) {
    return stops;
  }
  const double typical = median(std::move(others));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool worse = double(true_squared_error[i]) > typical;
    stops.wrong += states[i] == PixelState::done && worse ? 1 : 0;
  }
  return stops;
}

double share_distance(std::span<const std::uint32_t> samples, std::span<const float> weights) {
  assert(samples.size() == weights.size());
  const double total = std::accumulate(samples.begin(), samples.end(), 0.0);
  const double weight = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(total > 0.0 && weight > 0.0)) {
    return nan;
  }
  double distance = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    distance += std::abs(double(samples[i]) / total - double(weights[i]) / weight);
  }
  return 0.5 * distance;
}

std::vector<float> oracle_weights(const Film& film) {
  std::vector<float> weights(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const glm::dvec3 variance = double(film.counts()[i]) * film.variance_of_mean(i);
    weights[i] = float(std::sqrt(variance.x + variance.y + variance.z));
  }
  return weights;
}

EstimatorQuality quality_of(const PixelCriterion& criterion,
                            std::span<const float> true_squared_error) {
  EstimatorQuality quality;
  const std::vector<float> scaled = largest_scaled_errors(criterion);
  if (!scaled.empty()) {
    quality.rank_correlation = rank_correlation(scaled, true_squared_error);
    quality.stops = false_stops(pixel_states(criterion), true_squared_error);
    quality.calibration = calibration_curve(scaled, true_squared_error, calibration_bins);
  }
  return quality;
}

}  // namespace quartet
