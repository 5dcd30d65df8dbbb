#include "renderer/measure/stability.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>

#include "renderer/adaptive/lab.h"
#include "renderer/measure/budget.h"
#include "renderer/measure/reference.h"
#include "renderer/parallel.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

constexpr std::array variation_table{
    VariationRow{Variation::none, "none", "the plain experiment"},
    VariationRow{Variation::threshold_up, "threshold_up", "thresholds × 1.1"},
    VariationRow{Variation::threshold_down, "threshold_down", "thresholds ÷ 1.1"},
    VariationRow{Variation::exposure, "exposure", "all radiance × 2"},
    VariationRow{Variation::resolution, "resolution", "twice the pixels in each direction"},
};

// Seeds on which variations are tried; the plain experiment has all of them.
constexpr std::uint32_t threshold_seeds = 4;
constexpr std::uint32_t other_seeds = 2;

// Shares of a case's time, for the progress bar.
constexpr double truth_share = 0.3;
constexpr double tuning_share = 0.1;

struct Stopped {};

/// What all trials of a case have in common.
struct Case {
  const StabilityOptions& options;
  const FailureCase& failure;
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;
  Truth truth;
  std::shared_ptr<const Audit> audit;
  std::vector<SamplingPolicy> usual;   // one an estimator, the oracle last
  std::vector<SamplingPolicy> budget;  // the same

  PixelRegion region() const { return pixels_of(failure.region, settings.width, settings.height); }
};

/// A lane of an experiment.
struct Entry {
  Tuning tuning;
  Variation variation;
  SamplingPolicy policy;
};

SamplingPolicy with_scaled_thresholds(SamplingPolicy policy, float factor) {
  for (float& threshold : policy.thresholds) {
    threshold *= factor;
  }
  return policy;
}

SamplingPolicy in_mode(SamplingPolicy policy, SampleUse use) {
  policy.use = use;
  return policy;
}

SamplingPolicy uniform_policy(const StabilityOptions& options) {
  SamplingPolicy policy = default_policy(EstimatorId::uniform);
  policy.max_spp = std::uint32_t(std::lround(options.spp));
  return policy;
}

/// One with the error of each estimator and, last, of the oracle.
std::vector<SamplingPolicy> usual_policies(const StabilityOptions& options) {
  std::vector<SamplingPolicy> policies;
  std::vector<EstimatorId> ids = options.estimators;
  std::erase(ids, EstimatorId::oracle);
  ids.push_back(EstimatorId::oracle);
  for (const EstimatorId id : ids) {
    SamplingPolicy policy = default_policy(id);
    policy.allocation.kind = options.allocation;
    policy.max_spp = std::uint32_t(std::lround(options.spp * maximum_over_budget));
    policies.push_back(policy);
  }
  return policies;
}

/// The plain experiment: uniform, oracle at the budget, then each estimator in both tunings and
/// both modes; with `thresholds` also those with moved thresholds.
std::vector<Entry> plain_entries(const Case& common, bool thresholds) {
  std::vector<Entry> entries{
      {Tuning::budget, Variation::none, uniform_policy(common.options)},
      {Tuning::budget, Variation::none, common.budget.back()},
  };
  for (std::size_t i = 0; i + 1 < common.usual.size(); ++i) {
    for (const SampleUse use : {SampleUse::reuse, SampleUse::unbiased}) {
      entries.push_back({Tuning::usual, Variation::none, in_mode(common.usual[i], use)});
      entries.push_back({Tuning::budget, Variation::none, in_mode(common.budget[i], use)});
    }
    if (thresholds) {
      entries.push_back({Tuning::budget, Variation::threshold_up,
                         with_scaled_thresholds(common.budget[i], 1.1f)});
      entries.push_back({Tuning::budget, Variation::threshold_down,
                         with_scaled_thresholds(common.budget[i], 1.0f / 1.1f)});
    }
  }
  return entries;
}

/// Each estimator at the budget, for a variation of the picture itself; the oracle first, as above.
std::vector<Entry> varied_entries(const Case& common, Variation variation) {
  std::vector<Entry> entries{{Tuning::budget, variation, common.budget.back()}};
  for (std::size_t i = 0; i + 1 < common.budget.size(); ++i) {
    entries.push_back({Tuning::budget, variation, common.budget[i]});
  }
  return entries;
}

std::vector<SamplingPolicy> policies_of(const std::vector<Entry>& entries) {
  std::vector<SamplingPolicy> policies;
  policies.reserve(entries.size());
  for (const Entry& entry : entries) {
    policies.push_back(entry.policy);
  }
  return policies;
}

/// Runs lanes to their ends and measures each.
std::vector<Trial> run_entries(const Case& common, const std::vector<Entry>& entries,
                               std::size_t oracle, const SampleSource& source,
                               const SampleSource& pilot, int width, int height, const Truth& truth,
                               std::uint64_t seed, std::stop_token stop) {
  LabOptions options;
  options.threads = 1;
  options.reference = truth.image;
  options.pilot_source = pilot;
  Lab lab(source, width, height, policies_of(entries), options);
  const PixelRegion region = pixels_of(common.failure.region, width, height);
  std::vector<Observation> observations(entries.size(),
                                        Observation(truth, region, common.options.target));
  while (std::ranges::any_of(lab.lanes(), [](const Lane& lane) { return lane.plan().total > 0; })) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      observations[i].before_frame(lab.lanes()[i]);
    }
    if (!lab.run_frame() || stop.stop_requested()) {
      throw Stopped();
    }
  }
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Lane& lane = lab.lanes()[i];
    trials.push_back({&common.failure, entries[i].tuning, entries[i].variation, seed,
                      entries[i].policy, lane.frame(),
                      observations[i].outcome(lane, lab.lanes()[oracle].taken(), *common.audit)});
  }
  return trials;
}

SampleSource doubled(SampleSource source) {
  return [source = std::move(source)](int x, int y, std::uint32_t first,
                                      std::span<glm::vec3> radiance) {
    source(x, y, first, radiance);
    for (glm::vec3& sample : radiance) {
      sample *= 2.0f;
    }
  };
}

std::shared_ptr<const RadianceImage> doubled(const RadianceImage& image) {
  RadianceImage result = image;
  for (glm::vec3& pixel : result.pixels()) {
    pixel *= 2.0f;
  }
  return std::make_shared<const RadianceImage>(std::move(result));
}

/// Each pixel four times: the truth of a picture of twice the size as far as it is known, for the
/// cost alone.
std::shared_ptr<const RadianceImage> enlarged(const RadianceImage& image) {
  RadianceImage result(2 * image.width(), 2 * image.height());
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      result.at(x, y) = image.at(x / 2, y / 2);
    }
  }
  return std::make_shared<const RadianceImage>(std::move(result));
}

std::vector<Trial> run_seed(const Case& common, std::uint32_t seed, std::stop_token stop) {
  RenderSettings settings = common.settings;
  settings.seed = seed;
  const SampleSource source = sample_source(common.scene, settings);
  std::vector<Trial> trials =
      run_entries(common, plain_entries(common, seed < threshold_seeds), 1, source,
                  pilot_source(common.scene, settings), settings.width, settings.height,
                  common.truth, seed, stop);
  const auto append = [&](std::vector<Trial> more) {
    trials.insert(trials.end(), more.begin(), more.end());
  };
  if (seed < other_seeds) {
    Truth bright = common.truth;
    bright.image = doubled(*common.truth.image);
    append(run_entries(common, varied_entries(common, Variation::exposure), 0, doubled(source), {},
                       settings.width, settings.height, bright, seed, stop));
    settings.width *= 2;
    settings.height *= 2;
    Truth large = common.truth;
    large.image = enlarged(*common.truth.image);
    append(run_entries(common, varied_entries(common, Variation::resolution), 0,
                       sample_source(common.scene, settings), {}, settings.width, settings.height,
                       large, seed, stop));
  }
  return trials;
}

class Study {
 public:
  Study(const StabilityOptions& options,
        const std::function<void(double, std::string_view)>& progress, std::stop_token stop)
      : options_(options), progress_(progress), stop_(std::move(stop)) {}

  CaseResult run(std::size_t index);

 private:
  void advance(double share_of_case);
  Case prepare();
  std::vector<Trial> run_seeds(const Case& common);

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

Case Study::prepare() {
  const FailureCase& failure = *options_.cases[index_];
  auto scene = std::make_shared<const TraceScene>(open_scene(failure.scene));
  Case common{options_, failure, scene, default_settings(scene->scene()), {}, {}, {}, {}};
  const auto truth = find_truth(scene, common.settings, options_.truth, [&](double done) {
    advance(truth_share * done);
    return true;
  });
  common.truth = *truth;
  // Seeds that no trial has.
  RenderSettings hidden = common.settings;
  hidden.seed = ~reference_seed;
  common.audit =
      std::make_shared<const Audit>(sample_source(scene, hidden), hidden.width, hidden.height,
                                    options_.audit_share, options_.audit_samples, hidden.seed);
  advance(truth_share);

  common.usual = usual_policies(options_);
  RenderSettings tuning = common.settings;
  tuning.seed = ~std::uint64_t(0);
  LabOptions lab;
  lab.threads = 1;
  lab.reference = common.truth.image;
  common.budget = meet_budget(sample_source(scene, tuning), tuning.width, tuning.height,
                              common.usual, options_.spp, lab,
                              [&](double done) { advance(truth_share + tuning_share * done); });
  return common;
}

std::vector<Trial> Study::run_seeds(const Case& common) {
  std::vector<std::vector<Trial>> of_seed(options_.seeds);
  std::atomic<std::uint32_t> finished = 0;
  parallel_for(options_.seeds, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t seed = begin; seed < end; ++seed) {
      of_seed[seed] = run_seed(common, std::uint32_t(seed), stop_);
      const double done = double(++finished) / double(options_.seeds);
      advance(truth_share + tuning_share + (1.0 - truth_share - tuning_share) * done);
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
  const Case common = prepare();
  return {&common.failure, common.truth, common.settings.width, common.settings.height,
          run_seeds(common)};
}

}  // namespace

std::span<const VariationRow> variations() {
  return variation_table;
}

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
