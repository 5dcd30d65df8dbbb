#include "ui/window/playback.h"

#include <gtest/gtest.h>

namespace quartet {
namespace {

TEST(Playback, NewPassesComeAsFastAsTheyCan) {
  Playback playback;
  EXPECT_TRUE(playback.playing());
  EXPECT_FALSE(playback.update(0, 0.0));
  EXPECT_EQ(playback.wanted(), 15u);
  playback.set_target(Playback::no_end);
  EXPECT_EQ(playback.wanted(), Playback::no_end);
}

TEST(Playback, SeenPassesArePlayedAtAPace) {
  Playback playback;
  playback.update(15, 0.0);
  playback.restart();
  EXPECT_EQ(playback.wanted(), 1u);
  EXPECT_TRUE(playback.update(15, 0.0)) << "pass 1 is not on screen yet";
  EXPECT_EQ(playback.wanted(), 1u);
  EXPECT_TRUE(playback.update(1, 1.0));
  EXPECT_EQ(playback.wanted(), 2u);
  EXPECT_TRUE(playback.update(2, 1.01)) << "too soon";
  EXPECT_EQ(playback.wanted(), 2u);
  EXPECT_TRUE(playback.update(2, 2.0));
  EXPECT_EQ(playback.wanted(), 3u);
}

TEST(Playback, PausesWhereItStandsAndStepsFromThere) {
  Playback playback;
  playback.update(7, 0.0);
  playback.toggle();
  EXPECT_EQ(playback.wanted(), 7u);
  playback.step(1);
  EXPECT_EQ(playback.wanted(), 8u);
  playback.step(-1);
  playback.step(-1);
  EXPECT_EQ(playback.wanted(), 6u);
  playback.seek(1);
  playback.step(-1);
  EXPECT_EQ(playback.wanted(), 1u);
  EXPECT_FALSE(playback.playing());
}

TEST(Playback, BeginsAnewOnceTheEndWasShown) {
  Playback playback;
  playback.update(15, 0.0);
  playback.pause();
  playback.play();
  EXPECT_EQ(playback.wanted(), 1u);
}

TEST(Playback, GoesOnBeyondWhatWasSeen) {
  Playback playback;
  playback.update(3, 0.0);
  playback.seek(3);
  playback.play();
  EXPECT_FALSE(playback.update(3, 0.0));
  EXPECT_EQ(playback.wanted(), 15u);
}

}  // namespace
}  // namespace quartet
