#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <thread>
#include <utility>

#include "renderer/base/latest.h"
#include "renderer/base/request_slot.h"

namespace quartet {

/// Work on a thread of its own, done anew for each input. The newest input wins: it stops the work
/// under way. Calls may come from any thread and never wait for the work.
template <class Input, class Output>
class BackgroundTask {
 public:
  struct Answer {
    std::uint64_t input = 0;  ///< whose it is, as numbered by submit; 0 before the first
    Output output;
  };

  /// Shows what there is so far, once or often.
  using Publish = std::function<void(Output)>;
  /// Runs on the thread; must return soon once stop is requested, and must not throw.
  using Work = std::function<void(const Input&, const std::stop_token& stop, const Publish&)>;

  /// `notify` is called on the thread after each publication and must not throw.
  explicit BackgroundTask(Work work, std::function<void()> notify = {})
      : work_(std::move(work)), notify_(std::move(notify)), thread_([this] { run(); }) {}

  /// Waits for the work under way, which was asked to stop.
  ~BackgroundTask() {
    close();
    thread_.join();
  }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Returns the input's number, from 1.
  std::uint64_t submit(Input input) {
    std::stop_source under_way(std::nostopstate);
    const std::uint64_t number = inputs_.put(std::move(input), [&] { under_way = stop_; });
    under_way.request_stop();
    return number;
  }

  /// Asks the work under way to stop; no other is begun. So several tasks can end at the same time.
  void close() {
    std::stop_source under_way(std::nostopstate);
    inputs_.close([&] { under_way = stop_; });
    under_way.request_stop();
  }

  /// Never null.
  std::shared_ptr<const Answer> latest() const { return latest_.get(); }

 private:
  using Numbered = typename RequestSlot<Input>::Numbered;

  void run() {
    for (;;) {
      std::stop_source own;
      const std::stop_token stop = own.get_token();
      const std::unique_ptr<Numbered> taken = inputs_.wait_and_take([&] { stop_.swap(own); });
      if (!taken) {
        return;
      }
      work_(taken->request, stop,
            [&](Output output) { publish(taken->number, std::move(output)); });
    }
  }

  void publish(std::uint64_t number, Output output) {
    latest_.publish(std::make_shared<const Answer>(Answer{number, std::move(output)}));
    if (notify_) {
      notify_();
    }
  }

  Work work_;
  std::function<void()> notify_;
  RequestSlot<Input> inputs_;
  std::stop_source stop_;  // of the work under way; under the lock of the inputs
  Latest<Answer> latest_{std::make_shared<const Answer>()};
  std::thread thread_;  // last: it uses all the others
};

}  // namespace quartet
