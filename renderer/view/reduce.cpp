#include "renderer/view/reduce.h"

#include <algorithm>
#include <cassert>

namespace quartet {
namespace {

/// How much of pixel `to`, along one side, pixel `from` covers.
struct Share {
  std::size_t from, to;
  float weight;
};

/// Of all pixels, in the order of both.
std::vector<Share> shares(int from_count, int to_count) {
  assert(0 < to_count && to_count <= from_count);
  const auto from = std::int64_t(from_count);
  const auto to = std::int64_t(to_count);
  std::vector<Share> all;
  // In units of 1 / (from · to) of the side, where all edges are whole numbers.
  for (std::int64_t i = 0; i < to; ++i) {
    const std::int64_t begin = i * from;
    const std::int64_t end = begin + from;
    for (std::int64_t k = begin / to; k * to < end; ++k) {
      const std::int64_t covered = std::min((k + 1) * to, end) - std::max(k * to, begin);
      all.push_back({std::size_t(k), std::size_t(i), float(covered) / float(from)});
    }
  }
  return all;
}

}  // namespace

DisplayImage reduce(const DisplayImage& image, int width, int height) {
  static_assert(sizeof(Rgba8) == 4);
  const std::vector<Share> columns = shares(image.width(), width);
  const std::vector<Share> rows = shares(image.height(), height);
  const std::size_t bytes_in = 4 * std::size_t(image.width());
  const std::size_t bytes_out = 4 * std::size_t(width);
  DisplayImage reduced(width, height);
  const auto* in = reinterpret_cast<const std::uint8_t*>(image.pixels().data());
  auto* out = reinterpret_cast<std::uint8_t*>(reduced.pixels().data());
  std::vector<float> row(bytes_in);
  std::vector<float> sums(bytes_out);
  auto share = rows.begin();
  for (std::size_t y = 0; y < std::size_t(height); ++y, out += bytes_out) {
    std::fill(row.begin(), row.end(), 0.0f);
    for (; share != rows.end() && share->to == y; ++share) {
      const std::uint8_t* values = in + share->from * bytes_in;
      float* sum = row.data();
      const float weight = share->weight;
#pragma omp simd
      for (std::size_t i = 0; i < bytes_in; ++i) {
        sum[i] += weight * float(values[i]);
      }
    }
    // Rounded by what they begin with.
    std::fill(sums.begin(), sums.end(), 0.5f);
    for (const Share& column : columns) {
      const float* values = row.data() + 4 * column.from;
      float* sum = sums.data() + 4 * column.to;
      for (int c = 0; c < 4; ++c) {
        sum[c] += column.weight * values[c];
      }
    }
#pragma omp simd
    for (std::size_t i = 0; i < bytes_out; ++i) {
      out[i] = std::uint8_t(int(sums[i]));
    }
  }
  return reduced;
}

}  // namespace quartet
