#include <gtest/gtest.h>

#include "renderer/scene/load_scene.h"
#include "tests/ui/lab_hand.h"

namespace quartet {
namespace {

TEST(LabWindow, TheSamplerComboTracesOtherSamples) {
  LabHand hand;
  const Snapshot before = hand.snapshot();
  EXPECT_EQ(before.settings.sampler, SamplerId::sobol);
  for (const SamplerRow& row : samplers()) {
    SCOPED_TRACE(row.id);
    hand.choose("sampler", std::string(row.id));
    hand.settle();
    EXPECT_EQ(hand.state().request.store.settings.sampler, row.key);
    EXPECT_EQ(hand.snapshot().settings.sampler, row.key);
    EXPECT_EQ(hand.snapshot().lanes[0].mean == before.lanes[0].mean, row.key == SamplerId::sobol);
  }
}

TEST(LabWindow, WhatDrawsItsSamplesLeavesNoChoiceOfASampler) {
  LabHand hand;
  const auto traced = hand.state().request.store.scene;
  const auto drawn = std::make_shared<const TraceScene>(open_scene("synthetic:bernoulli"));
  hand.choose("sampler", "replicated");
  hand.settle();
  set_scene(hand.state(), traced);
  EXPECT_EQ(hand.state().request.store.settings.sampler, SamplerId::replicated) << "a choice stays";
  set_scene(hand.state(), drawn);
  hand.settle();
  EXPECT_EQ(hand.snapshot().settings.sampler, SamplerId::independent);
  hand.choose("sampler", "sobol");
  hand.settle();
  EXPECT_EQ(hand.snapshot().settings.sampler, SamplerId::independent);
  set_scene(hand.state(), traced);
  EXPECT_EQ(hand.state().request.store.settings.sampler, SamplerId::sobol);
}

}  // namespace
}  // namespace quartet
