#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace quartet {

/// A place where a request waits to be taken, and only the newest counts: one that is put replaces
/// one that waits. Safe to use from many threads.
///
/// The lock guards moves of a pointer and a number: requests are made ready before it is taken, and
/// what is replaced is freed after it is released. So no call but wait_and_take waits for anything.
/// `locked`, where it is given, is called once under the lock, and what it changes changes together
/// with the slot: it must neither allocate nor free, nor call the slot.
template <class Request>
class RequestSlot {
 public:
  struct Numbered {
    std::uint64_t number;
    Request request;
  };

  struct Nothing {
    void operator()() const {}
  };

  /// Returns the request's number: from 1, in the order in which they were put.
  template <class Locked = Nothing>
  std::uint64_t put(Request request, const Locked& locked = {}) {
    auto newest = std::make_unique<Numbered>(Numbered{0, std::move(request)});
    std::uint64_t number = 0;
    {
      const std::lock_guard lock(mutex_);
      number = newest->number = ++count_;
      waiting_.swap(newest);
      locked();
    }
    arrived_.notify_one();
    return number;
  }

  /// Wakes whoever waits; from now on no one does.
  template <class Locked = Nothing>
  void close(const Locked& locked = {}) {
    {
      const std::lock_guard lock(mutex_);
      closed_.store(true, std::memory_order_relaxed);
      locked();
    }
    arrived_.notify_all();
  }

  bool closed() const { return closed_.load(std::memory_order_relaxed); }

  /// The request that waits; null if there is none.
  template <class Locked = Nothing>
  std::unique_ptr<Numbered> take(const Locked& locked = {}) {
    const std::lock_guard lock(mutex_);
    locked();
    return std::move(waiting_);
  }

  /// Sleeps until there is one; null once closed.
  template <class Locked = Nothing>
  std::unique_ptr<Numbered> wait_and_take(const Locked& locked = {}) {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, [this] { return waiting_ || closed(); });
    locked();
    return closed() ? nullptr : std::move(waiting_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::unique_ptr<Numbered> waiting_;
  std::uint64_t count_ = 0;
  std::atomic<bool> closed_ = false;
};

}  // namespace quartet
