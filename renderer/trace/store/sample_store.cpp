#include "renderer/trace/store/sample_store.h"

#include <algorithm>
#include <atomic>
#include <cassert>

#include "renderer/base/parallel.h"

namespace quartet {
namespace {

// Pixels whose counts one thread looks at, at a time.
constexpr std::size_t grain_checks = 1 << 15;

}  // namespace

SampleStore::SampleStore(int width, int height, std::size_t memory_budget, bool keep_means)
    : width_(width),
      height_(height),
      memory_budget_(memory_budget),
      places_(std::size_t(width) * std::size_t(height)),
      firsts_(places_.size(), 0),
      ends_(places_.size(), 0),
      prefixes_(keep_means ? places_.size() : 0),
      has_means_(keep_means) {
  Tile empty;
  if (keep_means) {
    // Of no samples: the same for all tiles.
    empty.means = {mean_planes_.allocate()};
    std::ranges::fill(empty.means.front()->pixels, FirstSamples{glm::vec3(0.0f), 0});
  }
  const auto columns = std::uint32_t(width);
  const auto rows = std::uint32_t(height);
  constexpr auto side = std::uint32_t(tile_size);
  for (std::uint32_t top = 0; top < rows; top += side) {
    for (std::uint32_t left = 0; left < columns; left += side) {
      for (std::uint32_t y = top; y < std::min(top + side, rows); ++y) {
        for (std::uint32_t x = left; x < std::min(left + side, columns); ++x) {
          const std::uint32_t pixel = y * columns + x;
          places_[pixel] = {std::uint32_t(tiles_.size()), (y - top) * side + (x - left)};
          pixels_.push_back(pixel);
        }
      }
      tiles_.push_back(empty);
      first_pixels_.push_back(pixels_.size());
    }
  }
}

bool SampleStore::holds(std::span<const std::uint32_t> taken,
                        std::span<const std::uint16_t> wanted) const {
  assert(taken.size() == ends_.size() && wanted.size() == ends_.size());
  std::atomic<bool> all = true;
  parallel_for(ends_.size(), grain_checks, [&](std::size_t begin, std::size_t end) {
    const std::uint32_t* from = taken.data();
    const std::uint16_t* count = wanted.data();
    const std::uint32_t* first = firsts_.data();
    const std::uint32_t* last = ends_.data();
    std::uint32_t missing = 0;
#pragma omp simd reduction(| : missing)
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t lacks =
          std::uint32_t(from[i] < first[i]) | std::uint32_t(from[i] + count[i] > last[i]);
      missing |= count[i] > 0 ? lacks : 0u;
    }
    if (missing) {
      all = false;
    }
  });
  return all;
}

std::uint64_t SampleStore::tile_work(int column, int row, std::span<const std::uint32_t> taken,
                                     std::span<const std::uint16_t> wanted) const {
  const auto width = std::size_t(width_);
  const Tile& tile = tiles_[std::size_t(row) * std::size_t(tile_columns()) + std::size_t(column)];
  const std::size_t corner = std::size_t(row) * std::size_t(tile_size) * width +
                             std::size_t(column) * std::size_t(tile_size);
  const int columns = std::min(tile_size, width_ - column * tile_size);
  const int rows = std::min(tile_size, height_ - row * tile_size);
  std::uint64_t work = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const std::size_t pixel = corner + std::size_t(y) * width + std::size_t(x);
      const std::size_t offset = std::size_t(y) * std::size_t(tile_size) + std::size_t(x);
      const std::uint32_t count = wanted[pixel];
      work += count;
      if (pass_.has_loose() && !keeps(pixel, taken[pixel] - count, count)) {
        for (std::uint32_t k = 0; k < count; ++k) {
          work += sample(pixel, taken[pixel] - count + k).rays;
        }
        continue;
      }
      const SamplePlane* const* planes = tile.samples.data() + (taken[pixel] - count - tile.base);
      for (std::uint32_t k = 0; k < count; ++k) {
        work += planes[k]->rays[offset];
      }
    }
  }
  return work;
}

/// A sample that is kept or loose.
StorePass::Sample SampleStore::sample(std::size_t pixel, std::uint32_t index) const {
  const Place place = places_[pixel];
  if (!keeps(pixel, index, 1)) {
    return pass_.loose(place.tile, std::uint32_t(pixel), index);
  }
  const Tile& tile = tiles_[place.tile];
  const SamplePlane& plane = *tile.samples[index - tile.base];
  return {plane.radiance[place.offset], plane.rays[place.offset]};
}

std::size_t SampleStore::bytes() const {
  std::size_t pointers = 0;
  for (const Tile& tile : tiles_) {
    pointers += (tile.samples.capacity() + tile.means.capacity()) * sizeof(void*);
  }
  constexpr std::size_t per_pixel = sizeof(Place) + 3 * sizeof(std::uint32_t);
  return sample_planes_.bytes() + mean_planes_.bytes() + pass_.bytes() + pointers +
         tiles_.size() * sizeof(Tile) + ends_.size() * per_pixel +
         prefixes_.size() * sizeof(Prefix);
}

}  // namespace quartet
