#include "renderer/adaptive/lane.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "renderer/adaptive/film/film_feed.h"
#include "renderer/base/stopwatch.h"

namespace quartet {
namespace {

/// What the film keeps by which the estimator judges.
FilmStatistics needed_statistics(const LaneSettings& settings, const LaneInputs& inputs) {
  FilmStatistics needs = estimator(settings.estimator).needs;
  needs.replicated = inputs.sampler == SamplerId::replicated;
  return needs;
}

/// What the shown film keeps; a pilot keeps what the estimator needs.
FilmStatistics shown_statistics(const LaneSettings& settings, const LaneInputs& inputs) {
  FilmStatistics statistics = inputs.statistics;
  statistics.replicated = inputs.sampler == SamplerId::replicated;
  // What is cut is cut in what is shown, whoever decides.
  statistics.clamp = estimator(settings.estimator).needs.clamp;
  return settings.mode == SampleMode::unbiased ? statistics
                                               : statistics | needed_statistics(settings, inputs);
}

/// Whether this pass is looked up; else the film is made ready to add.
bool begin_film(Film& film, const SampleStore& store, std::uint32_t pass) {
  if (looks_up(film, store)) {
    return true;
  }
  // What was looked up before must have been summed up.
  assert(film.has_sums() || pass == 0);
  static_cast<void>(pass);
  film.keep_sums();
  return false;
}

void take_row(Film& film, const PassSamples& samples, int tile_row, bool looks_up_store,
              SampleCosts::Work& work) {
  const auto rows = std::size_t(samples.store.tile_rows());
  const std::size_t first = SampleCosts::side * SampleCosts::cell(std::size_t(tile_row), rows);
  const std::span cells = std::span(work.units).subspan(first, SampleCosts::side);
  if (looks_up_store) {
    look_up(film, samples, tile_row, cells);
  } else {
    accumulate(film, samples, tile_row, cells);
  }
}

}  // namespace

Lane::Lane(int width, int height, const LaneSettings& settings, const LaneInputs& inputs)
    : film_(width, height), taken_(film_.size(), 0) {
  restart(settings, inputs);
}

void Lane::restart(const LaneSettings& settings, const LaneInputs& inputs) {
  settings_ = settings;
  const Estimator& row = estimator(settings.estimator);
  reference_ = row.needs_reference ? inputs.reference : nullptr;
  film_.restart(shown_statistics(settings, inputs));
  if (settings.mode == SampleMode::reuse) {
    pilot_.reset();
  } else if (pilot_) {
    pilot_->restart(needed_statistics(settings, inputs));
  } else {
    pilot_.emplace(film_.width(), film_.height(), needed_statistics(settings, inputs));
  }
  error_.clear();
  std::fill(taken_.begin(), taken_.end(), 0u);
  history_.clear();
  shown_work_ = {};
  pilot_work_ = {};
  own_seconds_ = 0.0;
  replan(0);
}

void Lane::begin_pass(const LaneStores& stores) {
  const Stopwatch watch;
  rows_.assign(std::size_t(stores.shown.tile_rows()), {});
  looks_up_shown_ = begin_film(film_, stores.shown, pass());
  if (pilot_) {
    looks_up_pilot_ = begin_film(*pilot_, *stores.pilot, pass());
  }
  own_seconds_ += watch.seconds();
}

void Lane::take(const LaneStores& stores, int tile_row) {
  const auto width = std::size_t(film_.width());
  const std::size_t begin = std::size_t(tile_row) * SampleStore::tile_size * width;
  const std::size_t end = std::min(begin + SampleStore::tile_size * width, film_.size());
  RowTotal& total = rows_[std::size_t(tile_row)];
  total.max_spp = count(begin, end);
  take_row(film_, {stores.shown, taken_, plan_.wanted}, tile_row, looks_up_shown_, total.shown);
  if (pilot_) {
    take_row(*pilot_, {*stores.pilot, taken_, plan_.wanted}, tile_row, looks_up_pilot_,
             total.pilot);
  }
}

void Lane::end_pass(double take_seconds) {
  const Stopwatch watch;
  const Estimator& row = estimator(settings_.estimator);
  if (row.estimate) {
    error_.resize(std::size_t(row.channels) * film_.size());
    EstimatorInput input{deciding_film()};
    if (reference_) {
      input.reference = reference_->pixels();
    }
    row.estimate(input, error_);
  }
  PassTotal total{.samples = plan_.total, .work = {}};
  if (looks_up_shown_) {
    shown_work_ = {};
  }
  if (looks_up_pilot_) {
    pilot_work_ = {};
  }
  for (const RowTotal& row_total : rows_) {
    total.max_spp = std::max(total.max_spp, row_total.max_spp);
    shown_work_ += row_total.shown;
    pilot_work_ += row_total.pilot;
  }
  total.work = shown_work_;
  total.work += pilot_work_;
  replan(pass() + 1);
  total.not_done = plan_.not_done;
  own_seconds_ += take_seconds + watch.seconds();
  record_pass(total);
}

/// Writes the record of the pass after the last.
void Lane::record_pass(const PassTotal& total) {
  PassRecord record;
  if (!history_.records().empty()) {
    record = history_.back();
  }
  ++record.pass;
  record.samples += pilot_ ? 2 * total.samples : total.samples;
  record.pilot_samples += pilot_ ? total.samples : 0;
  record.max_spp = total.max_spp;
  // Each sample is one unit of work beside its rays.
  const auto& units = total.work.units;
  record.rays = std::accumulate(units.begin(), units.end(), std::uint64_t(0)) - record.samples;
  record.not_done = total.not_done;
  record.seconds = own_seconds_;
  record.truth = {};
  history_.push(record, total.work);
}

bool Lane::can_replay(const SampleStore& store) const {
  return estimator(settings_.estimator).window && settings_.mode == SampleMode::reuse &&
         looks_up(film_, store) && store.holds(taken_, plan_.wanted);
}

std::unique_ptr<Replay> Lane::begin_replay(const SampleStore& store, std::uint32_t passes) {
  error_.resize(std::size_t(estimator(settings_.estimator).channels) * film_.size());
  return std::make_unique<Replay>(store, Replay::Start{settings_, pass(), taken_, plan_.wanted},
                                  passes, film_, error_);
}

void Lane::end_replay(const SampleStore& store, Replay& replay) {
  reject(film_, store, taken_, replay.taken());
  taken_.swap(replay.taken());
  plan_.wanted.swap(replay.wanted());
  for (const PassTotal& total : replay.totals()) {
    own_seconds_ += replay.seconds() / double(replay.passes());
    record_pass(total);
  }
  const PassTotal& last = replay.totals().back();
  shown_work_ = last.work;
  plan_.total = last.planned;
  plan_.not_done = last.not_done;
}

void Lane::forget_true_errors() {
  for (PassRecord& record : history_.records()) {
    record.truth = {};
  }
}

/// Adds what is wanted of pixels [begin, end) to what is taken; returns the most of a pixel.
std::uint32_t Lane::count(std::size_t begin, std::size_t end) {
  std::uint32_t* taken = taken_.data();
  const std::uint16_t* wanted = plan_.wanted.data();
  std::uint32_t most = 0;
#pragma omp simd reduction(max : most)
  for (std::size_t i = begin; i < end; ++i) {
    taken[i] += wanted[i];
    most = std::max(most, taken[i]);
  }
  return most;
}

void Lane::catch_up_shown(const SampleStore& store) {
  catch_up(film_, store, taken_);
}

void Lane::catch_up_pilot(const SampleStore& store) {
  if (pilot_) {
    catch_up(*pilot_, store, taken_);
  }
}

/// Plans the pass after this one.
void Lane::replan(std::uint32_t pass) {
  plan_next(settings_, {film_.width(), film_.height(), error_, taken_, pass}, plan_);
}

}  // namespace quartet
