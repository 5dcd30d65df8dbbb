#include "renderer/session/equalise_task.h"

#include <fmt/format.h>

#include <optional>

namespace quartet {
namespace {

/// What is kept between two requests, used on the task's thread alone.
struct Bench {
  EqualiseRequest made_for;
  std::unique_ptr<Experiment> experiment;

  Experiment& prepare(const EqualiseRequest& request) {
    if (!experiment || made_for.store != request.store || made_for.reference != request.reference) {
      experiment.reset();
      LabOptions options;
      options.threads = request.store.threads;
      options.memory = request.store.memory;
      const RenderSettings& settings = request.store.settings;
      options.sampler = settings.sampler;
      experiment =
          std::make_unique<Experiment>(sample_source(request.store.scene, settings), settings.width,
                                       settings.height, options, request.reference);
      made_for = request;
    }
    return *experiment;
  }
};

void answer(Bench& bench, const EqualiseRequest& request, const std::stop_token& stop,
            const EqualiseTask::Publish& publish) {
  EqualiseStatus status;
  status.lanes = request.lane_settings.size();
  publish(status);
  try {
    for (std::size_t i = 0; request.store.scene && i < request.lane_settings.size(); ++i) {
      std::optional<Calibration> found =
          calibrate(bench.prepare(request), request.lane_settings[i], request.budget, stop);
      if (!found) {
        return;
      }
      status.calibrations.push_back(std::move(*found));
      publish(status);
    }
  } catch (const std::exception& error) {
    status.error = error.what();
  }
  status.done = true;
  publish(std::move(status));
}

}  // namespace

EqualiseTask::Work equalise_work() {
  return [bench = std::make_shared<Bench>()](
             const EqualiseRequest& request, const std::stop_token& stop,
             const EqualiseTask::Publish& publish) { answer(*bench, request, stop, publish); };
}

std::string equalise_text(const EqualiseRequest& request, const EqualiseStatus& status) {
  if (!status.error.empty()) {
    return fmt::format("lanes not equalised: {}", status.error);
  }
  std::string text = fmt::format("lanes equalised to {}", request.budget.text());
  for (std::size_t i = 0; i < status.calibrations.size(); ++i) {
    const Calibration& each = status.calibrations[i];
    if (!each.met) {
      text += fmt::format("; not lane {}: {}", i + 1, each.reason);
    } else if (!each.note.empty()) {
      text += fmt::format("; lane {} is {}", i + 1, each.note);
    }
  }
  return text;
}

}  // namespace quartet
