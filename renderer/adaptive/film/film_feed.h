#pragma once

#include <cstdint>
#include <span>

#include "renderer/adaptive/film/film.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet {

// How a pass's samples come out of a store into a film: where the store has means and the film
// wants nothing else, they are looked up, else samples are added, with the same result to the bit.

/// The samples of a pass, which must be in the store.
struct PassSamples {
  const SampleStore& store;
  std::span<const std::uint32_t> taken;   ///< of every pixel, those of this pass included
  std::span<const std::uint16_t> wanted;  ///< of these, what this pass has added
};

/// Whether a film's next pass is looked up. Once it has added, it goes on adding.
bool looks_up(const Film& film, const SampleStore& store);

// For one row of tiles; calls for different rows may come from different threads.

/// Adds the work of all samples taken to `cells`, the eight cells of SampleCosts along the row.
void look_up(Film& film, const PassSamples& pass, int tile_row, std::span<std::uint64_t> cells);
/// Adds the work of this pass's samples to `cells`.
void accumulate(Film& film, const PassSamples& pass, int tile_row, std::span<std::uint64_t> cells);

/// Counts the rejected ones among samples before[p] … after[p] − 1 of each pixel p, the last of
/// which are those that it has, and were looked up elsewhere.
void reject(Film& film, const SampleStore& store, std::span<const std::uint32_t> before,
            std::span<const std::uint32_t> after);

/// Sums up what was looked up, `taken` samples of every pixel, so that it can be added to. Runs on
/// the threads of the current TBB arena.
void catch_up(Film& film, const SampleStore& store, std::span<const std::uint32_t> taken);

}  // namespace quartet
