#include "renderer/scene/synthetic.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/base/math/hash_mix.h"
#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr std::string_view prefix = "synthetic:";

constexpr double bernoulli_odds = 0.1;

float constant(double, double) {
  return 0.5f;
}

float bernoulli(double u, double) {
  return u < bernoulli_odds ? 1.0f : 0.0f;
}

/// exp(Z − 1/2) with a standard normal Z, by Box and Muller 1958: mean 1.
float log_normal(double u, double v) {
  const double z = std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  return float(std::exp(z - 0.5));
}

constexpr double pareto_exponent = 2.5;
constexpr double pareto_least = 0.6;

/// P(X > x) = (least / x)^exponent. With this exponent the variance is finite and the third moment
/// is not: estimates of the variance converge slowly, and mostly from below.
float pareto(double u, double) {
  return float(pareto_least * std::pow(u, -1.0 / pareto_exponent));
}

constexpr double pareto_mean = pareto_exponent * pareto_least / (pareto_exponent - 1.0);
constexpr double pareto_variance =
    pareto_least * pareto_mean / ((pareto_exponent - 1.0) * (pareto_exponent - 2.0));

constexpr double bad_share = 0.01;

float not_a_number(double u, double v) {
  return v < bad_share         ? std::numeric_limits<float>::quiet_NaN()
         : v < 2.0 * bad_share ? std::numeric_limits<float>::infinity()
                               : float(u);
}

float negative(double u, double v) {
  return v < bad_share ? float(-u) : float(u);
}

constexpr std::array table{
    Synthetic{"constant", "constant 0.5", 0.5, 0.0, constant},
    Synthetic{"bernoulli", "1 with probability 0.1, else 0", bernoulli_odds,
              bernoulli_odds*(1.0 - bernoulli_odds), bernoulli},
    Synthetic{"log-normal", "log-normal, mean 1, standard deviation 1.31", 1.0,
              std::numbers::e - 1.0, log_normal},
    Synthetic{"pareto", "Pareto with exponent 2.5, mean 1: a heavy tail", pareto_mean,
              pareto_variance, pareto},
    Synthetic{"non-finite", "uniform in 0 to 1; 1 in 100 is NaN, 1 in 100 infinite", 0.5,
              1.0 / 12.0, not_a_number},
    Synthetic{"negative", "uniform in 0 to 1; 1 in 100 is negative", 0.5, 1.0 / 12.0, negative},
};

constexpr double to_unit(std::uint32_t bits) {
  return (double(bits) + 0.5) * 0x1p-32;
}

}  // namespace

std::span<const Synthetic> synthetics() {
  return table;
}

const Synthetic& find_synthetic(std::string_view id) {
  return find_row(synthetics(), id, "synthetic source");
}

void draw_synthetic(const Synthetic& row, std::uint64_t seed, int x, int y, std::uint32_t first,
                    std::span<glm::vec3> radiance) {
  const std::uint64_t pixel = std::uint64_t(std::uint32_t(y)) << 32 | std::uint32_t(x);
  const std::uint64_t key = hash_mix(hash_mix(seed + golden_step) ^ pixel);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const std::uint64_t bits = hash_mix(key + (first + i) * golden_step);
    radiance[i] =
        glm::vec3(row.draw(to_unit(std::uint32_t(bits >> 32)), to_unit(std::uint32_t(bits))));
  }
}

Scene synthetic_scene(const Synthetic& row) {
  Scene scene;
  scene.name = fmt::format("{}{}", prefix, row.id);
  scene.path = scene.name;
  scene.environment = ConstantEnvironment{glm::vec3(float(row.mean))};
  scene.width = 96;
  scene.height = 64;
  return scene;
}

bool is_synthetic_name(std::string_view name) {
  return name.starts_with(prefix);
}

const Synthetic* synthetic_of(const Scene& scene) {
  const std::string& path = scene.path.native();
  return is_synthetic_name(path) ? &find_synthetic(path.substr(prefix.size())) : nullptr;
}

}  // namespace quartet
