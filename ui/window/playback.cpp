#include "ui/window/playback.h"

#include <algorithm>

namespace quartet {
namespace {

constexpr double seconds_a_pass = 0.12;

}  // namespace

void Playback::set_target(std::uint32_t target) {
  target_ = std::max(1u, target);
  if (playing_) {
    wanted_ = target_;
  }
}

void Playback::play() {
  playing_ = true;
  // From the end there is nothing left to play but all of it.
  wanted_ = shown_ >= target_ ? 1 : std::max(1u, shown_);
}

void Playback::pause() {
  playing_ = false;
  wanted_ = std::max(1u, shown_);
}

void Playback::seek(std::uint32_t pass) {
  playing_ = false;
  wanted_ = std::max(1u, pass);
}

void Playback::step(int passes) {
  const std::uint32_t from = playing_ ? std::max(1u, shown_) : wanted_;
  seek(passes < 0 && from <= std::uint32_t(-passes) ? 1 : from + std::uint32_t(passes));
}

void Playback::restart() {
  playing_ = true;
  wanted_ = 1;
}

bool Playback::update(std::uint32_t shown, double seconds) {
  shown_ = shown;
  furthest_ = std::max(furthest_, shown);
  if (!playing_ || wanted_ >= target_) {
    return false;
  }
  if (wanted_ >= furthest_) {
    wanted_ = target_;
    return false;
  }
  // The pass asked for must be on screen before the next one is asked for.
  if (shown == wanted_ && seconds >= next_step_) {
    ++wanted_;
    next_step_ = seconds + seconds_a_pass;
  }
  return true;
}

}  // namespace quartet
