#include "renderer/view/color_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "renderer/base/math/fast_log2.h"
#include "renderer/base/table.h"

namespace quartet {

namespace {

using glm::vec3;

// Every 15th of the 256 colours published by Mikhailov (Google AI blog, "Turbo, an improved
// rainbow colormap for visualization", 2019; Apache 2.0). Straight lines between them stay within
// 6/255 of the rest.
constexpr std::array turbo_knots{
    vec3(0.18995f, 0.07176f, 0.23217f), vec3(0.24830f, 0.24143f, 0.61286f),
    vec3(0.27509f, 0.40072f, 0.86692f), vec3(0.26878f, 0.54995f, 0.99303f),
    vec3(0.18625f, 0.69775f, 0.95498f), vec3(0.10026f, 0.82955f, 0.81389f),
    vec3(0.13526f, 0.92197f, 0.66556f), vec3(0.32006f, 0.97974f, 0.47654f),
    vec3(0.54658f, 0.99907f, 0.29581f), vec3(0.71577f, 0.96875f, 0.20815f),
    vec3(0.85868f, 0.88655f, 0.21230f), vec3(0.96049f, 0.77181f, 0.22811f),
    vec3(0.99654f, 0.63193f, 0.18738f), vec3(0.97545f, 0.45740f, 0.11305f),
    vec3(0.91024f, 0.29599f, 0.04814f), vec3(0.80799f, 0.17753f, 0.01660f),
    vec3(0.66449f, 0.08436f, 0.00424f), vec3(0.47960f, 0.01583f, 0.01055f)};

// Every 15th of the 256 colours by van der Walt and Smith (matplotlib, 2015; CC0). Straight lines
// stay within 6/255 of the rest.
constexpr std::array viridis_knots{
    vec3(0.267004f, 0.004874f, 0.329415f), vec3(0.281924f, 0.089666f, 0.412415f),
    vec3(0.280255f, 0.165693f, 0.476498f), vec3(0.263663f, 0.237631f, 0.518762f),
    vec3(0.237441f, 0.305202f, 0.541921f), vec3(0.208623f, 0.367752f, 0.552675f),
    vec3(0.182256f, 0.426184f, 0.557120f), vec3(0.159194f, 0.482237f, 0.558073f),
    vec3(0.137770f, 0.537492f, 0.554906f), vec3(0.121148f, 0.592739f, 0.544641f),
    vec3(0.128087f, 0.647749f, 0.523491f), vec3(0.180653f, 0.701402f, 0.488189f),
    vec3(0.274149f, 0.751988f, 0.436601f), vec3(0.395174f, 0.797475f, 0.367757f),
    vec3(0.535621f, 0.835785f, 0.281908f), vec3(0.688944f, 0.865448f, 0.182725f),
    vec3(0.845561f, 0.887322f, 0.099702f), vec3(0.993248f, 0.906157f, 0.143936f)};

// Few samples blue, many red, as in the report's heatmaps.
constexpr std::array report_knots{vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 1.0f, 0.0f),
                                  vec3(1.0f, 0.0f, 0.0f)};

constexpr vec3 bytes(int r, int g, int b) {
  return vec3(float(r), float(g), float(b)) / 255.0f;
}

// Moreland, "Diverging Color Maps for Scientific Visualization", ISVC 2009: the cool-warm map, the
// 33 colours published with the paper.
constexpr std::array cool_warm_knots{
    bytes(59, 76, 192),   bytes(68, 90, 204),   bytes(77, 104, 215),  bytes(87, 117, 225),
    bytes(98, 130, 234),  bytes(108, 142, 241), bytes(119, 154, 247), bytes(130, 165, 251),
    bytes(141, 176, 254), bytes(152, 185, 255), bytes(163, 194, 255), bytes(174, 201, 253),
    bytes(184, 208, 249), bytes(194, 213, 244), bytes(204, 217, 238), bytes(213, 219, 230),
    bytes(221, 221, 221), bytes(229, 216, 209), bytes(236, 211, 197), bytes(241, 204, 185),
    bytes(245, 196, 173), bytes(247, 187, 160), bytes(247, 177, 148), bytes(247, 166, 135),
    bytes(244, 154, 123), bytes(241, 141, 111), bytes(236, 127, 99),  bytes(229, 112, 88),
    bytes(222, 96, 77),   bytes(213, 80, 66),   bytes(203, 62, 56),   bytes(192, 40, 47),
    bytes(180, 4, 38)};

constexpr std::array color_map_table{
    ColorMapRow{ColorMapId::turbo, "turbo", "Turbo", "Mikhailov 2019", turbo_knots},
    ColorMapRow{ColorMapId::viridis, "viridis", "Viridis", "van der Walt, Smith 2015",
                viridis_knots},
    ColorMapRow{ColorMapId::report, "report", "Report (blue, green, red)", "the report's figure 1",
                report_knots},
    ColorMapRow{ColorMapId::coolwarm, "coolwarm", "Cool-warm (signed)", "Moreland 2009",
                cool_warm_knots},
};

std::uint8_t to_byte(float x) {
  return std::uint8_t(std::lround(x * 255.0f));
}

Rgba8 sample_knots(std::span<const vec3> knots, float t) {
  if (std::isnan(t)) {
    return not_a_number_color;
  }
  const float place = std::clamp(t, 0.0f, 1.0f) * float(knots.size() - 1);
  const std::size_t left = std::min(std::size_t(place), knots.size() - 2);
  const vec3 c = glm::mix(knots[left], knots[left + 1], place - float(left));
  return {to_byte(c.r), to_byte(c.g), to_byte(c.b), 255};
}

}  // namespace

std::span<const ColorMapRow> color_maps() {
  return color_map_table;
}

const ColorMapRow& color_map_row(ColorMapId key) {
  return row_of(color_maps(), key);
}

const ColorMapRow& find_color_map(std::string_view id) {
  return find_row(color_maps(), id, "colour map");
}

Rgba8 sample(ColorMapId color_map, float t) {
  return sample_knots(color_map_row(color_map).knots, t);
}

float scale_position(const ColorScale& scale, double value) {
  if (std::isnan(value)) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  if (!(scale.max > scale.min)) {
    return value > scale.min ? 1.0f : 0.0f;
  }
  double t = (value - scale.min) / (scale.max - scale.min);
  if (scale.spacing == Spacing::logarithmic) {
    t = value > scale.min ? std::log(value / scale.min) / std::log(scale.max / scale.min) : 0.0;
  }
  return float(std::clamp(t, 0.0, 1.0));
}

std::vector<Tick> scale_ticks(const ColorScale& scale, int wanted) {
  if (scale.spacing == Spacing::linear) {
    return ticks_with_ends(scale.min, scale.max, wanted);
  }
  return decade_ticks(int(std::ceil(std::log10(scale.min) - 1e-9)),
                      int(std::floor(std::log10(scale.max) + 1e-9)));
}

void apply(std::span<const float> numbers, const ColorScale& scale, std::span<Rgba8> display) {
  assert(numbers.size() == display.size());
  const std::span<const vec3> knots = color_map_row(scale.color_map).knots;
  if (!(scale.max > scale.min)) {
    std::ranges::transform(numbers, display.begin(), [&](float value) {
      return sample_knots(knots, scale_position(scale, value));
    });
    return;
  }
  constexpr int last = 4096;
  std::array<Rgba8, last + 2> colors;  // the one past the end: not a number
  for (int i = 0; i <= last; ++i) {
    colors[std::size_t(i)] = sample_knots(knots, float(i) / float(last));
  }
  colors[last + 1] = not_a_number_color;

  const bool logarithmic = scale.spacing == Spacing::logarithmic;
  const double low = logarithmic ? std::log2(scale.min) : scale.min;
  const double high = logarithmic ? std::log2(scale.max) : scale.max;
  const auto slope = float(last / (high - low));
  const auto offset = float(low);
  const auto smallest = std::numeric_limits<float>::min();
  constexpr std::size_t block = 512;
  std::array<std::int32_t, block> places;
  for (std::size_t start = 0; start < numbers.size(); start += block) {
    const std::size_t size = std::min(block, numbers.size() - start);
    const float* number = numbers.data() + start;
    const auto place = [&](float value, float x) {
      float t = (x - offset) * slope + 0.5f;
      t = t > 0.0f ? t : 0.0f;
      t = t < float(last) ? t : float(last);
      return value == value ? std::int32_t(t) : last + 1;
    };
    if (logarithmic) {
#pragma omp simd
      for (std::size_t i = 0; i < size; ++i) {
        places[i] = place(number[i], fast_log2(number[i] > smallest ? number[i] : smallest));
      }
    } else {
#pragma omp simd
      for (std::size_t i = 0; i < size; ++i) {
        places[i] = place(number[i], number[i]);
      }
    }
    for (std::size_t i = 0; i < size; ++i) {
      display[start + i] = colors[std::size_t(places[i])];
    }
  }
}

void heatmap(std::span<const std::uint32_t> counts, const ColorScale& scale,
             std::optional<std::uint32_t> cap, std::span<Rgba8> display) {
  assert(counts.size() == display.size());
  const std::span<const vec3> knots = color_map_row(scale.color_map).knots;
  const auto color_of = [&](std::uint32_t count) {
    return cap && count >= *cap ? cap_color : sample_knots(knots, scale_position(scale, count));
  };
  // There are few different counts: each colour is computed once.
  std::array<Rgba8, 1024> colors;
  for (std::uint32_t count = 0; count < colors.size(); ++count) {
    colors[count] = color_of(count);
  }
  std::ranges::transform(counts, display.begin(), [&](std::uint32_t count) {
    return count < colors.size() ? colors[count] : color_of(count);
  });
}

}  // namespace quartet
