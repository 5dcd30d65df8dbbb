#include "renderer/base/request_slot.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <future>
#include <thread>
#include <vector>

#include "renderer/base/latest.h"

namespace quartet {
namespace {

TEST(RequestSlot, OnlyTheNewestIsTakenUnderItsNumber) {
  RequestSlot<int> slot;
  EXPECT_EQ(slot.take(), nullptr);
  EXPECT_EQ(slot.put(10), 1u);
  EXPECT_EQ(slot.put(20), 2u);
  const auto taken = slot.take();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->number, 2u);
  EXPECT_EQ(taken->request, 20);
  EXPECT_EQ(slot.take(), nullptr) << "the one before is dropped";
  EXPECT_EQ(slot.put(30), 3u) << "numbers go on";
  const auto waited = slot.wait_and_take();
  ASSERT_TRUE(waited);
  EXPECT_EQ(waited->number, 3u);
  EXPECT_EQ(waited->request, 30);
}

TEST(RequestSlot, OnceClosedNothingIsWaitedFor) {
  RequestSlot<int> slot;
  slot.put(1);
  EXPECT_FALSE(slot.closed());
  slot.close();
  EXPECT_TRUE(slot.closed());
  EXPECT_EQ(slot.wait_and_take(), nullptr);
  EXPECT_EQ(slot.put(2), 2u);
  EXPECT_EQ(slot.wait_and_take(), nullptr);
}

TEST(RequestSlot, CallsBackOnceInEachCall) {
  RequestSlot<int> slot;
  int calls = 0;
  const auto count = [&] { ++calls; };
  slot.put(1, count);
  EXPECT_EQ(calls, 1);
  slot.take(count);
  EXPECT_EQ(calls, 2);
  slot.put(2);
  slot.wait_and_take(count);
  EXPECT_EQ(calls, 3);
  slot.close(count);
  EXPECT_EQ(calls, 4);
  slot.wait_and_take(count);
  EXPECT_EQ(calls, 5);
}

/// Where it is freed, another thread uses what it was in, and gets through if no lock is held.
class Probe {
 public:
  Probe(std::function<void()> use, std::vector<std::future<void>>& uses)
      : use_(std::move(use)), uses_(uses) {}
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;
  ~Probe() {
    // Kept until the end: one that does not get through must not be waited for here.
    uses_.push_back(std::async(std::launch::async, use_));
    EXPECT_EQ(uses_.back().wait_for(std::chrono::seconds(10)), std::future_status::ready)
        << "freed under a lock";
  }

 private:
  std::function<void()> use_;
  std::vector<std::future<void>>& uses_;
};

TEST(RequestSlotThreads, FreesNothingUnderItsLock) {
  std::vector<std::future<void>> uses;
  RequestSlot<std::unique_ptr<Probe>> slot;
  const auto probe = [&] { return std::make_unique<Probe>([&] { slot.close(); }, uses); };
  slot.put(probe());
  slot.put(probe());
  EXPECT_EQ(uses.size(), 1u) << "the one that was replaced";
  slot.take();
  EXPECT_EQ(uses.size(), 2u);
}

TEST(RequestSlotThreads, ManyPutAndOneTakesTheLast) {
  constexpr int threads = 4;
  constexpr std::uint64_t each = 2000;
  RequestSlot<int> slot;
  std::uint64_t put = 0;  // under the slot's lock
  std::uint64_t newest = 0;
  std::thread taker([&] {
    while (const auto taken = slot.wait_and_take()) {
      EXPECT_GT(taken->number, newest);
      newest = taken->number;
      if (newest == threads * each) {
        return;
      }
    }
  });
  std::vector<std::thread> putters;
  putters.reserve(threads);
  for (int thread = 0; thread < threads; ++thread) {
    putters.emplace_back([&, thread] {
      std::uint64_t before = 0;
      for (std::uint64_t i = 0; i < each; ++i) {
        const std::uint64_t number = slot.put(thread, [&] { ++put; });
        EXPECT_GT(number, before);
        before = number;
      }
    });
  }
  for (std::thread& putter : putters) {
    putter.join();
  }
  taker.join();
  EXPECT_EQ(newest, threads * each);
  EXPECT_EQ(put, threads * each);
}

TEST(RequestSlotThreads, ClosingWakesWhoeverWaits) {
  RequestSlot<int> slot;
  const auto wait = [&] { return slot.wait_and_take() == nullptr; };
  std::future<bool> one = std::async(std::launch::async, wait);
  std::future<bool> other = std::async(std::launch::async, wait);
  slot.close();
  EXPECT_TRUE(one.get());
  EXPECT_TRUE(other.get());
}

TEST(LatestThreads, ShowsTheLatestAndFreesNothingUnderItsLock) {
  std::vector<std::future<void>> uses;
  Latest<Probe> latest;
  EXPECT_EQ(latest.get(), nullptr);
  const auto probe = [&] { return std::make_shared<const Probe>([&] { latest.get(); }, uses); };
  latest.publish(probe());
  const auto second = probe();
  latest.publish(second);
  EXPECT_EQ(uses.size(), 1u) << "the one before";
  EXPECT_EQ(latest.get(), second);
  latest.publish(nullptr);
  EXPECT_EQ(latest.get(), nullptr);
}

}  // namespace
}  // namespace quartet
