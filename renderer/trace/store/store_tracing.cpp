#include <x86intrin.h>

#include <algorithm>
#include <atomic>
#include <cassert>

#include "renderer/base/parallel.h"
#include "renderer/base/stopwatch.h"
#include "renderer/trace/store/sample_store.h"

// How a store comes by its samples.

namespace quartet {
namespace {

// Samples asked for at a time. Far fewer, and a source that traces several paths at once spends its
// time waiting for the last ones; many more, and it is long before a pass can be stopped.
constexpr std::size_t batch_samples = 2048;
// The same for looking at counts.
constexpr std::size_t grain_jobs = 1 << 15;
constexpr std::size_t grain_tiles = grain_jobs / plane_values;

}  // namespace

/// Gives the tile planes for samples [begin, end). The pools are for one thread at a time.
void SampleStore::make_planes(Tile& tile, std::uint32_t begin, std::uint32_t end,
                              std::mutex& pools) {
  const std::lock_guard lock(pools);
  if (tile.samples.empty()) {
    tile.base = has_means_ ? 0 : begin;
  }
  if (begin < tile.base) {
    tile.samples.insert(tile.samples.begin(), tile.base - begin, nullptr);
    tile.base = begin;
  }
  if (end - tile.base > tile.samples.size()) {
    tile.samples.resize(end - tile.base, nullptr);
  }
  for (std::uint32_t i = begin; i < end; ++i) {
    SamplePlane*& plane = tile.samples[i - tile.base];
    if (!plane) {
      plane = sample_planes_.allocate();
    }
  }
  if (has_means_) {
    // Pixel by pixel a complete store has no gaps, so neither have its tiles.
    while (tile.means.size() <= end) {
      tile.means.push_back(mean_planes_.allocate());
    }
  }
}

/// Calls missing(run, is_loose) for what a pixel lacks of what is wanted of it. What follows its
/// last sample is kept; what does not is loose, so that nothing between has to be traced.
template <class Missing>
void SampleStore::find_missing(std::size_t pixel, std::span<const SampleRun> wanted,
                               const Missing& missing) const {
  std::uint32_t first = firsts_[pixel];
  std::uint32_t end = ends_[pixel];
  if (first == end && !has_means_ && !wanted.empty()) {
    first = end = wanted.front().begin;  // it begins anew
  }
  for (const auto& [from, to] : wanted) {
    if (from < first) {
      missing(SampleRun{from, std::min(to, first)}, true);
    }
    const std::uint32_t begin = std::max(from, first);
    if (begin > end && begin < to) {
      missing(SampleRun{begin, to}, true);
    } else if (to > end) {
      missing(SampleRun{end, to}, false);
      end = to;
    }
  }
}

/// Lists what is missing, with planes to put it in; tiles are looked at side by side.
void SampleStore::plan_pass(std::span<const SampleWish> wishes) {
  pass_.clear(tiles_.size());
  std::mutex pools;
  parallel_for(tiles_.size(), grain_tiles, [&](std::size_t first, std::size_t last) {
    WishedRuns wished;
    for (std::size_t tile = first; tile < last; ++tile) {
      // The planes made last: neighbours mostly want the same.
      SampleRun made{0, 0};
      for (const std::uint32_t pixel : pixels_of(tile)) {
        find_missing(pixel, wished.of(wishes, pixel), [&](SampleRun run, bool is_loose) {
          ++pass_.count(tile);
          if (is_loose || (run.begin >= made.begin && run.end <= made.end)) {
            return;
          }
          made = run;
          make_planes(tiles_[tile], run.begin, run.end, pools);
        });
      }
    }
  });
  pass_.make_jobs();
  parallel_for(tiles_.size(), grain_tiles, [&](std::size_t first, std::size_t last) {
    WishedRuns wished;
    for (std::size_t tile = first; tile < last; ++tile) {
      std::size_t job = pass_.first_job(tile);
      for (const std::uint32_t pixel : pixels_of(tile)) {
        find_missing(pixel, wished.of(wishes, pixel), [&](SampleRun run, bool is_loose) {
          if (!is_loose && firsts_[pixel] == ends_[pixel]) {
            firsts_[pixel] = ends_[pixel] = run.begin;
          }
          pass_.jobs()[job++] = {.pixel = pixel,
                                 .first = run.begin,
                                 .count = run.end - run.begin,
                                 .is_loose = is_loose};
        });
      }
    }
  });
  pass_.make_loose();
}

std::uint64_t SampleStore::missing(std::span<const SampleWish> wishes) const {
  std::atomic<std::uint64_t> all = 0;
  parallel_for(tiles_.size(), grain_tiles, [&](std::size_t first, std::size_t last) {
    WishedRuns wished;
    std::uint64_t samples = 0;
    for (std::size_t i = first_pixels_[first]; i < first_pixels_[last]; ++i) {
      find_missing(pixels_[i], wished.of(wishes, pixels_[i]),
                   [&](SampleRun run, bool) { samples += run.end - run.begin; });
    }
    all += samples;
  });
  return all;
}

bool SampleStore::require(std::span<const SampleWish> wishes, const SampleSource& source,
                          std::stop_token stop) {
  // Planning is part of what a pass costs.
  const Stopwatch watch;
  plan_pass(wishes);
  const std::span<Job> all = pass_.jobs();
  if (all.empty()) {
    return true;
  }
  std::size_t samples = 0;
  for (const Job& job : all) {
    samples += job.count;
  }
  const std::size_t grain = std::max<std::size_t>(batch_samples * all.size() / samples, 1);
  parallel_for(all.size(), grain, [&](std::size_t first, std::size_t last) {
    while (first < last && !stop.stop_requested()) {
      std::size_t next = first;
      for (std::size_t count = 0; next < last && count < batch_samples; ++next) {
        count += all[next].count;
      }
      trace_batch(all.subspan(first, next - first), source);
      first = next;
    }
  });
  finish_pass(watch.seconds());
  return !stop.stop_requested();
}

/// Has these samples made and puts them away. The time of the whole is shared by what the source
/// says that each pixel took.
void SampleStore::trace_batch(std::span<Job> jobs, const SampleSource& source) {
  const std::uint64_t start = __rdtsc();
  std::size_t count = 0;
  for (const Job& job : jobs) {
    count += job.count;
  }
  std::vector<glm::vec3> radiance(count);
  std::vector<std::uint16_t> rays(count, 0);
  std::vector<SampleJob> asked;
  asked.reserve(jobs.size());
  for (std::size_t begin = 0; const Job& job : jobs) {
    asked.push_back({.x = int(job.pixel) % width_,
                     .y = int(job.pixel) / width_,
                     .first = job.first,
                     .radiance = std::span(radiance).subspan(begin, job.count),
                     .rays = std::span(rays).subspan(begin, job.count)});
    begin += job.count;
  }
  source(asked);
  double work = 0.0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Job& job = jobs[i];
    job.work = job.count;
    for (std::uint32_t k = 0; k < job.count; ++k) {
      job.work += asked[i].rays[k];
      job.rejected |= !acceptable(asked[i].radiance[k]);
    }
    keep(job, asked[i]);
    job.traced = true;
    work += asked[i].work;
  }
  const double ticks_per_work = double(__rdtsc() - start) / work;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    jobs[i].ticks = asked[i].work * ticks_per_work;
  }
}

/// Puts traced samples where they are looked for.
void SampleStore::keep(const Job& job, const SampleJob& made) {
  if (job.is_loose) {
    std::ranges::copy(made.radiance, pass_.radiance(job).begin());
    std::ranges::copy(made.rays, pass_.rays(job).begin());
    return;
  }
  const Place place = places_[job.pixel];
  const Tile& tile = tiles_[place.tile];
  for (std::uint32_t k = 0; k < job.count; ++k) {
    SamplePlane& plane = *tile.samples[job.first + k - tile.base];
    plane.radiance[place.offset] = made.radiance[k];
    plane.rays[place.offset] = made.rays[k];
  }
  if (has_means_) {
    append_means(made, job.pixel);
  }
}

/// Writes the means up to each of the samples that come next, which lie in their planes already.
void SampleStore::append_means(const SampleJob& made, std::uint32_t pixel) {
  const Place place = places_[pixel];
  const Tile& tile = tiles_[place.tile];
  Prefix& prefix = prefixes_[pixel];
  const std::uint32_t begin = ends_[pixel];
  RunningMean running{prefix.sum, prefix.count};
  std::uint32_t rays = prefix.rays;
  if (prefix.end != begin) {
    // An earlier pass threw after it had come here: what it made does not count.
    running = {};
    rays = 0;
    for (std::uint32_t i = 0; i < begin; ++i) {
      rays += tile.samples[i]->rays[place.offset];
      const glm::vec3& sample = tile.samples[i]->radiance[place.offset];
      if (acceptable(sample)) {
        running.add(sample);
      }
    }
  }
  const auto count = std::uint32_t(made.radiance.size());
  for (std::uint32_t k = 0; k < count; ++k) {
    if (acceptable(made.radiance[k])) {
      running.add(made.radiance[k]);
    }
    rays += made.rays[k];
    tile.means[begin + k + 1]->pixels[place.offset] = {running.mean(), rays};
  }
  prefix = {running.sum, running.count, rays, begin + count};
}

std::size_t SampleStore::cell_of(std::uint32_t tile) const {
  const auto columns = std::size_t(tile_columns());
  return SampleCosts::side * SampleCosts::cell(tile / columns, std::size_t(tile_rows())) +
         SampleCosts::cell(tile % columns, columns);
}

/// Counts what was traced and shares the pass's wall-clock time by the ticks that each pixel took,
/// so that the shares add up to what a user waits.
void SampleStore::finish_pass(double wall) {
  const std::span<const Job> jobs = pass_.jobs();
  double total = 0.0;
  for (const Job& job : jobs) {
    total += job.ticks;
    if (job.rejected) {
      tiles_[places_[job.pixel].tile].rejected = true;
    }
  }
  const double seconds_per_tick = wall / std::max(total, 1.0);
  std::uint32_t tile = 0;
  std::size_t cell = cell_of(tile);
  for (const Job& job : jobs) {
    // Jobs come tile by tile, so that the cell is seldom looked for.
    if (const std::uint32_t next = places_[job.pixel].tile; next != tile) {
      tile = next;
      cell = cell_of(tile);
    }
    if (job.traced) {
      costs_.add(cell, job.work, job.ticks * seconds_per_tick);
    }
  }
  std::atomic<std::uint64_t> made = 0;
  std::atomic<std::uint64_t> kept = 0;
  parallel_for(jobs.size(), grain_jobs, [&](std::size_t first, std::size_t last) {
    std::uint64_t count = 0;
    std::uint64_t kept_count = 0;
    for (std::size_t i = first; i < last; ++i) {
      const Job& job = jobs[i];
      if (!job.traced) {
        continue;  // the pass was stopped before this pixel
      }
      count += job.count;
      if (!job.is_loose) {
        ends_[job.pixel] += job.count;
        kept_count += job.count;
      }
    }
    made += count;
    kept += kept_count;
  });
  stored_ += kept;
  traced_ += made;
  seconds_ += wall;
}

}  // namespace quartet
