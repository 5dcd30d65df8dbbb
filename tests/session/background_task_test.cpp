#include "renderer/session/background_task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "tests/wait_until.h"

namespace quartet {
namespace {

using std::chrono::milliseconds;
using test::wait_until;
using Task = BackgroundTask<int, int>;

TEST(BackgroundTaskThreads, AnswersWhatItIsAsked) {
  std::atomic<int> notified = 0;
  Task task(
      [](int input, const std::stop_token&, const Task::Publish& publish) {
        publish(10 * input);
        publish(100 * input);
      },
      [&] { ++notified; });
  EXPECT_EQ(task.latest()->input, 0u);
  for (int input = 1; input <= 3; ++input) {
    const std::uint64_t number = task.submit(input);
    EXPECT_EQ(number, std::uint64_t(input));
    ASSERT_TRUE(wait_until(
        [&] { return task.latest()->input == number && task.latest()->output == 100 * input; }));
  }
  ASSERT_TRUE(wait_until([&] { return notified == 6; }));
}

TEST(BackgroundTaskThreads, TheNewestInputStopsTheOneUnderWayAndIsAnswered) {
  std::atomic<int> begun = 0;
  Task task([&](int input, const std::stop_token& stop, const Task::Publish& publish) {
    ++begun;
    while (input < 1000 && !stop.stop_requested()) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    if (!stop.stop_requested()) {
      publish(input);
    }
  });
  task.submit(0);
  ASSERT_TRUE(wait_until([&] { return begun == 1; }));
  std::uint64_t last = 0;
  for (int i = 1; i <= 1000; ++i) {
    last = task.submit(i);
  }
  ASSERT_TRUE(wait_until([&] { return task.latest()->input == last; }));
  EXPECT_EQ(task.latest()->output, 1000);
}

TEST(BackgroundTaskThreads, WhatTheStopCallsMayUseTheTask) {
  std::atomic<bool> begun = false;
  Task task([&](int input, const std::stop_token& stop, const Task::Publish& publish) {
    const std::stop_callback look(stop, [&] { task.latest(); });
    begun = true;
    while (input == 0 && !stop.stop_requested()) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    publish(input);
  });
  task.submit(0);
  ASSERT_TRUE(wait_until([&] { return begun.load(); }));
  const std::uint64_t last = task.submit(1);
  ASSERT_TRUE(wait_until([&] { return task.latest()->input == last; }));
}

TEST(BackgroundTaskThreads, EndsInTheMiddleOfWork) {
  for (int moment = 0; moment < 20; ++moment) {
    Task task([&](int, const std::stop_token& stop, const Task::Publish& publish) {
      for (int i = 0; !stop.stop_requested(); ++i) {
        publish(i);
      }
    });
    task.submit(moment);
    std::this_thread::sleep_for(std::chrono::microseconds(200 * moment));
  }
}

}  // namespace
}  // namespace quartet
