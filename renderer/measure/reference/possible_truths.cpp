#include "renderer/measure/reference/possible_truths.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/base/parallel.h"
#include "renderer/measure/metrics/terms.h"

namespace quartet {
namespace {

/// By how much more the picture is believed than moments alone would have it, see the header.
constexpr double belief = 1.2;

/// Weighted sums over neighbours.
struct NeighbourSums {
  glm::dvec3 value{0.0};
  glm::dvec3 square{0.0};
  glm::dvec3 noise{0.0};  ///< squares of it
  double weight = 0.0;
  double weight_square = 0.0;

  void add(const NeighbourSums& other, double by) {
    value += by * other.value;
    square += by * other.square;
    noise += by * other.noise;
    weight += by * other.weight;
    weight_square += by * by * other.weight_square;
  }
};

/// How far a possible truth is from the picture: what is sure, and what has either sign.
struct Departure {
  glm::vec3 guess{0.0f};
  glm::vec3 spread{0.0f};
};

Departure departure_of(glm::dvec3 value, glm::dvec3 noise, const NeighbourSums& around) {
  // As much less than 1 as a pixel's own weight; 0 where it has no neighbours.
  const double others = 1.0 - around.weight_square / (around.weight * around.weight);
  if (others < 1e-6) {
    return {glm::vec3(0.0f), glm::vec3(noise)};
  }
  Departure departure;
  for (int c = 0; c < 3; ++c) {
    const double mean = around.value[c] / around.weight;
    const double varies = (around.square[c] / around.weight - mean * mean) / others;
    const double noisy = around.noise[c] / around.weight;
    const double kept = varies > noisy ? 1.0 - noisy / varies : 0.0;
    departure.guess[c] = float(std::pow(1.0 - kept, belief) * (mean - value[c]));
    departure.spread[c] =
        float(std::sqrt(1.0 - std::pow(1.0 - kept, 2.0 * belief - 1.0)) * noise[c]);
  }
  return departure;
}

class PossibleTruths {
 public:
  PossibleTruths(const RadianceImage& image, const std::array<RadianceImage, 2>& halves,
                 double sigma)
      : image_(image), halves_(halves), departures_(image.size()) {
    const int reach = int(std::ceil(3.0 * sigma));
    for (int i = -reach; i <= reach; ++i) {
      weights_.push_back(std::exp(-0.5 * double(i * i) / (sigma * sigma)));
    }
  }

  std::array<RadianceImage, 2> pictures() {
    parallel_for(std::size_t(image_.height()), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        depart(int(y));
      }
    });
    const float scale = scale_to_noise();
    std::array<RadianceImage, 2> truths{image_, image_};
    for (std::size_t i = 0; i < image_.size(); ++i) {
      const Departure& departure = departures_[i];
      if (is_known(i)) {
        const glm::vec3 value = image_.pixels()[i];
        const glm::vec3 guess = scale * departure.guess;
        const glm::vec3 spread = scale * departure.spread;
        truths[0].pixels()[i] = glm::max(value + guess + spread, glm::vec3(0.0f));
        truths[1].pixels()[i] = glm::max(value + guess - spread, glm::vec3(0.0f));
      }
    }
    return truths;
  }

 private:
  glm::dvec3 noise_at(std::size_t i) const {
    return 0.5 * (glm::dvec3(halves_[0].pixels()[i]) - glm::dvec3(halves_[1].pixels()[i]));
  }

  bool is_known(std::size_t i) const {
    const glm::vec3 value = image_.pixels()[i];
    const glm::vec3 noise(noise_at(i));
    return all_finite({&value.x, 3}) && all_finite({&noise.x, 3});
  }

  NeighbourSums own_sums(std::size_t i) const {
    if (!is_known(i)) {
      return {};
    }
    const glm::dvec3 value = image_.pixels()[i];
    const glm::dvec3 noise = noise_at(i);
    return {value, value * value, noise * noise, 1.0, 1.0};
  }

  int reach() const { return int(weights_.size()) / 2; }

  double weight(int distance) const {
    const int i = distance + reach();
    return weights_[std::size_t(i)];
  }

  /// Row by row of weights first and then along them, as a Gaussian is a product.
  void depart(int y) {
    const int width = image_.width();
    std::vector<NeighbourSums> columns(static_cast<std::size_t>(width));
    for (int v = std::max(0, y - reach()); v <= std::min(image_.height() - 1, y + reach()); ++v) {
      for (int x = 0; x < width; ++x) {
        columns[std::size_t(x)].add(own_sums(std::size_t(v) * std::size_t(width) + std::size_t(x)),
                                    weight(v - y));
      }
    }
    for (int x = 0; x < width; ++x) {
      NeighbourSums around;
      for (int u = std::max(0, x - reach()); u <= std::min(width - 1, x + reach()); ++u) {
        around.add(columns[std::size_t(u)], weight(u - x));
      }
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      if (is_known(i)) {
        departures_[i] = departure_of(image_.pixels()[i], noise_at(i), around);
      }
    }
  }

  float scale_to_noise() const {
    double noise = 0.0;
    double departed = 0.0;
    for (std::size_t i = 0; i < image_.size(); ++i) {
      if (is_known(i)) {
        const glm::dvec3 guess = departures_[i].guess;
        const glm::dvec3 spread = departures_[i].spread;
        const glm::dvec3 own = noise_at(i);
        noise += glm::dot(own, own);
        departed += glm::dot(guess, guess) + glm::dot(spread, spread);
      }
    }
    // More than this no number of neighbours explains.
    constexpr double most = 2.0;
    return departed > 0.0 ? float(std::min(most, std::sqrt(noise / departed))) : 1.0f;
  }

  const RadianceImage& image_;
  const std::array<RadianceImage, 2>& halves_;
  std::vector<double> weights_;
  std::vector<Departure> departures_;
};

}  // namespace

std::array<RadianceImage, 2> possible_truths(const RadianceImage& image,
                                             const std::array<RadianceImage, 2>& halves,
                                             double sigma) {
  return PossibleTruths(image, halves, sigma).pictures();
}

}  // namespace quartet
