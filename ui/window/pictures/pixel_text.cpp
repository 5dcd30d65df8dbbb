#include "ui/window/pictures/pixel_text.h"

#include <fmt/format.h>

#include "renderer/base/number_text.h"

namespace quartet {
namespace {

std::string error_text(const Estimator& row, const PixelValues& values) {
  if (row.channels == 0) {
    return "";
  }
  std::string text;
  for (int c = 0; c < row.channels; ++c) {
    text += c > 0 ? " " : "";
    text += short_number(values.error[std::size_t(c)]);
  }
  return text;
}

}  // namespace

std::string three_numbers(glm::vec3 values) {
  return fmt::format("{} {} {}", short_number(values.r), short_number(values.g),
                     short_number(values.b));
}

std::vector<std::string> read_out_texts(const Estimator& row, const PixelValues& values,
                                        std::optional<std::uint32_t> rejected_index) {
  const std::string error = error_text(row, values);
  const std::string times = short_number(values.scaled_error);
  std::string rejected;
  std::string briefly;
  if (values.rejected > 0) {
    rejected = briefly = fmt::format(" · {} rejected", values.rejected);
    if (rejected_index && *rejected_index < values.taken) {
      rejected += fmt::format(", first: index {}", *rejected_index);
      briefly += fmt::format(" (index {})", *rejected_index);
    }
  }
  const std::string samples = fmt::format("{} spp", values.taken);
  const std::string state = fmt::format("{} · {}", samples, pixel_state_label(values.state));
  if (row.channels == 0) {
    return {state + rejected, state + briefly, samples + briefly};
  }
  return {fmt::format("{} · error {} = {} × threshold{}", state, error, times, rejected),
          fmt::format("{} · error {} ({}×){}", state, error, times, rejected),
          fmt::format("{} · error {}×{}", state, times, briefly),
          fmt::format("{} · error {}×{}", samples, times, briefly)};
}

}  // namespace quartet
