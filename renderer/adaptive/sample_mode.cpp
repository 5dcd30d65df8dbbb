#include "renderer/adaptive/sample_mode.h"

#include <array>

#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr std::array mode_table{
    SampleModeRow{
        SampleMode::reuse, "reuse", "reuse",
        "the samples that decide are the picture: the 2021 report's way, biased (Kirk and "
        "Arvo 1991)"},
    SampleModeRow{
        SampleMode::unbiased, "unbiased", "unbiased",
        "a pilot run with another seed decides, and is thrown away: unbiased, at twice the "
        "samples (Kirk and Arvo 1991)"},
};

}  // namespace

std::span<const SampleModeRow> sample_modes() {
  return mode_table;
}

const SampleModeRow& sample_mode(SampleMode key) {
  return row_of(sample_modes(), key);
}

const SampleModeRow& find_sample_mode(std::string_view id) {
  return find_row(sample_modes(), id, "mode");
}

}  // namespace quartet
