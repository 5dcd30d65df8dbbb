#pragma once

#include <functional>
#include <stop_token>

namespace quartet {

class Lab;

/// Runs a lab to its end: frame after frame, at least one, until `after_frame` returns that there
/// shall be no other. That is called after each frame, on the calling thread, and may change the
/// lab: give a lane another policy, say.
///
/// Returns whether it came to that end. False as soon as `stop` is requested: then no frame begins,
/// the one under way is given up (see Lab::run_frame), and `after_frame` is called no more, not
/// even after a frame that was finished all the same.
///
/// A session's worker has a loop of its own, since it serves many requests and decides between
/// frames which of them goes on.
bool run_lab(Lab& lab, const std::stop_token& stop, const std::function<bool()>& after_frame);

}  // namespace quartet
