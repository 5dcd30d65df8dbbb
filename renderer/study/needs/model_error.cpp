#include "renderer/study/needs/model_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "renderer/base/parallel.h"
#include "renderer/measure/energy.h"

namespace quartet {
namespace {

/// Sums of pictures, from which those of all but one follow.
class PictureSum {
 public:
  explicit PictureSum(const std::vector<RadianceImage>& pictures)
      : pictures_(pictures), sums_(pictures.front().size(), glm::dvec3(0.0)) {
    for (const RadianceImage& picture : pictures) {
      for (std::size_t i = 0; i < sums_.size(); ++i) {
        sums_[i] += glm::dvec3(picture.pixels()[i]);
      }
    }
  }

  /// Of `count` pictures; `left_out` is none for all of them.
  RadianceImage mean(std::ptrdiff_t left_out) const {
    const RadianceImage& any = pictures_.front();
    RadianceImage mean(any.width(), any.height());
    const double weight = 1.0 / double(pictures_.size() - (left_out == none ? 0 : 1));
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const glm::dvec3 less = left_out == none
                                  ? glm::dvec3(0.0)
                                  : glm::dvec3(pictures_[std::size_t(left_out)].pixels()[i]);
      mean.pixels()[i] = glm::max(glm::vec3(weight * (sums_[i] - less)), glm::vec3(0.0f));
    }
    return mean;
  }

  static constexpr std::ptrdiff_t none = -1;

 private:
  const std::vector<RadianceImage>& pictures_;
  std::vector<glm::dvec3> sums_;
};

/// What pictures of n samples have of an error that one of them has alone.
double share_of_mean(const Metric& metric, double n) {
  return metric.scale == MetricScale::squared_error ? 1.0 / n : 1.0 / std::sqrt(n);
}

/// Errors add up as the squares that they are or are the roots of.
double to_square(const Metric& metric, double error) {
  return metric.scale == MetricScale::squared_error ? error : error * error;
}
double from_square(const Metric& metric, double square) {
  return metric.scale == MetricScale::squared_error ? square : std::sqrt(std::max(0.0, square));
}

struct Separated {
  double error = 0.0;
  double noise = 0.0;
};

/// The error of a mean difference without its noise, of all seeds but one, or of all.
Separated separate(const Metric& metric, const ModelPictures& whole, const ModelPictures& model,
                   const PictureSum& whole_sum, const PictureSum& model_sum,
                   std::ptrdiff_t left_out) {
  const RadianceImage truth = whole_sum.mean(left_out);
  const RadianceImage shown = model_sum.mean(left_out);
  const std::size_t all = whole.seeds.size();
  const double seeds = double(all) - (left_out == PictureSum::none ? 0.0 : 1.0);
  // The variance of a mean is the sum of squares over n (n − 1): that of pictures which are off by
  // one seed's deviation over the root of n − 1 has it for its mean.
  const float scale = float(1.0 / std::sqrt(seeds - 1.0));
  double squares = 0.0;
  RadianceImage noisy(truth.width(), truth.height());
  for (std::size_t k = 0; k < all; ++k) {
    if (std::ptrdiff_t(k) == left_out) {
      continue;
    }
    parallel_for(truth.size(), 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const glm::vec3 mean = truth.pixels()[i];
        const glm::vec3 off =
            (model.seeds[k].pixels()[i] - whole.seeds[k].pixels()[i]) - (shown.pixels()[i] - mean);
        noisy.pixels()[i] = glm::max(mean + scale * off, glm::vec3(0.0f));
      }
    });
    squares += to_square(metric, metric.compute(noisy, truth));
  }
  const double noise = squares / seeds;
  return {from_square(metric, to_square(metric, metric.compute(shown, truth)) - noise),
          from_square(metric, noise)};
}

/// Errors of each seed's picture against the mean of the others, in units of one picture's noise.
std::vector<double> own_errors(const Metric& metric, const std::vector<RadianceImage>& pictures) {
  const PictureSum sum(pictures);
  const double n = double(pictures.size());
  std::vector<double> errors;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    errors.push_back(metric.compute(pictures[k], sum.mean(std::ptrdiff_t(k))) *
                     share_of_mean(metric, n / (n - 1.0)));
  }
  return errors;
}

Interval variance_ratio(const ModelPictures& whole, const ModelPictures& model, double p) {
  const Metric& mse = metric(MetricId::mse);
  const std::vector<double> before = own_errors(mse, whole.seeds);
  const std::vector<double> after = own_errors(mse, model.seeds);
  // Of pictures without any noise, which happen, there is no logarithm.
  constexpr double least = 1e-9;
  std::vector<double> logarithms;
  for (std::size_t k = 0; k < before.size(); ++k) {
    logarithms.push_back(std::log(std::max(after[k], least * before[k]) / before[k]));
  }
  const Interval interval = mean_interval(logarithms, p);
  return {std::exp(interval.mean), std::exp(interval.low), std::exp(interval.high)};
}

}  // namespace

Interval noise_of_mean(const Metric& metric, const ModelPictures& model, double p) {
  const Interval one = mean_interval(own_errors(metric, model.seeds), p);
  const double share = share_of_mean(metric, double(model.seeds.size()));
  return {share * one.mean, share * one.low, share * one.high};
}

ModelError error_of_model(const Metric& metric, const ModelPictures& whole,
                          const ModelPictures& model, double p) {
  assert(whole.seeds.size() >= least_seeds && whole.seeds.size() == model.seeds.size());
  const PictureSum whole_sum(whole.seeds);
  const PictureSum model_sum(model.seeds);
  const double n = double(whole.seeds.size());
  const Separated all = separate(metric, whole, model, whole_sum, model_sum, PictureSum::none);
  std::vector<double> pseudovalues;
  std::vector<double> energies;
  for (std::size_t k = 0; k < whole.seeds.size(); ++k) {
    const double without =
        separate(metric, whole, model, whole_sum, model_sum, std::ptrdiff_t(k)).error;
    pseudovalues.push_back(n * all.error - (n - 1.0) * without);
    energies.push_back(energy_error(model.seeds[k], whole.seeds[k]));
  }
  const Interval spread = mean_interval(pseudovalues, p);
  ModelError result;
  result.error = {all.error, all.error - (spread.mean - spread.low),
                  all.error + (spread.high - spread.mean)};
  result.noise = all.noise;
  result.energy = mean_interval(energies, p);
  result.variance = variance_ratio(whole, model, p);
  return result;
}

}  // namespace quartet
