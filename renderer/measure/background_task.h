#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

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
    std::optional<Input> old(std::move(input));
    std::uint64_t number = 0;
    {
      const std::lock_guard lock(mutex_);
      number = ++submitted_;
      waiting_.swap(old);
      stop_.request_stop();
    }
    arrived_.notify_one();
    return number;
  }

  /// Asks the work under way to stop; no other is begun. So several tasks can end at the same time.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
      stop_.request_stop();
    }
    arrived_.notify_one();
  }

  /// Never null.
  std::shared_ptr<const Answer> latest() const {
    const std::lock_guard lock(mutex_);
    return latest_;
  }

 private:
  void run() {
    for (;;) {
      std::optional<Input> input;
      std::stop_token stop;
      std::uint64_t number = 0;
      {
        std::unique_lock lock(mutex_);
        arrived_.wait(lock, [this] { return closed_ || waiting_; });
        if (closed_) {
          return;
        }
        input.swap(waiting_);
        number = submitted_;
        stop_ = std::stop_source();
        stop = stop_.get_token();
      }
      work_(*input, stop, [&](Output output) { publish(number, std::move(output)); });
    }
  }

  void publish(std::uint64_t number, Output output) {
    std::shared_ptr<const Answer> answer =
        std::make_shared<const Answer>(Answer{number, std::move(output)});
    {
      const std::lock_guard lock(mutex_);
      latest_.swap(answer);
    }
    // The answer before goes with the pointer, after the lock.
    if (notify_) {
      notify_();
    }
  }

  Work work_;
  std::function<void()> notify_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<Input> waiting_;
  std::uint64_t submitted_ = 0;
  std::shared_ptr<const Answer> latest_ = std::make_shared<const Answer>();
  std::stop_source stop_;
  bool closed_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace quartet
