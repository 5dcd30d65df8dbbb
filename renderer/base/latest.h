#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace quartet {

/// The latest of what one thread makes, to be looked at by others. Safe to use from many threads;
/// the lock guards moves of a pointer, and nothing is freed under it.
template <class T>
class Latest {
 public:
  explicit Latest(std::shared_ptr<const T> first = nullptr) : latest_(std::move(first)) {}

  std::shared_ptr<const T> get() const {
    const std::lock_guard lock(mutex_);
    return latest_;
  }

  void publish(std::shared_ptr<const T> latest) {
    const std::lock_guard lock(mutex_);
    latest_.swap(latest);
    // The one before goes with the argument, after the lock.
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> latest_;
};

}  // namespace quartet
