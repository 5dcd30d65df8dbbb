#include "renderer/study/stability/outcome.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/adaptive/effort.h"
#include "renderer/measure/metrics.h"
#include "renderer/study/stability/uniform_run.h"

namespace quartet {
namespace {

constexpr std::array columns{
    OutcomeColumn{"mean_spp", "samples", &Outcome::mean_spp},
    OutcomeColumn{"seconds", "s", &Outcome::seconds},
    OutcomeColumn{"relmse", "", &Outcome::relmse},
    OutcomeColumn{"worst", "", &Outcome::worst},
    OutcomeColumn{"fireflies", "", &Outcome::fireflies},
    OutcomeColumn{"energy", "", &Outcome::energy},
    OutcomeColumn{"region_energy", "", &Outcome::region_energy},
    OutcomeColumn{"done", "", &Outcome::done},
    OutcomeColumn{"missed", "", &Outcome::missed},
    OutcomeColumn{"never_done", "", &Outcome::never_done},
    OutcomeColumn{"never_done_cost", "", &Outcome::never_done_cost},
    OutcomeColumn{"wasted", "", &Outcome::wasted},
    OutcomeColumn{"off_oracle", "", &Outcome::off_oracle},
    OutcomeColumn{"region_spp", "samples", &Outcome::region_spp},
    OutcomeColumn{"rejected", "", &Outcome::rejected},
    OutcomeColumn{"mean_rays", "rays", &Outcome::mean_rays},
    OutcomeColumn{"relmse_regions", "", &Outcome::regions},
    OutcomeColumn{"over_uniform", "", &Outcome::over_uniform},
    OutcomeColumn{"over_uniform_rays", "", &Outcome::over_uniform_rays},
    OutcomeColumn{"too_early", "", &Outcome::too_early},
    OutcomeColumn{"off", "", &Outcome::off},
};

template <class Visit>
void for_each_pixel(const PixelRegion& region, int width, const Visit& visit) {
  for (int y = region.top; y < region.bottom; ++y) {
    for (int x = region.left; x < region.right; ++x) {
      visit(std::size_t(y) * std::size_t(width) + std::size_t(x));
    }
  }
}

double share(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

/// Of a pixel with so many samples.
double expected_error(const Judgement& judgement, std::size_t pixel, std::uint32_t samples) {
  return double(judgement.expected->pixels()[pixel].x) / double(samples);
}

double mean_of_worst(std::vector<float> errors) {
  const std::size_t count = std::max<std::size_t>(1, errors.size() / 1000);
  std::ranges::nth_element(errors, errors.begin() + std::ptrdiff_t(count), std::greater());
  return std::accumulate(errors.begin(), errors.begin() + std::ptrdiff_t(count), 0.0) /
         double(count);
}

double firefly_share(const RadianceImage& picture, const RadianceImage& truth) {
  double count = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const float right = luminance(truth.pixels()[i]);
    const float shown = luminance(picture.pixels()[i]);
    count += shown - right > 5.0f * (right + 0.1f) ? 1.0 : 0.0;
  }
  return count / double(picture.size());
}

/// Half the sum of the differences of two distributions of samples over pixels.
double distance(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  if (a.size() != b.size()) {
    return 0.0;
  }
  const double all_a = std::accumulate(a.begin(), a.end(), 0.0);
  const double all_b = std::accumulate(b.begin(), b.end(), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += std::abs(double(a[i]) / all_a - double(b[i]) / all_b);
  }
  return 0.5 * sum;
}

}  // namespace

std::span<const OutcomeColumn> outcome_columns() {
  return columns;
}

double energy_of(const RadianceImage& picture, const RadianceImage& truth,
                 const PixelRegion& region) {
  double shown = 0.0;
  double right = 0.0;
  for_each_pixel(region, picture.width(), [&](std::size_t i) {
    shown += double(luminance(picture.pixels()[i]));
    right += double(luminance(truth.pixels()[i]));
  });
  return right > 0.0 ? shown / right - 1.0 : (shown - right) / region.pixels();
}

Outcome outcome_of(const RadianceImage& picture, const RadianceImage& truth,
                   const PixelRegion& region) {
  std::vector<float> errors = squared_errors(picture, truth);
  Outcome outcome;
  outcome.relmse = std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
  outcome.regions = metric(MetricId::relmse_regions).compute(picture, truth);
  outcome.worst = mean_of_worst(std::move(errors));
  outcome.fireflies = firefly_share(picture, truth);
  outcome.energy = energy_of(picture, truth, {0, 0, picture.width(), picture.height()});
  outcome.region_energy = energy_of(picture, truth, region);
  return outcome;
}

void set_cost(Outcome& outcome, const Lane& lane) {
  const PassRecord& last = lane.history().back();
  outcome.mean_spp = mean_spp(last, lane.film().size());
  outcome.mean_rays = mean_rays(last, lane.film().size());
  outcome.seconds = last.seconds;
}

void set_beside(Outcome& outcome, const UniformRun& uniform, const Truth& truth) {
  const auto over = [&](const UniformRun::Point& point) {
    return outcome.regions == point.regions ? 1.0 : outcome.regions / point.regions;
  };
  const UniformRun::Point same_samples = uniform.at(&UniformRun::Point::mean_spp, outcome.mean_spp);
  outcome.over_uniform = over(same_samples);
  outcome.over_uniform_rays = over(uniform.at(&UniformRun::Point::mean_rays, outcome.mean_rays));
  outcome.off = outcome.region_energy - (truth.spp > 0 ? uniform.last().region_energy : 0.0);
}

void Observation::before_pass(const Lane& lane) {
  if (lane.pass() == 0 || lane.plan().total == 0) {
    return;
  }
  for (std::size_t i = 0; i < lane.taken().size(); ++i) {
    const double wanted = lane.plan().wanted[i];
    const double expected = expected_error(judgement_, i, lane.taken()[i]);
    spent_ += wanted;
    wasted_ += expected <= judgement_.limit ? wanted : 0.0;
  }
}

Outcome Observation::outcome(const Lane& lane, std::span<const std::uint32_t> oracle,
                             const Audit& audit) {
  const Film& film = lane.film();
  const RadianceImage picture = film.image();
  const double all_samples = double(lane.history().back().samples);
  const PixelRegion& region = judgement_.region;
  const double wrong = wrong_over_limit * judgement_.limit;
  Outcome outcome = outcome_of(picture, *judgement_.truth.image, region);
  set_cost(outcome, lane);
  outcome.rejected = share(double(film.total_rejected()), all_samples);
  outcome.wasted = share(wasted_, spent_);
  outcome.off_oracle = distance(lane.taken(), oracle);

  const std::vector<float> errors = squared_errors(picture, *judgement_.truth.image);
  const std::vector<PixelState> states = pixel_states(lane);
  double done = 0.0;
  double missed = 0.0;
  double too_early = 0.0;
  double never = 0.0;
  double never_samples = 0.0;
  double samples = 0.0;
  std::vector<PixelState> in_region(states.size(), PixelState::refining);
  for_each_pixel(region, film.width(), [&](std::size_t i) {
    const double expected = expected_error(judgement_, i, lane.taken()[i]);
    samples += lane.taken()[i];
    in_region[i] = states[i];
    if (states[i] == PixelState::done) {
      done += 1.0;
      missed += double(errors[i]) > wrong ? 1.0 : 0.0;
      too_early += expected > wrong ? 1.0 : 0.0;
    } else if (states[i] == PixelState::at_maximum && expected <= judgement_.limit) {
      never += 1.0;
      never_samples += lane.taken()[i];
    }
  });
  outcome.done = done / region.pixels();
  outcome.missed = share(missed, done);
  outcome.too_early = share(too_early, done);
  outcome.never_done = never / region.pixels();
  outcome.never_done_cost = share(never_samples, all_samples);
  outcome.region_spp = samples / region.pixels();
  outcome.audit = audit.check(in_region, {film.mean(0), film.mean(1), film.mean(2)}, wrong);
  return outcome;
}

}  // namespace quartet
