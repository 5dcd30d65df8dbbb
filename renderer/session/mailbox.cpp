#include "renderer/session/mailbox.h"

#include <algorithm>
#include <utility>

namespace quartet {

std::uint64_t Mailbox::submit(LabRequest request) {
  std::optional<StoreRequest> store = request.store;
  return requests_.put(std::move(request), [&] {
    const Waiting kind = store == newest_store_ ? Waiting::other_lanes : Waiting::other_store;
    std::swap(newest_store_, store);
    waiting_.store(std::max(kind, waiting()), std::memory_order_relaxed);
  });
}

std::unique_ptr<Mailbox::Numbered> Mailbox::take() {
  return requests_.take([this] { waiting_.store(Waiting::nothing, std::memory_order_relaxed); });
}

std::unique_ptr<Mailbox::Numbered> Mailbox::wait_and_take() {
  return requests_.wait_and_take(
      [this] { waiting_.store(Waiting::nothing, std::memory_order_relaxed); });
}

}  // namespace quartet
