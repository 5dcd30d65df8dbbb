#include "renderer/session/reference_task.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/base/stopwatch.h"
#include "renderer/files/staged_files.h"
#include "renderer/measure/reference/reference_cache.h"
#include "renderer/measure/reference/reference_render.h"

namespace quartet {
namespace {

using Clock = std::chrono::steady_clock;
using Activity = ReferenceStatus::Activity;

constexpr std::uint64_t first_shown_spp = 32;
constexpr std::uint32_t pass_spp = 2;  // one a half
constexpr auto status_interval = std::chrono::milliseconds(250);

/// A reference in the making.
struct Making {
  ReferenceRender render;
  std::filesystem::path file;    ///< in the cache; empty without one
  std::uint64_t cached_spp = 0;  ///< that were put there, or could not be
  std::uint64_t file_spp = 0;    ///< that are there
};

/// What is kept between two requests, used on the task's thread alone.
class Shelf {
 public:
  Shelf(std::filesystem::path cache, std::function<bool()> busy)
      : cache_(std::move(cache)),
        busy_(std::move(busy)),
        arena_(std::max(1, tbb::this_task_arena::max_concurrency() - 1)) {}

  void answer(const ReferenceRequest& request, const std::stop_token& stop,
              const ReferenceTask::Publish& publish);

 private:
  void load(const ReferenceRequest& request, const std::stop_token& stop);
  void prepare(const ReferenceRequest& request, const std::stop_token& stop);
  std::optional<ReferenceSums> cached(const std::filesystem::path& file,
                                      const std::stop_token& stop);
  void show(const ReferenceRequest& request);
  void compute(const ReferenceRequest& request, const std::stop_token& stop,
               const ReferenceTask::Publish& publish);
  bool add_pass(const std::stop_token& stop);
  void save();

  std::filesystem::path cache_;
  std::function<bool()> busy_;
  tbb::task_arena arena_;
  ReferenceRequest shown_;          // what `status_.reference` was asked for
  std::unique_ptr<Making> making_;  // of scene and settings of `made_`
  ReferenceRequest made_;
  ReferenceStatus status_;
};

void Shelf::answer(const ReferenceRequest& request, const std::stop_token& stop,
                   const ReferenceTask::Publish& publish) {
  std::shared_ptr<const Reference> kept = same_view(request, shown_) ? status_.reference : nullptr;
  status_ = {};
  status_.reference = std::move(kept);
  shown_ = request;
  if (!request.scene) {
    publish(status_);
    return;
  }
  try {
    save();  // what the request before has stopped
    if (!request.file.empty()) {
      status_.activity = Activity::loading;
      publish(status_);
      load(request, stop);
    } else {
      prepare(request, stop);
      if (making_) {
        compute(request, stop, publish);
      }
    }
  } catch (const Cancelled&) {
    // Another request waits, or nobody does.
  } catch (const std::exception& error) {
    status_.error = error.what();
  }
  status_.activity = Activity::idle;
  status_.waits = false;
  publish(status_);
}

void Shelf::load(const ReferenceRequest& request, const std::stop_token& stop) {
  std::shared_ptr<const Reference> loaded =
      load_reference(request.file, {request.layer, "--reference-layer"}, stop);
  check_reference(*loaded, request.scene->scene(), request.settings);
  status_.reference = std::move(loaded);
}

/// What a file of the cache holds; nothing, and a word to the user, if it is damaged.
std::optional<ReferenceSums> Shelf::cached(const std::filesystem::path& file,
                                           const std::stop_token& stop) {
  std::error_code ignored;
  if (file.empty() || !std::filesystem::exists(file, ignored)) {
    return std::nullopt;
  }
  try {
    return sums_of(read_exr(file, stop), file);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::runtime_error& error) {
    status_.error = fmt::format("not used, and made again when asked for: {}", error.what());
    return std::nullopt;
  }
}

/// Takes up what was computed for this view before, in this run of the program or another.
void Shelf::prepare(const ReferenceRequest& request, const std::stop_token& stop) {
  const bool same_integrator = made_.settings.integrator == request.settings.integrator;
  if (!making_ || !same_view(made_, request) || !same_integrator) {
    making_.reset();
    const RenderSettings settings = reference_settings(request.scene->scene(), request.settings);
    std::filesystem::path file;
    if (!cache_.empty()) {
      file = cached_reference_path(cache_, request.scene->scene(), settings);
    }
    std::optional<ReferenceSums> sums = cached(file, stop);
    if (!sums && request.spp == 0) {
      return;
    }
    auto making =
        std::make_unique<Making>(Making{ReferenceRender(request.scene, settings), file, 0});
    if (sums) {
      making->render.resume(std::move(*sums), file);
      making->cached_spp = making->render.sums().spp;
      making->file_spp = making->cached_spp;
    }
    making_ = std::move(making);
    made_ = request;
  }
  if (making_->render.sums().spp > (status_.reference ? status_.reference->spp : 0)) {
    show(request);
  }
}

void Shelf::show(const ReferenceRequest& request) {
  auto made = std::make_shared<Reference>(reference_of(making_->render.sums()));
  if (making_->file_spp == made->spp) {
    made->path = making_->file;
  }
  check_reference(*made, request.scene->scene(), request.settings);
  status_.reference = std::move(made);
}

/// One pass over all pixels; false if it gave way, and nothing came of it.
bool Shelf::add_pass(const std::stop_token& stop) {
  bool whole = false;
  arena_.execute([&] {
    whole = making_->render.add(pass_spp, [&] { return stop.stop_requested() || busy_(); });
  });
  return whole;
}

void Shelf::compute(const ReferenceRequest& request, const std::stop_token& stop,
                    const ReferenceTask::Publish& publish) {
  const ReferenceSums& sums = making_->render.sums();
  status_.activity = Activity::computing;
  status_.target = request.spp;
  Clock::time_point published = {};
  double seconds_a_sample = 0.0;
  while (sums.spp < request.spp && !stop.stop_requested()) {
    const Stopwatch watch;
    status_.waits = busy_() || !add_pass(stop);
    if (status_.waits) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    } else {
      const double now = watch.seconds() / pass_spp;
      seconds_a_sample = seconds_a_sample > 0.0 ? 0.9 * seconds_a_sample + 0.1 * now : now;
      status_.seconds_left =
          seconds_a_sample * double(request.spp - std::min(request.spp, sums.spp));
      const bool enough = sums.spp >= request.spp;
      const std::uint64_t last = status_.reference ? status_.reference->spp : 0;
      if (enough || sums.spp >= std::max(first_shown_spp, 2 * last)) {
        save();
        show(request);  // knows the file that it is in
        published = {};
      }
    }
    status_.spp = sums.spp;
    if (Clock::now() - published >= status_interval) {
      published = Clock::now();
      publish(status_);
    }
  }
}

/// Into the cache, if there is more than the cache has. Without one it can be used all the same.
void Shelf::save() {
  if (!making_ || making_->file.empty() || making_->render.sums().spp < first_shown_spp ||
      making_->render.sums().spp <= making_->cached_spp) {
    return;
  }
  making_->cached_spp = making_->render.sums().spp;  // not tried again and again on a full disk
  try {
    StagedFiles files(making_->file.parent_path());
    write_exr(files.stage(making_->file.filename().string()),
              exr_of(making_->render.sums(), "quartet"));
    const bool kept = files.commit([&] {
      return samples_in(making_->file, making_->render.sums()) <= making_->render.sums().spp;
    });
    making_->file_spp = kept ? making_->cached_spp : 0;  // else another program's is there
  } catch (const std::exception& error) {
    status_.error = fmt::format("the reference is not cached: {}", error.what());
  }
}

}  // namespace

bool same_view(const ReferenceRequest& a, const ReferenceRequest& b) {
  RenderSettings settings = a.settings;
  settings.seed = b.settings.seed;
  settings.integrator = b.settings.integrator;
  settings.sampler = b.settings.sampler;
  return a.scene == b.scene && settings == b.settings;
}

ReferenceTask::Work reference_work(std::filesystem::path cache, std::function<bool()> busy) {
  return [shelf = std::make_shared<Shelf>(std::move(cache), std::move(busy))](
             const ReferenceRequest& request, const std::stop_token& stop,
             const ReferenceTask::Publish& publish) { shelf->answer(request, stop, publish); };
}

}  // namespace quartet
