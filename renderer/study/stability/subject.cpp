#include "renderer/study/stability/subject.h"

#include <array>
#include <cmath>

#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr std::array all_terms{TermsRow{Terms::budget, "budget"},
                               TermsRow{Terms::window, "window"}};

/// Two samples, then two more as long as they do not happen to agree.
LaneSettings lucky_settings() {
  LaneSettings settings = default_settings(EstimatorId::half_buffer);
  settings.policy.first = 2;
  settings.policy.batch = 2;
  return settings;
}

template <EstimatorId id>
LaneSettings default_settings_of() {
  return default_settings(id);
}

// Where a few samples of most pixels agree and are wrong.
constexpr std::array<std::string_view, 4> cases_agreeing{"rare-light", "two-valued", "bernoulli",
                                                         "door-ajar"};
// Where every pixel is alike, so that whoever deals unevenly loses, and where many are.
constexpr std::array<std::string_view, 4> cases_alike{"bernoulli", "pareto", "border",
                                                      "two-valued"};
// Where there is nothing left to find long before the maximum.
constexpr std::array<std::string_view, 4> cases_early{"grey-furnace", "black-background",
                                                      "hdr-edge", "checker-blurred"};
// Where light comes in samples far above the mean.
constexpr std::array<std::string_view, 3> cases_bright{"caustic", "rare-light", "hdr-edge"};

constexpr std::array planted_table{
    Planted{"lucky", "Stops where two samples happen to agree.", "misses", cases_agreeing,
            lucky_settings},
    Planted{"lottery", "Spends at random.", "worse", cases_alike,
            default_settings_of<EstimatorId::lottery>},
    Planted{"endless", "Is never done.", "never-done", cases_early,
            default_settings_of<EstimatorId::endless>},
    Planted{"uniform-clamp", "Darkens: cuts each sample at 4.", "biased", cases_bright,
            default_settings_of<EstimatorId::uniform_clamp>},
};

}  // namespace

std::span<const TermsRow> terms_table() {
  return all_terms;
}

const TermsRow& terms_row(Terms key) {
  return row_of(terms_table(), key);
}

std::string_view role_id(Role role) {
  switch (role) {
    case Role::baseline:
      return "baseline";
    case Role::studied:
      return "studied";
    case Role::planted:
      return "planted";
  }
  return "";
}

std::span<const Planted> planted_mistakes() {
  return planted_table;
}

std::vector<Subject> stability_subjects(std::span<const EstimatorId> studied, PolicyId policy,
                                        double budget) {
  std::vector<Subject> subjects;
  const auto add = [&](Role role, LaneSettings settings, std::string_view id) {
    const bool ends = estimator(settings.estimator).channels > 0;
    settings.policy.kind = policy;
    settings.max_spp = std::uint32_t(std::lround(ends ? budget * maximum_over_budget : budget));
    subjects.push_back({id, role, settings});
  };
  const auto add_estimator = [&](Role role, EstimatorId key) {
    add(role, default_settings(key), estimator(key).id);
  };
  add_estimator(Role::baseline, EstimatorId::uniform);
  add_estimator(Role::baseline, EstimatorId::oracle_expected);
  for (const EstimatorId key : studied) {
    add_estimator(Role::studied, key);
  }
  for (const Planted& row : planted_mistakes()) {
    add(Role::planted, row.settings(), row.id);
  }
  return subjects;
}

}  // namespace quartet
