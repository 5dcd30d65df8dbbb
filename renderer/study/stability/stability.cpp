#include "renderer/study/stability/stability.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>

#include "renderer/adaptive/lab.h"
#include "renderer/base/parallel.h"
#include "renderer/measure/reference/reference.h"
#include "renderer/scene/load_scene.h"
#include "renderer/study/calibrate.h"
#include "renderer/study/stability/expected_error.h"

namespace quartet {
namespace {

// Shares of a case's time, for the progress bar.
constexpr double truth_share = 0.25;
constexpr double expected_share = 0.05;
constexpr double tuning_share = 0.1;

struct Stopped {};

class Study {
 public:
  Study(const StabilityOptions& options,
        const std::function<void(double, std::string_view)>& progress, std::stop_token stop)
      : options_(options), progress_(progress), stop_(std::move(stop)) {}

  CaseResult run(std::size_t index);

 private:
  void advance(double share_of_case);
  TrialSetup prepare();
  void tune(TrialSetup& setup);
  std::vector<Trial> run_seeds(const TrialSetup& setup);

  const StabilityOptions& options_;
  const std::function<void(double, std::string_view)>& progress_;
  std::stop_token stop_;
  std::mutex mutex_;
  std::size_t index_ = 0;
};

/// Throws Stopped if the study is to end.
void Study::advance(double share_of_case) {
  const std::lock_guard lock(mutex_);
  progress_((double(index_) + share_of_case) / double(options_.cases.size()),
            options_.cases[index_]->id);
  if (stop_.stop_requested()) {
    throw Stopped();
  }
}

TrialSetup Study::prepare() {
  TrialSetup setup;
  setup.failure = options_.cases[index_];
  setup.scene = std::make_shared<const TraceScene>(open_scene(setup.failure->scene));
  setup.settings = default_settings(setup.scene->scene());
  setup.settings.sampler = sampler_for(setup.scene->scene(), options_.sampler);
  setup.judgement.truth =
      *find_truth(setup.scene, setup.settings, options_.truth, [&](double done) {
        advance(truth_share * done);
        return true;
      });
  const auto budget = std::uint32_t(std::lround(options_.spp));
  std::uint32_t runs = 0;
  setup.judgement.expected = expected_errors(
      setup.scene, setup.settings, *setup.judgement.truth.image, budget, options_.oracle_runs, [&] {
        advance(truth_share + expected_share * double(++runs) / double(options_.oracle_runs));
        return true;
      });
  setup.judgement.region =
      pixels_of(setup.failure->region, setup.settings.width, setup.settings.height);
  // Seeds that no trial has, and samples whose s²/n is the variance of their mean.
  RenderSettings hidden = setup.settings;
  hidden.sampler = SamplerId::independent;
  hidden.seed = ~reference_seed;
  setup.audit =
      std::make_shared<const Audit>(sample_source(setup.scene, hidden), hidden.width, hidden.height,
                                    options_.audit_share, options_.audit_samples, hidden.seed);
  advance(truth_share + expected_share);
  setup.subjects = stability_subjects(options_.estimators, options_.policy, options_.spp);
  setup.window_passes = options_.window_passes;
  setup.most_spp = std::uint32_t(std::lround(options_.spp * maximum_over_budget));
  tune(setup);
  return setup;
}

/// Finds the thresholds that meet the budget, with a seed that no trial has.
void Study::tune(TrialSetup& setup) {
  RenderSettings settings = setup.settings;
  settings.seed = ~std::uint64_t(0);
  LabOptions lab;
  lab.threads = 1;
  lab.sampler = settings.sampler;
  Experiment experiment(sample_source(setup.scene, settings), settings.width, settings.height, lab,
                        setup.judgement.expected);
  // Every lane of the study ends by itself.
  const CommonBudget budget{.passes = std::numeric_limits<std::uint32_t>::max(),
                            .spp = options_.spp};
  for (std::size_t i = 0; i < setup.subjects.size(); ++i) {
    LaneSettings& lane = setup.subjects[i].settings;
    if (estimator(lane.estimator).channels > 0 && lane.estimator != EstimatorId::endless) {
      const std::optional<Calibration> found = calibrate(experiment, lane, budget, stop_);
      if (!found) {
        throw Stopped();
      }
      lane = found->settings;
    }
    if (lane.estimator == EstimatorId::oracle_expected) {
      setup.judgement.limit = double(lane.thresholds[0]);
    }
    advance(truth_share + expected_share +
            tuning_share * double(i + 1) / double(setup.subjects.size()));
  }
}

std::vector<Trial> Study::run_seeds(const TrialSetup& setup) {
  std::vector<std::vector<Trial>> of_seed(options_.seeds);
  std::atomic<std::uint32_t> finished = 0;
  parallel_for(options_.seeds, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t seed = begin; seed < end; ++seed) {
      std::optional<std::vector<Trial>> trials = run_trials(setup, std::uint32_t(seed), stop_);
      if (!trials) {
        throw Stopped();
      }
      of_seed[seed] = std::move(*trials);
      const double done = double(++finished) / double(options_.seeds);
      constexpr double before = truth_share + expected_share + tuning_share;
      advance(before + (1.0 - before) * done);
    }
  });
  std::vector<Trial> trials;
  for (std::vector<Trial>& some : of_seed) {
    trials.insert(trials.end(), some.begin(), some.end());
  }
  return trials;
}

CaseResult Study::run(std::size_t index) {
  index_ = index;
  const TrialSetup setup = prepare();
  std::vector<Trial> trials = run_seeds(setup);
  return {setup.failure,         setup.judgement.truth, setup.settings.width,
          setup.settings.height, setup.judgement.limit, setup.settings.sampler,
          setup.subjects,        std::move(trials)};
}

}  // namespace

std::vector<CaseResult> run_stability(const StabilityOptions& options,
                                      const std::function<void(double, std::string_view)>& progress,
                                      std::stop_token stop) {
  Study study(options, progress, std::move(stop));
  std::vector<CaseResult> results;
  try {
    for (std::size_t i = 0; i < options.cases.size(); ++i) {
      results.push_back(study.run(i));
    }
  } catch (const Stopped&) {
    return {};
  }
  return results;
}

}  // namespace quartet
