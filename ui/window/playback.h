#pragma once

#include <cstdint>

#include "renderer/session/lab_request.h"

namespace quartet {

/// Where in the experiment the window stands: which pass it asks the lanes for, and when.
class Playback {
 public:
  static constexpr std::uint32_t no_end = LaneRequest::no_end;

  bool playing() const { return playing_; }
  std::uint32_t target() const { return target_; }      ///< where playing ends, or no_end
  std::uint32_t wanted() const { return wanted_; }      ///< for LaneRequest::pass
  std::uint32_t furthest() const { return furthest_; }  ///< pass seen so far of this store
  std::uint32_t shown() const { return shown_; }

  void set_target(std::uint32_t target);
  void toggle() { playing_ ? pause() : play(); }
  void play();
  void pause();
  void seek(std::uint32_t pass);  ///< and stay there
  void step(int passes);
  /// Plays again from the first pass.
  void restart();

  /// Other samples: nothing has been seen of them.
  void forget() { furthest_ = 0; }

  /// Takes note of the pass on screen. Passes that were seen before are played at a pace that can
  /// be watched, new ones as fast as they come. Returns whether it waits for time to pass.
  bool update(std::uint32_t shown, double seconds);

 private:
  bool playing_ = true;
  std::uint32_t target_ = 15;
  std::uint32_t wanted_ = 15;
  std::uint32_t furthest_ = 0;
  std::uint32_t shown_ = 0;
  double next_step_ = 0.0;
};

}  // namespace quartet
