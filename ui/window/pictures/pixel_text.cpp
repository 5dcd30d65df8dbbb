#include "ui/window/pictures/pixel_text.h"

#include <fmt/format.h>

#include <cmath>

namespace quartet {
namespace {

std::vector<std::string> lines_of(glm::vec3 values) {
  return {short_number(values.r), short_number(values.g), short_number(values.b)};
}

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

std::string short_number(float value) {
  const float size = std::abs(value);
  if (!std::isfinite(value)) {
    return fmt::format("{}", value);
  }
  if (size == 0.0f) {
    return "0";
  }
  if (size < 0.001f || size >= 10000.0f) {
    return fmt::format("{:.1e}", value);
  }
  return size < 1.0f     ? fmt::format("{:.{}f}", value, size < 0.01f ? 4 : 3)
         : size < 10.0f  ? fmt::format("{:.2f}", value)
         : size < 100.0f ? fmt::format("{:.1f}", value)
                         : fmt::format("{:.0f}", value);
}

std::string three_numbers(glm::vec3 values) {
  return fmt::format("{} {} {}", short_number(values.r), short_number(values.g),
                     short_number(values.b));
}

std::vector<std::string> pixel_lines(const Snapshot& snapshot, std::size_t lane, ViewKind kind,
                                     std::size_t other, int x, int y) {
  const std::size_t pixel = std::size_t(y) * std::size_t(snapshot.width) + std::size_t(x);
  const LaneSnapshot& shown = snapshot.lanes[lane];
  const PixelValues values = pixel_values(shown, pixel);
  switch (kind) {
    case ViewKind::image:
      return lines_of(values.radiance);
    case ViewKind::difference:
      if (other < snapshot.lanes.size()) {
        return lines_of(values.radiance - pixel_values(snapshot.lanes[other], pixel).radiance);
      }
      return {};
    case ViewKind::variance:
      return values.variance ? lines_of(*values.variance) : std::vector<std::string>{};
    case ViewKind::error:
      return values.error_channels > 0 ? std::vector{short_number(values.scaled_error)}
                                       : std::vector<std::string>{};
    case ViewKind::reference:
    case ViewKind::true_error: {
      if (!snapshot.reference) {
        return {};
      }
      const glm::vec3 truth = snapshot.reference->pixels()[pixel];
      if (kind == ViewKind::reference) {
        return lines_of(truth);
      }
      const glm::vec3 off = values.radiance - truth;
      return lines_of(off * off / (truth * truth + 0.01f));
    }
    case ViewKind::rejected:
      return {fmt::format("{}", values.rejected)};
    case ViewKind::heatmap:
    case ViewKind::stop_state:
      break;
  }
  return {fmt::format("{}", values.taken)};
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
