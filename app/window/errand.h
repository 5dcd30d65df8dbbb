#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "renderer/base/cancel.h"
#include "renderer/session/background_task.h"

namespace quartet {

/// Work beside the window, of which one result is wanted: the newest order ends the one before, and
/// its result is handed out once. To be used from one thread.
template <class Order, class Result>
class Errand {
 public:
  /// Runs on a thread of its own. Throws Cancelled soon once a stop is asked for, and nothing else.
  using Work = std::function<Result(const Order& order, const std::stop_token& stop)>;

  /// `wake` is called, on another thread, when there is a result.
  Errand(Work work, std::function<void()> wake)
      : task_(
            [work = std::move(work)](const std::optional<Order>& order, const std::stop_token& stop,
                                     const typename Task::Publish& publish) {
              if (!order) {
                return;
              }
              try {
                publish(work(*order, stop));
              } catch (const Cancelled&) {
                // Another is wanted, or none.
              }
            },
            std::move(wake)) {}

  void order(Order order) { asked_ = task_.submit(std::move(order)); }

  /// Nothing is wanted any more.
  void cancel() {
    task_.submit(std::nullopt);
    asked_ = 0;
  }

  bool busy() const { return asked_ != 0; }

  /// The result of the newest order, once.
  std::optional<Result> poll() {
    if (!busy()) {
      return std::nullopt;
    }
    const std::shared_ptr<const typename Task::Answer> latest = task_.latest();
    if (latest->input != asked_) {
      return std::nullopt;
    }
    asked_ = 0;
    return latest->output;
  }

  /// Asks what is under way to end, without waiting.
  void close() { task_.close(); }

 private:
  using Task = BackgroundTask<std::optional<Order>, Result>;

  std::uint64_t asked_ = 0;  // 0: nothing
  Task task_;
};

}  // namespace quartet
