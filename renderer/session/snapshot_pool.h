#pragma once

#include <array>
#include <memory>
#include <mutex>

#include "renderer/session/snapshot.h"

namespace quartet {

/// Snapshots whose memory is used again. Whoever lets go of a published snapshot last gives it back
/// here, so that neither the window nor the renderer frees and allocates megabytes at each picture.
/// Safe to use from many threads; lives until its last snapshot has come back.
class SnapshotPool : public std::enable_shared_from_this<SnapshotPool> {
 public:
  /// One to be overwritten, with whatever it held before.
  std::unique_ptr<Snapshot> take();
  /// The same snapshot for many readers.
  std::shared_ptr<const Snapshot> publish(std::unique_ptr<Snapshot> snapshot);
  /// Frees what waits to be used again.
  void clear();

 private:
  void give_back(std::unique_ptr<Snapshot> snapshot);

  // One is being read, one is waiting to be read, one is being written, and one to spare.
  static constexpr std::size_t capacity = 4;

  std::mutex mutex_;
  std::array<std::unique_ptr<Snapshot>, capacity> free_;
};

}  // namespace quartet
