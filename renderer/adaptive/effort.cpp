#include "renderer/adaptive/effort.h"

#include <array>

#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr std::array effort_table{
    EffortRow{Effort::seconds, "seconds", "seconds, as if alone",
              [](const PassRecord& record, std::size_t) { return record.seconds; }},
    EffortRow{Effort::rays, "rays", "rays per pixel, mean", mean_rays},
    EffortRow{Effort::mean_spp, "spp", "samples per pixel, mean", mean_spp},
};

}  // namespace

std::span<const EffortRow> efforts() {
  return effort_table;
}

const EffortRow& effort_row(Effort key) {
  return row_of(efforts(), key);
}

const EffortRow& find_effort(std::string_view id) {
  return find_row(efforts(), id, "axis");
}

double mean_spp(const PassRecord& record, std::size_t pixels) {
  return double(record.samples) / double(pixels);
}

double mean_rays(const PassRecord& record, std::size_t pixels) {
  return double(record.rays) / double(pixels);
}

}  // namespace quartet
