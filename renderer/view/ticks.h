#pragma once

#include <string>
#include <vector>

namespace quartet {

struct Tick {
  double value;
  std::string label;
  bool operator==(const Tick&) const = default;
};

/// About `wanted` round numbers inside [min, max]: multiples of 1, 2 or 5 times a power of ten
/// (Heckbert, "Nice Numbers for Graph Labels", Graphics Gems 1990). One tick if min = max; none
/// if a bound is not finite or min > max.
std::vector<Tick> linear_ticks(double min, double max, int wanted);

/// The same with min and max themselves as first and last tick, for colour bars; round numbers
/// nearer to an end than half a step give way to it.
std::vector<Tick> ticks_with_ends(double min, double max, int wanted);

/// Powers of ten from 10^first to 10^last, for logarithmic axes: labelled 0.01, 0.1, 1, 10, 100,
/// and 10⁻³, 10⁴ and so on beyond them.
std::vector<Tick> decade_ticks(int first, int last);

/// About `wanted` or fewer ticks inside [min, max], min above 0, of a logarithmic axis: each 1, 2
/// and 5 times a power of ten, or, where these are too many, powers of ten, each, every second, and
/// so on. Linear ticks where the range holds too few of either. None for a range that is not one.
std::vector<Tick> log_ticks(double min, double max, int wanted);

}  // namespace quartet
