#include "ui/paper/label_places.h"

#include <algorithm>
#include <cstddef>

namespace quartet {
namespace {

/// Labels that touch.
struct LabelBlock {
  double sum = 0.0;  // of where each would have the first one be
  std::size_t count = 0;

  double top(double height, double low, double high) const {
    const double last = high - height * double(count);
    return std::max(low, std::min(sum / double(count), last));
  }
};

}  // namespace

std::vector<double> label_places(const std::vector<double>& wanted, double height, double low,
                                 double high) {
  // Blocks that would overlap become one, whose first label is where the mean of all wants it: the
  // least squares of what each label is moved (pool adjacent violators, Ayer et al. 1955).
  std::vector<LabelBlock> blocks;
  for (const double top : wanted) {
    LabelBlock block{top, 1};
    while (!blocks.empty()) {
      const LabelBlock& before = blocks.back();
      const double end = before.top(height, low, high) + height * double(before.count);
      if (end <= block.top(height, low, high)) {
        break;
      }
      block.sum = before.sum + block.sum - height * double(before.count * block.count);
      block.count += before.count;
      blocks.pop_back();
    }
    blocks.push_back(block);
  }
  std::vector<double> places;
  for (const LabelBlock& block : blocks) {
    for (std::size_t i = 0; i < block.count; ++i) {
      places.push_back(block.top(height, low, high) + height * double(i));
    }
  }
  return places;
}

}  // namespace quartet
