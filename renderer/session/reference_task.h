#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "renderer/measure/reference/reference.h"
#include "renderer/session/background_task.h"

namespace quartet {

/// What a window asks of the ground truth.
struct ReferenceRequest {
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;     ///< of the experiment that is to be judged
  std::filesystem::path file;  ///< to load; empty: what the cache holds
  std::uint64_t spp = 0;       ///< to compute, at least, onto what the cache holds
  std::string layer = {};      ///< of the file, an EXR with several of colour
};

/// Whether a reference of the one shows what a run of the other does.
bool same_view(const ReferenceRequest& a, const ReferenceRequest& b);

/// What has become of it.
struct ReferenceStatus {
  enum class Activity { idle, loading, computing };

  Activity activity = Activity::idle;
  bool waits = false;         ///< computing, but gives way to other work just now
  std::uint64_t spp = 0;      ///< computing: so far
  std::uint64_t target = 0;   ///< and in the end
  double seconds_left = 0.0;  ///< of work, at the pace of late; 0 if unknown
  std::string error;          ///< what did not work, in one line; empty if all is well
  /// Matches scene and settings of the request; null while there is none.
  std::shared_ptr<const Reference> reference;
};

/// References beside the window: loads them, finds them in the cache, computes them and caches
/// them.
using ReferenceTask = BackgroundTask<ReferenceRequest, ReferenceStatus>;

/// The work of such a task. It computes while nobody is `busy`, which it asks often from several
/// threads, and leaves one processor to the window. From 32 samples a pixel on it publishes and
/// caches what there is at each doubling. A file that is refused leaves the reference of before.
/// `cache` is a folder, made if need be; empty: nothing is cached.
ReferenceTask::Work reference_work(std::filesystem::path cache, std::function<bool()> busy);

}  // namespace quartet
