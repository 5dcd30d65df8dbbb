#pragma once

#include <span>
#include <string>
#include <string_view>

#include "renderer/base/image.h"
#include "renderer/study/stability/stability_summary.h"

namespace quartet {

/// One row of the table of verdicts, the worst first. The first whose rule holds is a cell's.
struct CellVerdict {
  std::string_view id;
  std::string_view label;
  std::string_view rule;  ///< one sentence
  Rgba8 color;
  bool (*applies)(const Cell& cell);
  std::string (*number)(const Cell& cell);  ///< that decided
};

std::span<const CellVerdict> cell_verdicts();
const CellVerdict& cell_verdict(const Cell& cell);

}  // namespace quartet
