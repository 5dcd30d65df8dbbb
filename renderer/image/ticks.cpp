#include "renderer/image/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace quartet {

namespace {

/// The 1, 2 or 5 times a power of ten that is nearest to `step`; Heckbert's bounds.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  const double fraction = step / power;
  return power * (fraction < 1.5 ? 1.0 : fraction < 3.0 ? 2.0 : fraction < 7.0 ? 5.0 : 10.0);
}

std::string tick_label(double value, double step, double largest) {
  if (largest >= 1e6 || step < 1e-4) {
    return format_number(value);
  }
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

bool is_range(double min, double max) {
  return std::isfinite(min) && std::isfinite(max) && min <= max;
}

double step_for(double min, double max, int wanted) {
  return nice_step((max - min) / std::max(1, wanted));
}

}  // namespace

std::vector<Tick> linear_ticks(double min, double max, int wanted) {
  if (!is_range(min, max)) {
    return {};
  }
  // Nearer than this, doubles no longer tell the ticks apart.
  const double largest = std::max(std::abs(min), std::abs(max));
  if (max - min <= 1e-12 * largest || max == min) {
    return {{min, format_number(min)}};
  }
  const double step = step_for(min, max, wanted);
  std::vector<Tick> ticks;
  const double last = std::floor(max / step + 1e-9);
  for (double i = std::ceil(min / step - 1e-9); i <= last; ++i) {
    const double value = i * step + 0.0;  // not -0
    ticks.push_back({value, tick_label(value, step, largest)});
  }
  return ticks;
}

std::vector<Tick> ticks_with_ends(double min, double max, int wanted) {
  std::vector<Tick> round = linear_ticks(min, max, wanted);
  if (!is_range(min, max) || min == max) {
    return round;
  }
  const double step = step_for(min, max, wanted);
  const auto end_tick = [&](double end) -> Tick {
    for (const Tick& tick : round) {
      if (std::abs(tick.value - end) < 1e-6 * step) {
        return tick;
      }
    }
    return {end, format_number(end)};
  };
  std::vector<Tick> ticks{end_tick(min)};
  for (const Tick& tick : round) {
    if (tick.value - min >= 0.5 * step && max - tick.value >= 0.5 * step) {
      ticks.push_back(tick);
    }
  }
  ticks.push_back(end_tick(max));
  return ticks;
}

std::vector<Tick> decade_ticks(int first, int last) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::vector<Tick> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    const double value = std::pow(10.0, exponent);
    std::string label = format_number(value);
    if (std::abs(exponent) > 2) {
      label = exponent < 0 ? "10⁻" : "10";
      for (const char digit : std::to_string(std::abs(exponent))) {
        label += digits[static_cast<std::size_t>(digit - '0')];
      }
    }
    ticks.push_back({value, std::move(label)});
  }
  return ticks;
}

std::string format_number(double value) {
  std::string text = fmt::format("{:.4g}", value == 0.0 ? 0.0 : value);
  if (const std::size_t exponent = text.find('e'); exponent != std::string::npos) {
    const int power = std::stoi(text.substr(exponent + 1));
    text = fmt::format("{}e{}", text.substr(0, exponent), power);
  }
  return text;
}

}  // namespace quartet
