#include "renderer/study/stability/trial.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "renderer/adaptive/lab.h"
#include "renderer/adaptive/run_lab.h"
#include "renderer/study/calibrate.h"
#include "renderer/study/scaled_radiance.h"
#include "renderer/study/stability/uniform_run.h"

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
  std::string_view subject;
  Terms terms;
  Variation variation;
  LaneSettings settings;
};

bool is_studied(const Subject& subject) {
  return subject.role == Role::studied;
}

Entry in_mode_unbiased(Entry entry) {
  entry.settings.mode = SampleMode::unbiased;
  return entry;
}

const Subject& oracle_of(const TrialSetup& setup) {
  return *std::ranges::find(setup.subjects, EstimatorId::oracle_expected,
                            [](const Subject& subject) { return subject.settings.estimator; });
}

/// The oracle, then every subject, and of what is studied the unbiased twin; with `thresholds` also
/// those with moved thresholds.
std::vector<Entry> budget_entries(const TrialSetup& setup, bool thresholds) {
  const auto entry = [](const Subject& subject, Variation variation, double factor) {
    return Entry{subject.id, Terms::budget, variation, scaled_thresholds(subject.settings, factor)};
  };
  std::vector<Entry> entries{entry(oracle_of(setup), Variation::none, 1.0)};
  for (const Subject& subject : setup.subjects) {
    if (&subject != &oracle_of(setup)) {
      entries.push_back(entry(subject, Variation::none, 1.0));
    }
    if (is_studied(subject)) {
      entries.push_back(in_mode_unbiased(entry(subject, Variation::none, 1.0)));
    }
    if (is_studied(subject) && thresholds) {
      entries.push_back(entry(subject, Variation::threshold_up, 1.1));
      entries.push_back(entry(subject, Variation::threshold_down, 1.0 / 1.1));
    }
  }
  return entries;
}

/// The oracle, then all that nobody planted, as the window begins. The oracle keeps the threshold
/// that is right for the budget.
std::vector<Entry> window_entries(const TrialSetup& setup) {
  const auto entry = [&](const Subject& subject) {
    LaneSettings settings = default_settings(subject.settings.estimator);
    settings.policy = Policy();
    if (&subject == &oracle_of(setup)) {
      settings.thresholds = subject.settings.thresholds;
    }
    return Entry{subject.id, Terms::window, Variation::none, settings};
  };
  std::vector<Entry> entries{entry(oracle_of(setup))};
  for (const Subject& subject : setup.subjects) {
    if (&subject != &oracle_of(setup) && subject.role != Role::planted) {
      entries.push_back(entry(subject));
    }
  }
  return entries;
}

/// First one subject, then all that is studied, with a variation. Relative errors are expected to
/// stay as they are.
std::vector<Entry> varied_entries(const TrialSetup& setup, const Subject& first,
                                  Variation variation) {
  std::vector<Entry> entries{{first.id, Terms::budget, variation, first.settings}};
  for (const Subject& subject : setup.subjects) {
    if (is_studied(subject)) {
      entries.push_back({subject.id, Terms::budget, variation, subject.settings});
    }
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
  return {setup.failure,  entry.subject, entry.terms, entry.variation,        seed,
          entry.settings, lane.pass(),   outcome,     rejected_of(lane, seed)};
}

/// One seed's samples of a case, and what they are compared with.
struct TrialWorld {
  SampleSource source;
  SampleSource pilot;  // may be none
  Judgement judgement;
  std::uint64_t seed = 0;

  Lab lab(const TrialSetup& setup, const std::vector<Entry>& entries) const {
    LabOptions options;
    options.threads = 1;
    options.sampler = setup.settings.sampler;
    options.reference = judgement.expected;
    options.pilot_source = pilot;
    return {source, setup.settings.width, setup.settings.height, settings_of_lanes(entries),
            options};
  }
};

/// Runs the lanes of a lab, of which the first is the oracle, to their ends, at most `passes`, and
/// measures each; nothing if `stop` ended it.
std::optional<std::vector<Trial>> run_entries(const TrialSetup& setup,
                                              const std::vector<Entry>& entries,
                                              const TrialWorld& world, std::uint32_t passes,
                                              Lab& lab, const std::stop_token& stop) {
  std::vector<Observation> observations(entries.size(), Observation(world.judgement));
  const auto observe = [&] {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      observations[i].before_pass(lab.lanes()[i]);
    }
  };
  observe();
  const bool ended = run_lab(lab, stop, [&] {
    const bool another = lab.pass() < passes && wants_samples(lab);
    if (another) {
      observe();
    }
    return another;
  });
  if (!ended) {
    return std::nullopt;
  }
  std::vector<Trial> trials;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Lane& lane = lab.lanes()[i];
    trials.push_back(
        trial_of(setup, entries[i], world.seed, lane,
                 observations[i].outcome(lane, lab.lanes().front().taken(), *setup.audit)));
  }
  return trials;
}

/// The same, and appends to `trials`; false if stopped.
bool run_varied(const TrialSetup& setup, const std::vector<Entry>& entries, const TrialWorld& world,
                const std::stop_token& stop, std::vector<Trial>& trials) {
  Lab lab = world.lab(setup, entries);
  auto more = run_entries(setup, entries, world, UINT32_MAX, lab, stop);
  if (more) {
    std::ranges::move(*more, std::back_inserter(trials));
  }
  return more.has_value();
}

/// On both terms, each beside uniform sampling with the same seed.
std::optional<std::vector<Trial>> run_plain(const TrialSetup& setup, const TrialWorld& world,
                                            const std::stop_token& stop) {
  const std::vector<Entry> entries = budget_entries(setup, world.seed < threshold_seeds);
  Lab lab = world.lab(setup, entries);
  auto trials = run_entries(setup, entries, world, UINT32_MAX, lab, stop);
  if (!trials) {
    return std::nullopt;
  }
  const std::vector<Entry> windowed = window_entries(setup);
  lab.set_lanes(settings_of_lanes(windowed), {}, world.judgement.expected);
  auto more = run_entries(setup, windowed, world, setup.window_passes, lab, stop);
  if (!more) {
    return std::nullopt;
  }
  std::ranges::move(*more, std::back_inserter(*trials));
  const auto uniform =
      run_uniform(lab, setup.most_spp, setup.judgement.truth, setup.judgement.region, stop);
  if (!uniform) {
    return std::nullopt;
  }
  for (Trial& trial : *trials) {
    set_beside(trial.outcome, *uniform, world.judgement.truth);
  }
  return trials;
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

/// Uniform, and what is studied, with four times the pixels. The picture is shrunk before it is
/// compared, because a truth of that size would cost four times what is known already.
bool run_enlarged(const TrialSetup& setup, std::uint64_t seed, const std::stop_token& stop,
                  std::vector<Trial>& trials) {
  const std::vector<Entry> entries =
      varied_entries(setup, setup.subjects.front(), Variation::resolution);
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
  for (std::size_t i = 0; ended && i < entries.size(); ++i) {
    const Lane& lane = lab.lanes()[i];
    Outcome outcome = outcome_of(shrunk(lane.film().image()), *setup.judgement.truth.image,
                                 setup.judgement.region);
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
  const TrialWorld world{sample_source(setup.scene, settings), pilot_source(setup.scene, settings),
                         setup.judgement, seed};
  auto trials = run_plain(setup, world, stop);
  if (trials && seed < other_seeds) {
    const glm::vec3 twice(2.0f);
    TrialWorld brighter{scaled(world.source, twice), {}, setup.judgement, seed};
    brighter.judgement.truth.image =
        std::make_shared<const RadianceImage>(scaled(*setup.judgement.truth.image, twice));
    const bool ended =
        run_varied(setup, varied_entries(setup, oracle_of(setup), Variation::exposure), brighter,
                   stop, *trials) &&
        run_enlarged(setup, seed, stop, *trials);
    if (!ended) {
      return std::nullopt;
    }
  }
  return trials;
}

}  // namespace quartet
