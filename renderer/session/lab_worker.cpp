#include "renderer/session/lab_worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "renderer/measure/energy.h"
#include "renderer/session/baseline.h"

namespace quartet {
namespace {

using std::chrono::milliseconds;

constexpr auto snapshot_interval = milliseconds(33);
// While a replay has not caught up with what is shown, its passes would only flicker: they are
// shown when there is nothing better for this long.
constexpr auto replay_interval = milliseconds(250);

void check(const LabRequest& request) {
  if (!request.store.scene) {
    throw std::invalid_argument("no scene to render");
  }
  if (request.lanes.settings.empty()) {
    throw std::invalid_argument("no lane to render");
  }
  const RenderSettings& settings = request.store.settings;
  if (settings.width < 1 || settings.height < 1) {
    throw std::invalid_argument("a picture needs at least one pixel");
  }
  if (const auto& reference = request.lanes.reference;
      reference &&
      (reference->width() != settings.width || reference->height() != settings.height)) {
    throw std::invalid_argument(
        fmt::format("the reference has {} × {} pixels, the pictures {} × {}", reference->width(),
                    reference->height(), settings.width, settings.height));
  }
}

}  // namespace

LabWorker::LabWorker(Mailbox& mailbox, std::function<void()> notify)
    : mailbox_(mailbox), notify_(std::move(notify)), board_(mailbox) {
}

void LabWorker::run() {
  thread_ = std::this_thread::get_id();
  while (std::unique_ptr<Mailbox::Numbered> newest = mailbox_.wait_and_take()) {
    mailbox_.set_working(true);
    while (newest) {
      try {
        begin(std::move(newest));
        newest = answer();
      } catch (const Closed&) {
        return;
      } catch (const std::exception& error) {
        fail(error.what());
        newest = mailbox_.take();
      }
    }
    mailbox_.set_working(false);
  }
}

/// Makes the newest request the current one, and the lab fit for it.
void LabWorker::begin(std::unique_ptr<Mailbox::Numbered> newest) {
  const Clock::time_point now = Clock::now();
  if (answered_) {
    unanswered_since_ = now;
    answered_ = false;
  }
  patience_ends_ = now + (now - unanswered_since_);
  if (board_.idle()) {
    board_.meter.restart(now);
  }
  complete_ = false;
  check(newest->request);
  const bool keep = lab_ && current_->request.store == newest->request.store;
  current_ = std::move(newest);
  board_.status.error.clear();
  board_.status.pass_target = current_->request.lanes.pass;
  board_.status.memory_budget = current_->request.store.memory;
  if (keep) {
    change_lab();
  } else {
    make_lab();
  }
}

/// Of the lanes that were asked for and, if there is something to compare them with, of a last one
/// of uniform sampling.
std::vector<LaneSettings> LabWorker::lane_settings() const {
  std::vector<LaneSettings> all = current_->request.lanes.settings;
  if (current_->request.lanes.reference) {
    all.push_back(default_settings(EstimatorId::uniform));
  }
  return all;
}

void LabWorker::make_lab() {
  const LabRequest& request = current_->request;
  lab_.reset();
  shown_.reset();
  pool_->clear();
  replaying_ = false;
  board_.status.activity = Activity::tracing;
  LabOptions options;
  options.threads = request.store.threads;
  options.memory = request.store.memory;
  options.statistics.variance = request.lanes.variance;
  options.sampler = request.store.settings.sampler;
  options.reference = request.lanes.reference;
  options.pilot_source = watched(pilot_source(request.store.scene, request.store.settings));
  lab_ = std::make_unique<Lab>(watched(sample_source(request.store.scene, request.store.settings)),
                               request.store.settings.width, request.store.settings.height,
                               lane_settings(), options);
  measure_anew();
  owes_first_picture_ = request.lanes.pass > 0;
  board_.describe(*lab_);
  publish_status();
}

void LabWorker::change_lab() {
  const LabRequest& request = current_->request;
  std::uint32_t reached = shown_ ? shown_->pass : 0;
  for (const Lane& lane : lab_->lanes().first(lab_->lanes().size() - (measured_against_ ? 1 : 0))) {
    reached = std::max(reached, lane.pass());
  }
  FilmStatistics statistics;
  statistics.variance = request.lanes.variance;
  lab_->set_lanes(lane_settings(), statistics, request.lanes.reference);
  if (is_answered_by_shown()) {
    publish_shown_again();
    return;
  }
  lab_->rewind_past(request.lanes.pass, request.lanes.settings.size());
  if (measure_anew() && request.lanes.reference) {
    lab_->rewind_past(0);  // the passes of before are to be measured too
  }
  replays_to_ = std::min(reached, request.lanes.pass);
  replaying_ = lab_->pass() < replays_to_;
  replay_start_ = Clock::now();
}

/// True errors are from now on as the current request has them. Returns whether that is another
/// reference or metric, so that those of before are forgotten.
bool LabWorker::measure_anew() {
  const LabRequest& request = current_->request;
  if (measured_against_ == request.lanes.reference && measured_in_ == request.lanes.metric) {
    return false;
  }
  measured_against_ = request.lanes.reference;
  measured_in_ = request.lanes.metric;
  lab_->forget_true_errors();
  return true;
}

/// Takes uniform sampling as far as the dearest lane, so that lanes are compared with what it
/// really gives for the same. False if it was stopped.
bool LabWorker::keep_up_baseline() {
  const std::size_t last = lab_->lanes().size() - 1;
  const Lane& baseline = lab_->lanes()[last];
  std::vector<PassRecord> ends;
  for (const Lane& lane : asked_lanes()) {
    if (lane.pass() > 0) {
      ends.push_back(lane.history().back());
    }
  }
  while (baseline.pass() > 0 && baseline.plan().total > 0 &&
         !is_enough(baseline.history().back(), ends)) {
    if (!lab_->run_pass_of(last, stop_.get_token())) {
      return false;
    }
    measure();
  }
  return true;
}

/// Writes true errors into the last record of every lane.
void LabWorker::measure() {
  const Metric& row = metric(measured_in_);
  lab_->measure([&](const Film& film) {
    const RadianceImage image = film.image();
    return TrueError{row.compute(image, *measured_against_),
                     energy_error(image, *measured_against_)};
  });
}

/// Runs passes until the current request is answered in full, which gives null, or a newer one has
/// to be taken up, which gives that.
std::unique_ptr<Mailbox::Numbered> LabWorker::answer() {
  while (!complete_) {
    if (mailbox_.closed()) {
      throw Closed();
    }
    if (gives_way()) {
      return mailbox_.take();
    }
    stop_ = std::stop_source();
    if (tracing_gives_way()) {
      stop_.request_stop();  // what is stored is replayed nevertheless
    }
    if (lab_->pass() < current_->request.lanes.pass) {
      board_.status.activity = replaying_ ? Activity::replaying : Activity::tracing;
      // True errors are of each pass, and want its picture.
      const bool skips = replaying_ && !measured_against_;
      if (!lab_->run_passes(skips ? replays_to_ : lab_->pass() + 1, stop_.get_token())) {
        return mailbox_.take();
      }
    }
    if (measured_against_) {
      measure();
      if (!keep_up_baseline()) {
        return mailbox_.take();
      }
    }
    board_.describe(*lab_);
    if (replaying_ && lab_->pass() >= replays_to_) {
      replaying_ = false;
      board_.status.replay_seconds =
          std::chrono::duration<double>(Clock::now() - replay_start_).count();
    }
    if (snapshot_is_due()) {
      publish_lanes();
    } else {
      report_progress();
    }
  }
  return nullptr;
}

void LabWorker::fail(const char* reason) {
  board_.status = {};
  board_.status.error = reason;
  lab_.reset();
  shown_.reset();
  current_.reset();
  owes_first_picture_ = false;
  answered_ = true;
  publish_status();
}

/// Whether a newer request is to be taken up between two passes.
bool LabWorker::gives_way() const {
  switch (mailbox_.waiting()) {
    case Mailbox::Waiting::nothing:
      return false;
    case Mailbox::Waiting::other_lanes:
      return answered_;
    case Mailbox::Waiting::other_store:
      return !owes_first_picture_;
  }
  return false;
}

/// Whether tracing is to end now for a newer request.
bool LabWorker::tracing_gives_way() const {
  if (owes_first_picture_ || mailbox_.waiting() == Mailbox::Waiting::nothing) {
    return false;
  }
  return mailbox_.waiting() == Mailbox::Waiting::other_store || answered_ ||
         Clock::now() >= patience_ends_;
}

/// The tracer, asked between batches whether it is still wanted.
SampleSource LabWorker::watched(SampleSource trace) {
  return [this, trace = std::move(trace)](std::span<SampleJob> jobs) {
    if (mailbox_.closed()) {
      throw Closed();
    }
    if (tracing_gives_way()) {
      stop_.request_stop();
    }
    trace(jobs);
    for (const SampleJob& job : jobs) {
      board_.meter.add(job.radiance.size());
    }
    if (std::this_thread::get_id() == thread_) {
      board_.status.activity = Activity::tracing;
      report_progress();
    }
  };
}

bool LabWorker::lanes_are_together() const {
  return std::ranges::all_of(asked_lanes(),
                             [&](const Lane& lane) { return lane.pass() == lab_->pass(); });
}

/// Whether a request without an end has come to one, because no lane wants another sample.
bool LabWorker::has_run_out() const {
  return current_->request.lanes.pass == LaneRequest::no_end &&
         std::ranges::all_of(asked_lanes(),
                             [](const Lane& lane) { return lane.plan().total == 0; });
}

std::span<const Lane> LabWorker::asked_lanes() const {
  return lab_->lanes().first(current_->request.lanes.settings.size());
}

bool LabWorker::snapshot_is_due() const {
  if (!lanes_are_together()) {
    return false;
  }
  if (!shown_ || lab_->pass() == current_->request.lanes.pass || has_run_out()) {
    return true;
  }
  const auto interval = lab_->pass() > shown_->pass ? snapshot_interval : replay_interval;
  return Clock::now() - published_at_ >= interval;
}

/// Whether what was published last, for a request before, is all that is asked for.
bool LabWorker::is_answered_by_shown() const {
  return shown_ && shown_lanes_ == current_->request.lanes;
}

void LabWorker::publish_lanes() {
  std::unique_ptr<Snapshot> snapshot = pool_->take();
  copy_lanes(*lab_, *snapshot, measured_against_ != nullptr);
  snapshot->metric = measured_in_;
  snapshot->scene = current_->request.store.scene;
  snapshot->settings = current_->request.store.settings;
  snapshot->reference = current_->request.lanes.reference;
  publish(std::move(snapshot));
}

/// The lanes may stand elsewhere by now; the request is answered all the same.
void LabWorker::publish_shown_again() {
  std::unique_ptr<Snapshot> snapshot = pool_->take();
  *snapshot = *shown_;
  publish(std::move(snapshot));
}

void LabWorker::publish(std::unique_ptr<Snapshot> snapshot) {
  snapshot->number = ++published_;
  snapshot->request = current_->number;
  shown_ = pool_->publish(std::move(snapshot));
  shown_lanes_ = current_->request.lanes;
  shown_lanes_.pass = shown_->pass;
  owes_first_picture_ = false;
  answered_ = true;
  complete_ = shown_->pass == current_->request.lanes.pass || has_run_out();
  published_at_ = Clock::now();
  if (complete_ && mailbox_.waiting() == Mailbox::Waiting::nothing) {
    board_.status.activity = Activity::idle;
  }
  // The status goes ahead, so that whoever sees the snapshot sees no older status.
  board_.publish();
  mailbox_.publish(shown_);
  notify();
}

void LabWorker::publish_status() {
  board_.publish();
  notify();
}

void LabWorker::notify() const {
  if (notify_) {
    notify_();
  }
}

void LabWorker::report_progress() {
  if (board_.is_due()) {
    publish_status();
  }
}

}  // namespace quartet
