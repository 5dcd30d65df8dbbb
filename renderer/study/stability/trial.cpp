#include "renderer/study/stability/trial.h"

#include <algorithm>
#include <array>

#include "renderer/adaptive/lab.h"
#include "renderer/adaptive/run_lab.h"
#include "renderer/study/calibrate.h"

namespace quartet {
namespace {

constexpr std::array variation_table{
    VariationRow{Variation::none, "none", "the plain experiment"},
    VariationRow{Variation::threshold_up, "threshold_up", "thresholds × 1.1"},
    VariationRow{Variation::threshold_down, "threshold_down", "thresholds ÷ 1.1"},
    VariationRow{Variation::exposure, "exposure", "all radiance × 2"},
    VariationRow{Variation::resolution, "resolution",
                 "twice the pixels in each direction, and the picture shrunk back"},
};

// Seeds on which variations are tried; the plain experiment has all of them.
constexpr std::uint32_t threshold_seeds = 4;
constexpr std::uint32_t other_seeds = 2;

/// A lane of an experiment.
struct Entry {
  Tuning tuning;
  Variation variation;
  LaneSettings settings;
};

LaneSettings in_mode(LaneSettings settings, SampleMode mode) {
  settings.mode = mode;
  return settings;
}

/// The oracle at the budget, uniform, then each estimator in both tunings and both modes; with
/// `thresholds` also those with moved thresholds.
std::vector<Entry> plain_entries(const TrialSetup& setup, bool thresholds) {
  std::vector<Entry> entries{
      {Tuning::budget, Variation::none, setup.oracle},
      {Tuning::budget, Variation::none, setup.uniform},
  };
  for (std::size_t i = 0; i < setup.usual.size(); ++i) {
    for (const SampleMode mode : {SampleMode::reuse, SampleMode::unbiased}) {
      entries.push_back({Tuning::usual, Variation::none, in_mode(setup.usual[i], mode)});
      entries.push_back({Tuning::budget, Variation::none, in_mode(setup.budget[i], mode)});
    }
    if (thresholds) {
      entries.push_back(
          {Tuning::budget, Variation::threshold_up, scaled_thresholds(setup.budget[i], 1.1)});
      entries.push_back({Tuning::budget, Variation::threshold_down,
                         scaled_thresholds(setup.budget[i], 1.0 / 1.1)});
    }
  }
  return entries;
}

/// The oracle, then each estimator at the budget, for all radiance × 2.
std::vector<Entry> exposed_entries(const TrialSetup& setup) {
  std::vector<Entry> entries{{Tuning::budget, Variation::exposure, setup.oracle}};
  for (const LaneSettings& settings : setup.budget) {
    entries.push_back({Tuning::budget, Variation::exposure, settings});
  }
  return entries;
}

std::vector<LaneSettings> settings_of_lanes(const std::vector<Entry>& entries) {
  std::vector<LaneSettings> lane_settings;
  lane_settings.reserve(entries.size());
  for (const Entry& entry : entries) {
    lane_settings.push_back(entry.settings);
  }
  return lane_settings;
}

bool wants_samples(const Lab& lab) {
  return std::ranges::any_of(lab.lanes(), [](const Lane& lane) { return lane.plan().total > 0; });
}

Trial trial_of(const TrialSetup& setup, const Entry& entry, std::uint64_t seed, const Lane& lane,
               const Outcome& outcome) {
  return {setup.failure,  entry.tuning, entry.variation, seed,
          entry.settings, lane.pass(),  outcome,         rejected_of(lane, seed)};
}

/// Runs lanes, of which the first is the oracle, to their ends and measures each; appends to
/// `trials`. Returns false if `stop` ended it.
bool run_entries(const TrialSetup& setup, const std::vector<Entry>& entries,
                 const SampleSource& source, const SampleSource& pilot, const Truth& truth,
                 std::uint64_t seed, const std::stop_token& stop, std::vector<Trial>& trials) {
  LabOptions options;
  options.threads = 1;
  options.sampler = setup.settings.sampler;
  options.reference = truth.image;
  options.pilot_source = pilot;
  const int width = setup.settings.width;
  const int height = setup.settings.height;
  Lab lab(source, width, height, settings_of_lanes(entries), options);
  const PixelRegion region = pixels_of(setup.failure->region, width, height);
  std::vector<Observation> observations(entries.size(), Observation(truth, region, setup.target));
  const auto observe = [&] {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      observations[i].before_pass(lab.lanes()[i]);
    }
  };
  observe();
  const bool ended = run_lab(lab, stop, [&] {
    const bool another = wants_samples(lab);
    if (another) {
      observe();
    }
    return another;
  });
  for (std::size_t i = 0; ended && i < entries.size(); ++i) {
    const Lane& lane = lab.lanes()[i];
    trials.push_back(
        trial_of(setup, entries[i], seed, lane,
                 observations[i].outcome(lane, lab.lanes().front().taken(), *setup.audit)));
  }
  return ended;
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

Truth doubled(Truth truth) {
  RadianceImage image = *truth.image;
  for (glm::vec3& pixel : image.pixels()) {
    pixel *= 2.0f;
  }
  truth.image = std::make_shared<const RadianceImage>(std::move(image));
  return truth;
}

/// The mean of each 2×2 pixels: with a box for a filter, what a picture of half the size shows of
/// the same samples.
RadianceImage shrunk(const RadianceImage& image) {
  RadianceImage result(image.width() / 2, image.height() / 2);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      result.at(x, y) = 0.25f * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                                 image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1));
    }
  }
  return result;
}

/// Uniform, and each estimator at the budget, with four times the pixels. The picture is shrunk
/// before it is compared, because a truth of that size would cost four times what is known already.
bool run_enlarged(const TrialSetup& setup, std::uint64_t seed, const std::stop_token& stop,
                  std::vector<Trial>& trials) {
  std::vector<Entry> entries{{Tuning::budget, Variation::resolution, setup.uniform}};
  for (const LaneSettings& settings : setup.budget) {
    entries.push_back({Tuning::budget, Variation::resolution, settings});
  }
  RenderSettings settings = setup.settings;
  settings.seed = seed;
  settings.width *= 2;
  settings.height *= 2;
  LabOptions options;
  options.threads = 1;
  options.sampler = setup.settings.sampler;
  Lab lab(sample_source(setup.scene, settings), settings.width, settings.height,
          settings_of_lanes(entries), options);
  const bool ended = run_lab(lab, stop, [&] { return wants_samples(lab); });
  const PixelRegion region =
      pixels_of(setup.failure->region, setup.settings.width, setup.settings.height);
  for (std::size_t i = 0; ended && i < entries.size(); ++i) {
    const Lane& lane = lab.lanes()[i];
    Outcome outcome = outcome_of(shrunk(lane.film().image()), *setup.truth.image, region);
    set_cost(outcome, lane);
    trials.push_back(trial_of(setup, entries[i], seed, lane, outcome));
  }
  return ended;
}

}  // namespace

std::span<const VariationRow> variations() {
  return variation_table;
}

std::optional<std::vector<Trial>> run_trials(const TrialSetup& setup, std::uint32_t seed,
                                             const std::stop_token& stop) {
  RenderSettings settings = setup.settings;
  settings.seed = seed;
  const SampleSource source = sample_source(setup.scene, settings);
  std::vector<Trial> trials;
  bool ended = run_entries(setup, plain_entries(setup, seed < threshold_seeds), source,
                           pilot_source(setup.scene, settings), setup.truth, seed, stop, trials);
  if (seed < other_seeds) {
    ended = ended &&
            run_entries(setup, exposed_entries(setup), doubled(source), {}, doubled(setup.truth),
                        seed, stop, trials) &&
            run_enlarged(setup, seed, stop, trials);
  }
  return ended ? std::optional(std::move(trials)) : std::nullopt;
}

}  // namespace quartet
