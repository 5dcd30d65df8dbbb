#include "renderer/session/mailbox.h"

#include <gtest/gtest.h>

#include <functional>

namespace quartet {
namespace {

using Waiting = Mailbox::Waiting;

/// A request that can be told from others by its pass.
LabRequest request(std::uint32_t pass, std::uint64_t seed = 0) {
  LabRequest made;
  made.lanes.pass = pass;
  made.store.settings.seed = seed;
  return made;
}

TEST(Mailbox, OfSeveralRequestsTheNewestIsTaken) {
  Mailbox mailbox;
  EXPECT_EQ(mailbox.take(), nullptr);
  EXPECT_EQ(mailbox.submit(request(10)), 1u);
  EXPECT_EQ(mailbox.submit(request(20)), 2u);
  EXPECT_EQ(mailbox.submit(request(30)), 3u);
  const auto taken = mailbox.take();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->number, 3u);
  EXPECT_EQ(taken->request.lanes.pass, 30u);
  EXPECT_EQ(mailbox.take(), nullptr) << "the others are dropped";

  EXPECT_EQ(mailbox.submit(request(40)), 4u);
  EXPECT_EQ(mailbox.submit(request(50)), 5u);
  const auto waited = mailbox.wait_and_take();
  ASSERT_TRUE(waited);
  EXPECT_EQ(waited->number, 5u);
  EXPECT_EQ(waited->request.lanes.pass, 50u);
}

TEST(Mailbox, SaysWhatTheWaitingRequestsNeed) {
  Mailbox mailbox;
  EXPECT_EQ(mailbox.waiting(), Waiting::nothing);
  EXPECT_FALSE(mailbox.busy());
  mailbox.submit(request(1));
  EXPECT_EQ(mailbox.waiting(), Waiting::other_store) << "the first one has none";
  EXPECT_TRUE(mailbox.busy());
  mailbox.take();
  EXPECT_EQ(mailbox.waiting(), Waiting::nothing);
  EXPECT_FALSE(mailbox.busy());
  mailbox.submit(request(2));
  EXPECT_EQ(mailbox.waiting(), Waiting::other_lanes);
  mailbox.submit(request(2, 1));
  EXPECT_EQ(mailbox.waiting(), Waiting::other_store);
  mailbox.submit(request(3, 1));
  EXPECT_EQ(mailbox.waiting(), Waiting::other_store) << "the store of the one before is not there";
  mailbox.wait_and_take();
  EXPECT_EQ(mailbox.waiting(), Waiting::nothing);
}

/// What the mailbox says of a request that differs from the one before it by a change.
Waiting after(const std::function<void(LabRequest&)>& change) {
  Mailbox mailbox;
  LabRequest changed = request(3);
  mailbox.submit(changed);
  mailbox.take();
  change(changed);
  mailbox.submit(changed);
  return mailbox.waiting();
}

TEST(Mailbox, OnlyOtherSamplesOrAnotherWayToKeepThemNeedAnotherStore) {
  const auto scene = std::make_shared<const TraceScene>(Scene());
  EXPECT_EQ(after([&](LabRequest& r) { r.store.scene = scene; }), Waiting::other_store);
  EXPECT_EQ(after([](LabRequest& r) { r.store.settings.max_depth = 3; }), Waiting::other_store);
  EXPECT_EQ(after([](LabRequest& r) { r.store.memory /= 2; }), Waiting::other_store);
  EXPECT_EQ(after([](LabRequest& r) { r.store.threads = 7; }), Waiting::other_store);

  const auto truth = std::make_shared<const RadianceImage>(1, 1);
  EXPECT_EQ(after([](LabRequest& r) { r.lanes.settings.resize(2); }), Waiting::other_lanes);
  EXPECT_EQ(after([](LabRequest& r) { r.lanes.pass = 1; }), Waiting::other_lanes);
  EXPECT_EQ(after([](LabRequest& r) { r.lanes.variance = true; }), Waiting::other_lanes);
  EXPECT_EQ(after([&](LabRequest& r) { r.lanes.reference = truth; }), Waiting::other_lanes);
  EXPECT_EQ(after([](LabRequest& r) { r.lanes.metric = MetricId::flip; }), Waiting::other_lanes);
  EXPECT_EQ(after([](LabRequest&) {}), Waiting::other_lanes);
}

TEST(Mailbox, BringsUpTheLatestOfEach) {
  Mailbox mailbox;
  EXPECT_EQ(mailbox.latest(), nullptr);
  EXPECT_EQ(mailbox.status(), nullptr);
  const auto first = std::make_shared<const Snapshot>();
  const auto second = std::make_shared<const Snapshot>();
  mailbox.publish(first);
  mailbox.publish(second);
  EXPECT_EQ(mailbox.latest(), second);
  const auto status = std::make_shared<const SessionStatus>();
  mailbox.publish(std::make_shared<const SessionStatus>());
  mailbox.publish(status);
  EXPECT_EQ(mailbox.status(), status);
  mailbox.set_working(true);
  EXPECT_TRUE(mailbox.busy());
}

TEST(Mailbox, OnceClosedNothingIsTaken) {
  Mailbox mailbox;
  mailbox.submit(request(1));
  EXPECT_FALSE(mailbox.closed());
  mailbox.close();
  EXPECT_TRUE(mailbox.closed());
  EXPECT_EQ(mailbox.wait_and_take(), nullptr);
}

}  // namespace
}  // namespace quartet
