#include "renderer/measure/budget.h"

#include <algorithm>
#include <cmath>

namespace quartet {
namespace {

// Steps of the bisection; thresholds are sought from 2^-20 to 2^20 of where they were, and found to
// 1 part in 1000.
constexpr int steps = 16;
constexpr double widest = 20.0;

/// Factors in powers of two between which the right one lies.
struct Bracket {
  double low = -widest;
  double high = widest;
  double middle() const { return 0.5 * (low + high); }
};

SamplingPolicy scaled(SamplingPolicy policy, double exponent) {
  for (float& threshold : policy.thresholds) {
    threshold = float(double(threshold) * std::exp2(exponent));
  }
  return policy;
}

void run_to_the_end(Lab& lab) {
  while (std::ranges::any_of(lab.lanes(), [](const Lane& lane) { return lane.plan().total > 0; })) {
    lab.run_frame();
  }
}

}  // namespace

std::vector<SamplingPolicy> meet_budget(const SampleSource& source, int width, int height,
                                        std::vector<SamplingPolicy> policies, double spp,
                                        const LabOptions& options,
                                        const std::function<void(double)>& progress) {
  std::vector<Bracket> brackets(policies.size());
  const auto middles = [&] {
    std::vector<SamplingPolicy> tried;
    for (std::size_t i = 0; i < policies.size(); ++i) {
      tried.push_back(scaled(policies[i], brackets[i].middle()));
    }
    return tried;
  };
  Lab lab(source, width, height, middles(), options);
  for (int step = 0; step < steps; ++step) {
    lab.set_lanes(middles(), options.statistics, options.reference);
    run_to_the_end(lab);
    for (std::size_t i = 0; i < policies.size(); ++i) {
      const double taken =
          double(lab.lanes()[i].history().back().samples) / (double(width) * double(height));
      (taken > spp ? brackets[i].low : brackets[i].high) = brackets[i].middle();
    }
    progress(double(step + 1) / steps);
  }
  // The upper end is the one that was seen to stay within the budget.
  for (std::size_t i = 0; i < policies.size(); ++i) {
    policies[i] = scaled(policies[i], brackets[i].high);
  }
  return policies;
}

}  // namespace quartet
