#include "renderer/session/snapshot_pool.h"

#include <utility>

namespace quartet {

std::unique_ptr<Snapshot> SnapshotPool::take() {
  {
    const std::lock_guard lock(mutex_);
    for (std::unique_ptr<Snapshot>& each : free_) {
      if (each) {
        return std::move(each);
      }
    }
  }
  return std::make_unique<Snapshot>();
}

std::shared_ptr<const Snapshot> SnapshotPool::publish(std::unique_ptr<Snapshot> snapshot) {
  return {snapshot.release(), [pool = shared_from_this()](Snapshot* returned) {
            pool->give_back(std::unique_ptr<Snapshot>(returned));
          }};
}

void SnapshotPool::give_back(std::unique_ptr<Snapshot> snapshot) {
  const std::lock_guard lock(mutex_);
  for (std::unique_ptr<Snapshot>& each : free_) {
    if (!each) {
      each = std::move(snapshot);
      return;
    }
  }
  // Where there is no room it is freed by the caller's argument, after the lock has gone.
}

void SnapshotPool::clear() {
  std::array<std::unique_ptr<Snapshot>, capacity> freed;
  const std::lock_guard lock(mutex_);
  freed.swap(free_);
}

}  // namespace quartet
