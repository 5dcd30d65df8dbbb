#pragma once

#include <functional>
#include <stop_token>

namespace quartet {

class Lab;

/// Runs a lab to its end: pass after pass, at least one, until `after_pass` returns that there
/// shall be no other. That is called after each pass, on the calling thread, and may change the
/// lab: give a lane other settings, say.
///
/// Returns whether it came to that end. False as soon as `stop` is requested: then no pass begins,
/// the one under way is given up (see Lab::run_pass), and `after_pass` is called no more, not
/// even after a pass that was finished all the same.
///
/// A session's worker has a loop of its own, since it serves many requests and decides between
/// passes which of them goes on.
bool run_lab(Lab& lab, const std::stop_token& stop, const std::function<bool()>& after_pass);

}  // namespace quartet
