#include "renderer/adaptive/film/film_feed.h"

#include <algorithm>
#include <vector>

#include "renderer/base/parallel.h"

namespace quartet {
namespace {

// Pixels handed to one thread at a time; a smaller piece costs more to hand out than it gains.
constexpr std::size_t grain_pixels = 1 << 12;

/// The first pixel of a row of a tile.
std::size_t first_pixel(const Film& film, const SampleStore::TileMeans& tile, int row) {
  return std::size_t(tile.top + row) * std::size_t(film.width()) + std::size_t(tile.left);
}

/// Looks up a tile of which some sample was rejected: the newly taken ones must be looked at.
/// Returns the work of all.
std::uint64_t look_up_with_rejected(Film& film, const PassSamples& pass,
                                    const SampleStore::TileMeans& tile) {
  std::vector<glm::vec3> samples;
  std::uint64_t work = 0;
  for (int y = 0; y < tile.rows; ++y) {
    const std::size_t first = first_pixel(film, tile, y);
    for (int x = 0; x < tile.columns; ++x) {
      const std::size_t pixel = first + std::size_t(x);
      const std::uint32_t taken = pass.taken[pixel];
      samples.resize(pass.wanted[pixel]);
      pass.store.read(pixel, taken - pass.wanted[pixel], samples);
      film.reject(pixel, samples);
      const FirstSamples& first_samples = tile.of(taken)[y * SampleStore::tile_size + x];
      film.put(pixel, taken - film.rejected()[pixel], first_samples.mean);
      work += taken + first_samples.rays;
    }
  }
  return work;
}

std::size_t cell_of(const SampleStore& store, int tile_column) {
  return SampleCosts::cell(std::size_t(tile_column), std::size_t(store.tile_columns()));
}

}  // namespace

bool looks_up(const Film& film, const SampleStore& store) {
  return store.has_means() && !film.has_sums() && !film.statistics().any();
}

/// Reads the means of all samples taken, one tile after the other as they lie in memory.
void look_up(Film& film, const PassSamples& pass, int tile_row, std::span<std::uint64_t> cells) {
  // Asked for this many tiles ahead, means have come when they are wanted, and so have the places
  // that they go to; else a replay does little but wait for memory. Into the second-level cache,
  // which waits for more lines at a time than the first does.
  constexpr int ahead = 4;
  constexpr int second_level = 2;
  constexpr int side = SampleStore::tile_size;
  const SampleStore& store = pass.store;
  const std::uint32_t* taken = pass.taken.data();
  for (int column = -ahead; column < store.tile_columns(); ++column) {
    if (column + ahead < store.tile_columns()) {
      const SampleStore::TileMeans tile = store.tile_means(column + ahead, tile_row);
      for (int y = 0; y < tile.rows; ++y) {
        const std::size_t first = first_pixel(film, tile, y);
        const std::uint32_t* n = taken + first;
        film.prefetch(first);
        for (int x = 0; x < tile.columns; ++x) {
          __builtin_prefetch(tile.of(n[x]) + std::ptrdiff_t(y) * side + x, 0, second_level);
        }
      }
    }
    if (column < 0) {
      continue;
    }
    const SampleStore::TileMeans tile = store.tile_means(column, tile_row);
    if (tile.rejected) {
      cells[cell_of(store, column)] += look_up_with_rejected(film, pass, tile);
      continue;
    }
    std::uint64_t work = 0;
    for (int y = 0; y < tile.rows; ++y) {
      const std::size_t first = first_pixel(film, tile, y);
      for (int x = 0; x < tile.columns; ++x) {
        const std::size_t pixel = first + std::size_t(x);
        const FirstSamples& first_samples = tile.of(taken[pixel])[y * side + x];
        film.put(pixel, taken[pixel], first_samples.mean);
        work += taken[pixel] + first_samples.rays;
      }
    }
    cells[cell_of(store, column)] += work;
  }
}

void accumulate(Film& film, const PassSamples& pass, int tile_row, std::span<std::uint64_t> cells) {
  // As above.
  constexpr std::size_t ahead = 32;
  const std::size_t row = SampleStore::tile_size * std::size_t(film.width());
  const std::size_t begin = std::size_t(tile_row) * row;
  const std::size_t end = std::min(begin + row, film.size());
  const std::span<const std::uint32_t> pixels = pass.store.pixels();
  std::vector<glm::vec3> samples;
  for (std::size_t i = begin; i < end; ++i) {
    if (i + ahead < end) {
      const std::uint32_t later = pixels[i + ahead];
      const std::uint32_t wanted = pass.wanted[later];
      pass.store.prefetch(later, pass.taken[later] - wanted, wanted);
    }
    const std::uint32_t pixel = pixels[i];
    if (const std::uint32_t wanted = pass.wanted[pixel]; wanted > 0) {
      samples.resize(wanted);
      pass.store.read(pixel, pass.taken[pixel] - wanted, samples);
      film.add(pixel, samples);
    }
  }
  for (int column = 0; column < pass.store.tile_columns(); ++column) {
    cells[cell_of(pass.store, column)] +=
        pass.store.tile_work(column, tile_row, pass.taken, pass.wanted);
  }
}

void reject(Film& film, const SampleStore& store, std::span<const std::uint32_t> before,
            std::span<const std::uint32_t> after) {
  std::vector<glm::vec3> samples;
  for (int row = 0; row < store.tile_rows(); ++row) {
    for (int column = 0; column < store.tile_columns(); ++column) {
      const SampleStore::TileMeans tile = store.tile_means(column, row);
      if (!tile.rejected) {
        continue;
      }
      for (int y = 0; y < tile.rows; ++y) {
        const std::size_t first = first_pixel(film, tile, y);
        for (std::size_t pixel = first; pixel < first + std::size_t(tile.columns); ++pixel) {
          samples.resize(after[pixel] - before[pixel]);
          store.read(pixel, before[pixel], samples);
          film.reject(pixel, samples);
          film.put(pixel, after[pixel] - film.rejected()[pixel],
                   {film.mean(0)[pixel], film.mean(1)[pixel], film.mean(2)[pixel]});
        }
      }
    }
  }
}

void catch_up(Film& film, const SampleStore& store, std::span<const std::uint32_t> taken) {
  if (film.has_sums()) {
    return;
  }
  film.keep_sums();
  parallel_for(film.size(), grain_pixels, [&](std::size_t begin, std::size_t end) {
    std::vector<glm::vec3> samples;
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      samples.resize(taken[pixel]);
      store.read(pixel, 0, samples);
      film.restore_sum(pixel, samples);
    }
  });
}

}  // namespace quartet
