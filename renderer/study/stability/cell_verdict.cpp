#include "renderer/study/stability/cell_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace quartet {
namespace {

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100.0 * share);
}

std::string times(double ratio) {
  return fmt::format("{:.{}f} ×", ratio, ratio < 9.95 ? 1 : 0);
}

constexpr std::array verdict_table{
    CellVerdict{
        "biased",
        "biased",
        "The region's mean is off by more than 2 % over its whole interval: by how much.",
        {178, 24, 43},
        [](const Cell& cell) { return cell.region.off.high < -0.02 || cell.region.off.low > 0.02; },
        [](const Cell& cell) {
          const double off = 100.0 * cell.region.off.mean;
          return fmt::format("{}{:.{}f} %", off < 0.0 ? "−" : "+", std::abs(off),
                             std::abs(off) < 9.95 ? 1 : 0);
        }},
    CellVerdict{"misses",
                "misses",
                "Of the pixels it is done with, more than a quarter are wrong: what share.",
                {225, 87, 40},
                [](const Cell& cell) { return cell.value("missed").low > 0.25; },
                [](const Cell& cell) { return percent(cell.value("missed").mean); }},
    CellVerdict{
        "never-done",
        "never done",
        "More than 5 % of the region's pixels reach the maximum though not wrong: what share.",
        {136, 65, 157},
        [](const Cell& cell) { return cell.value("never_done").low > 0.05; },
        [](const Cell& cell) { return percent(cell.value("never_done").mean); }},
    CellVerdict{
        "wasteful",
        "wasteful",
        "More than half of the samples that it chose to take went to pixels not wrong: what "
        "share.",
        {186, 135, 22},
        [](const Cell& cell) { return cell.value("wasted").low > 0.5; },
        [](const Cell& cell) { return percent(cell.value("wasted").mean); }},
    CellVerdict{
        "slow",
        "slower than uniform",
        "At equal time its error is more than 1.1 × that of uniform sampling: how many times.",
        {153, 153, 153},
        [](const Cell& cell) { return cell.equal_time.low > 1.1; },
        [](const Cell& cell) { return times(cell.equal_time.mean); }},
    CellVerdict{"sound",
                "none of these",
                "Error at equal time in relation to uniform sampling.",
                {65, 134, 88},
                [](const Cell&) { return true; },
                [](const Cell& cell) { return times(cell.equal_time.mean); }},
};

}  // namespace

std::span<const CellVerdict> cell_verdicts() {
  return verdict_table;
}

const CellVerdict& cell_verdict(const Cell& cell) {
  return *std::ranges::find_if(cell_verdicts(),
                               [&](const CellVerdict& row) { return row.applies(cell); });
}

}  // namespace quartet
