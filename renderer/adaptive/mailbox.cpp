#include "renderer/adaptive/mailbox.h"

#include <algorithm>
#include <utility>

namespace quartet {

std::uint64_t Mailbox::submit(LabRequest request) {
  StoreRequest store = request.store;
  auto newest = std::make_unique<Numbered>(Numbered{0, std::move(request)});
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = newest->number = ++submitted_;
    const Waiting kind = store == newest_store_ ? Waiting::other_lanes : Waiting::other_store;
    std::swap(newest_store_, store);
    waiting_.store(std::max(kind, waiting()), std::memory_order_relaxed);
    request_.swap(newest);
  }
  arrived_.notify_one();
  return number;
}

std::shared_ptr<const Snapshot> Mailbox::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

std::shared_ptr<const SessionStatus> Mailbox::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Mailbox::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_.store(true, std::memory_order_relaxed);
  }
  arrived_.notify_one();
}

std::unique_ptr<Mailbox::Numbered> Mailbox::take() {
  const std::lock_guard lock(mutex_);
  waiting_.store(Waiting::nothing, std::memory_order_relaxed);
  return std::move(request_);
}

std::unique_ptr<Mailbox::Numbered> Mailbox::wait_and_take() {
  std::unique_lock lock(mutex_);
  arrived_.wait(lock, [this] { return request_ || closed(); });
  waiting_.store(Waiting::nothing, std::memory_order_relaxed);
  return closed() ? nullptr : std::move(request_);
}

void Mailbox::publish(std::shared_ptr<const Snapshot> snapshot) {
  const std::lock_guard lock(mutex_);
  latest_.swap(snapshot);
  // The one before goes with the argument, after the lock.
}

void Mailbox::publish(std::shared_ptr<const SessionStatus> status) {
  const std::lock_guard lock(mutex_);
  status_.swap(status);
}

}  // namespace quartet
