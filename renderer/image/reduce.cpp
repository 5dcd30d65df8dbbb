#include "renderer/image/reduce.h"

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

glm::vec4 values_of(const Rgba8& pixel) {
  return {pixel.r, pixel.g, pixel.b, pixel.a};
}
Rgba8 rounded(const glm::vec4& values) {
  const glm::vec4 v = values + 0.5f;
  return {std::uint8_t(v.x), std::uint8_t(v.y), std::uint8_t(v.z), std::uint8_t(v.w)};
}

}  // namespace

DisplayImage reduce(const DisplayImage& image, int width, int height) {
  const std::vector<Share> columns = shares(image.width(), width);
  const std::vector<Share> rows = shares(image.height(), height);
  const auto columns_in = std::size_t(image.width());
  const auto columns_out = std::size_t(width);
  DisplayImage reduced(width, height);
  std::vector<glm::vec4> row(columns_in);
  std::vector<glm::vec4> sums(columns_out);
  auto share = rows.begin();
  for (std::size_t y = 0; y < std::size_t(height); ++y) {
    std::fill(row.begin(), row.end(), glm::vec4(0.0f));
    for (; share != rows.end() && share->to == y; ++share) {
      const Rgba8* in = image.pixels().data() + share->from * columns_in;
      for (std::size_t x = 0; x < columns_in; ++x) {
        row[x] += share->weight * values_of(in[x]);
      }
    }
    std::fill(sums.begin(), sums.end(), glm::vec4(0.0f));
    for (const Share& column : columns) {
      sums[column.to] += column.weight * row[column.from];
    }
    std::transform(sums.begin(), sums.end(), reduced.pixels().data() + y * columns_out, rounded);
  }
  return reduced;
}

}  // namespace quartet
