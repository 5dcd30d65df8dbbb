#include "renderer/view/ticks.h"
#include "renderer/base/number_text.h"

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
  const int decimals = std::max(0, int(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", value, decimals);
}

bool is_range(double min, double max) {
  return std::isfinite(min) && std::isfinite(max) && min <= max;
}

double step_for(double min, double max, int wanted) {
  return nice_step((max - min) / std::max(1, wanted));
}

/// digit · 10^exponent: 0.02, 0.1, 50, and 10⁻³, 5·10⁴ and so on beyond them.
std::string scientific_label(int digit, int exponent) {
  constexpr std::array superscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (std::abs(exponent) <= 2) {
    return format_number(digit * std::pow(10.0, exponent));
  }
  std::string label = digit == 1 ? "10" : fmt::format("{}·10", digit);
  label += exponent < 0 ? "⁻" : "";
  for (const char figure : std::to_string(std::abs(exponent))) {
    label += superscripts[std::size_t(figure - '0')];
  }
  return label;
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
  std::vector<Tick> ticks;
  for (int exponent = first; exponent <= last; ++exponent) {
    ticks.push_back({std::pow(10.0, exponent), scientific_label(1, exponent)});
  }
  return ticks;
}

std::vector<Tick> log_ticks(double min, double max, int wanted) {
  if (!(min > 0.0) || !is_range(min, max)) {
    return {};
  }
  constexpr double slack = 1e-9;
  constexpr int fewest = 3;
  const auto first = int(std::floor(std::log10(min) + slack));
  const auto last = int(std::ceil(std::log10(max) - slack));
  const auto ticks_of = [&](std::initializer_list<int> digits, int step) {
    std::vector<Tick> ticks;
    for (int exponent = first; exponent <= last; ++exponent) {
      for (const int digit : digits) {
        const double value = digit * std::pow(10.0, exponent);
        if (exponent % step == 0 && value >= min * (1.0 - slack) && value <= max * (1.0 + slack)) {
          ticks.push_back({value, scientific_label(digit, exponent)});
        }
      }
    }
    return ticks;
  };
  std::vector<Tick> ticks = ticks_of({1, 2, 5}, 1);
  for (int step = 1; int(ticks.size()) > std::max(wanted, fewest); ++step) {
    ticks = ticks_of({1}, step);
  }
  return int(ticks.size()) < fewest && max < 10.0 * min ? linear_ticks(min, max, wanted) : ticks;
}

}  // namespace quartet
