#include "renderer/adaptive/replay.h"

#include <immintrin.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>

#include "renderer/adaptive/estimators/window_kernel.h"
#include "renderer/adaptive/pixel_state.h"
#include "renderer/adaptive/policies/mark_rows.h"
#include "renderer/base/parallel.h"
#include "renderer/base/stopwatch.h"

namespace quartet {
namespace {

constexpr int tile_side = SampleStore::tile_size;

/// Means of a row of the picture by channel, and the rays that they took.
struct LookedUpRow {
  float* red;
  float* green;
  float* blue;
  std::uint32_t* rays;
};

static_assert(sizeof(FirstSamples) == 4 * sizeof(float) && offsetof(FirstSamples, rays) == 12);

/// Copies what lies at these places in memory.
void gather(std::span<const FirstSamples* const> places, const LookedUpRow& out) {
  std::size_t x = 0;
  for (; x + 4 <= places.size(); x += 4) {
    __m128 r = _mm_loadu_ps(&places[x]->mean.x);
    __m128 g = _mm_loadu_ps(&places[x + 1]->mean.x);
    __m128 b = _mm_loadu_ps(&places[x + 2]->mean.x);
    __m128 rays = _mm_loadu_ps(&places[x + 3]->mean.x);
    _MM_TRANSPOSE4_PS(r, g, b, rays);
    _mm_storeu_ps(out.red + x, r);
    _mm_storeu_ps(out.green + x, g);
    _mm_storeu_ps(out.blue + x, b);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out.rays + x), _mm_castps_si128(rays));
  }
  for (; x < places.size(); ++x) {
    out.red[x] = places[x]->mean.x;
    out.green[x] = places[x]->mean.y;
    out.blue[x] = places[x]->mean.z;
    out.rays[x] = places[x]->rays;
  }
}

}  // namespace

/// Some rows of the picture that one thread takes through all passes, with as many rows around them
/// as they depend on: two more for each pass that follows.
class Replay::Band {
 public:
  Band(Replay& replay, int begin, int end)
      : replay_(replay),
        kernel_(*estimator(replay.start_.settings.estimator).window),
        channels_(std::size_t(estimator(replay.start_.settings.estimator).channels)),
        width_(std::size_t(replay.store_.width())),
        height_(replay.store_.height()),
        own_{begin, end},
        first_row_(fed_rows(0).begin) {
    const std::size_t first = std::size_t(first_row_) * width_;
    const std::size_t last = std::size_t(fed_rows(0).end) * width_;
    taken_.assign(replay.start_.taken.begin() + std::ptrdiff_t(first),
                  replay.start_.taken.begin() + std::ptrdiff_t(last));
    wanted_.assign(replay.start_.wanted.begin() + std::ptrdiff_t(first),
                   replay.start_.wanted.begin() + std::ptrdiff_t(last));
    places_.resize(width_);
    means_.resize(3 * width_);
    rays_.resize(width_);
    errors_.resize(channels_ * width_);
    passes_.reserve(replay.passes_);
    for (std::uint32_t p = 0; p < replay.passes_; ++p) {
      passes_.emplace_back(width_, height_, reduced_floats());
    }
  }

  void run() {
    const Rows rows = fed_rows(0);
    for (int y = rows.begin; y < rows.end; ++y) {
      feed(0, y);
    }
    for (int y = own_.begin; y < own_.end; ++y) {
      const std::size_t to = std::size_t(y) * width_;
      std::copy_n(taken_row(y), width_, replay_.taken_.data() + to);
      std::copy_n(wanted_row(y), width_, replay_.wanted_.data() + to);
    }
  }

  void add_totals(std::span<PassTotal> totals) const {
    for (std::size_t p = 0; p < totals.size(); ++p) {
      const PassTotal& more = passes_[p].total;
      totals[p].samples += more.samples;
      totals[p].planned += more.planned;
      totals[p].not_done += more.not_done;
      totals[p].max_spp = std::max(totals[p].max_spp, more.max_spp);
      totals[p].work += more.work;
    }
  }

 private:
  struct Rows {
    int begin;
    int end;
    bool contain(int y) const { return y >= begin && y < end; }
  };

  /// The last rows of a pass.
  struct Pass {
    Pass(std::size_t width, int height, std::size_t reduced_floats)
        : reduced(3 * reduced_floats), marks(width, height) {}
    std::vector<float> reduced;
    MarkRows marks;
    PassTotal total;
  };

  std::size_t reduced_floats() const { return std::size_t(kernel_.values) * width_; }
  std::uint32_t* taken_row(int y) { return taken_.data() + std::size_t(y - first_row_) * width_; }
  std::uint16_t* wanted_row(int y) { return wanted_.data() + std::size_t(y - first_row_) * width_; }
  float* reduced_row(std::uint32_t p, int y) {
    return y < 0 || y >= height_
               ? nullptr
               : passes_[p].reduced.data() + std::size_t(y % 3) * reduced_floats();
  }

  /// So many rows more to either side of one's own, where the picture has them.
  Rows widened(std::uint32_t by) const {
    return {std::max(own_.begin - int(by), 0), std::min(own_.end + int(by), height_)};
  }
  // The rows of a pass whose samples are taken, whose errors are estimated, and that are planned.
  Rows fed_rows(std::uint32_t p) const { return widened(2 * (replay_.passes_ - p)); }
  Rows judged_rows(std::uint32_t p) const { return widened(2 * (replay_.passes_ - p) - 1); }
  Rows planned_rows(std::uint32_t p) const { return widened(2 * (replay_.passes_ - p) - 2); }

  bool is_last(std::uint32_t p) const { return p + 1 == replay_.passes_; }

  /// Takes the samples of a row for a pass, and does with the rows above what can now be done.
  void feed(std::uint32_t p, int y) {
    if (p >= replay_.possible_.load(std::memory_order_relaxed)) {
      return;
    }
    if (!take(p, y)) {
      std::uint32_t possible = replay_.possible_;
      while (possible > p && !replay_.possible_.compare_exchange_weak(possible, p)) {
      }
      return;
    }
    look_up(p, y);
    if (y > 0) {
      judge(p, y - 1);
    }
    if (y + 1 == height_) {
      judge(p, y);
    }
  }

  /// Counts what a pass takes; false if the store has not got it.
  bool take(std::uint32_t p, int y) {
    std::uint32_t* const taken = taken_row(y);
    const std::uint16_t* const wanted = wanted_row(y);
    const std::uint32_t* const ends = replay_.store_.ends().data() + std::size_t(y) * width_;
    std::uint32_t samples = 0;
    std::uint32_t most = 0;
    std::uint32_t lacking = 0;
#pragma omp simd reduction(+ : samples) reduction(max : most) reduction(| : lacking)
    for (std::size_t x = 0; x < width_; ++x) {
      const std::uint32_t n = taken[x] + wanted[x];
      taken[x] = n;
      samples += wanted[x];
      most = std::max(most, n);
      lacking |= n > ends[x] ? 1u : 0u;
    }
    if (own_.contain(y)) {
      PassTotal& total = passes_[p].total;
      total.samples += samples;
      total.max_spp = std::max(total.max_spp, most);
    }
    return lacking == 0;
  }

  /// Brings a row's means and reduces them.
  void look_up(std::uint32_t p, int y) {
    const SampleStore& store = replay_.store_;
    const std::uint32_t* const n = taken_row(y);
    const int tile_row = y / tile_side;
    const int row_of_tile = y % tile_side * tile_side;
    // All are asked for before the first is wanted; else a replay does little but wait for memory.
    for (int column = 0; column < store.tile_columns(); ++column) {
      const SampleStore::TileMeans tile = store.tile_means(column, tile_row);
      for (int x = 0; x < tile.columns; ++x) {
        const int pixel = tile.left + x;
        places_[std::size_t(pixel)] = tile.of(n[pixel]) + row_of_tile + x;
        __builtin_prefetch(places_[std::size_t(pixel)]);
      }
    }
    const LookedUpRow out{means_.data(), means_.data() + width_, means_.data() + 2 * width_,
                          rays_.data()};
    gather(places_, out);
    const MeanRow means{out.red, out.green, out.blue};
    kernel_.reduce(means, int(width_), reduced_row(p, y));
    if (!own_.contain(y)) {
      return;
    }
    add_work(p, tile_row, n);
    if (is_last(p)) {
      replay_.film_.put_row(std::size_t(y) * width_, {n, width_}, means);
    }
  }

  void add_work(std::uint32_t p, int tile_row, const std::uint32_t* n) {
    constexpr std::size_t side = SampleCosts::side;
    const SampleStore& store = replay_.store_;
    const auto columns = std::size_t(store.tile_columns());
    const std::size_t first_cell =
        side * SampleCosts::cell(std::size_t(tile_row), std::size_t(store.tile_rows()));
    std::size_t x = 0;
    for (std::size_t cell = 0; cell < side; ++cell) {
      // Past the last tile whose cell is this one.
      const std::size_t tiles = ((cell + 1) * columns + side - 1) / side;
      const std::size_t end = std::min(tiles * tile_side, width_);
      std::uint64_t work = 0;
      const std::uint32_t* const rays = rays_.data();
#pragma omp simd reduction(+ : work)
      for (std::size_t i = x; i < end; ++i) {
        work += std::uint64_t(n[i]) + rays[i];
      }
      passes_[p].total.work.units[first_cell + cell] += work;
      x = end;
    }
  }

  /// Estimates the errors of a row, whose neighbours are looked up, and marks it.
  void judge(std::uint32_t p, int y) {
    if (!judged_rows(p).contain(y)) {
      return;
    }
    const int width = int(width_);
    ErrorRow out{};
    for (std::size_t c = 0; c < channels_; ++c) {
      out[c] = errors_.data() + c * width_;
    }
    kernel_.errors({reduced_row(p, y - 1), reduced_row(p, y), reduced_row(p, y + 1)}, width, out);
    if (is_last(p) && own_.contain(y)) {
      for (std::size_t c = 0; c < channels_; ++c) {
        std::copy_n(out[c], width_,
                    replay_.error_.data() + c * replay_.film_.size() + std::size_t(y) * width_);
      }
    }
    MarkRows& marks = passes_[p].marks;
    mark_not_done({replay_.start_.settings, errors_, {taken_row(y), width_}}, 0, marks.row(y));
    if (own_.contain(y)) {
      passes_[p].total.not_done += marks.count(y);
    }
    if (y > 0) {
      plan(p, y - 1);
    }
    if (y + 1 == height_) {
      plan(p, y);
    }
  }

  /// Plans a row, whose neighbours are marked, for the next pass, which then takes it.
  void plan(std::uint32_t p, int y) {
    if (!planned_rows(p).contain(y)) {
      return;
    }
    const std::uint64_t planned =
        plan_row(replay_.start_.settings,
                 passes_[p].marks.plan_row(y, replay_.start_.pass + p + 1, {taken_row(y), width_}),
                 {wanted_row(y), width_});
    if (own_.contain(y)) {
      passes_[p].total.planned += planned;
    }
    if (!is_last(p) && fed_rows(p + 1).contain(y)) {
      feed(p + 1, y);
    }
  }

  Replay& replay_;
  const WindowKernel& kernel_;
  std::size_t channels_;
  std::size_t width_;
  int height_;
  Rows own_;
  int first_row_;
  // Of these rows and those around them, by whichever pass has come furthest.
  std::vector<std::uint32_t> taken_;
  std::vector<std::uint16_t> wanted_;
  std::vector<Pass> passes_;
  // Of the row under way.
  std::vector<const FirstSamples*> places_;
  std::vector<float> means_;
  std::vector<std::uint32_t> rays_;
  std::vector<float> errors_;
};

Replay::Replay(const SampleStore& store, const Start& start, std::uint32_t passes, Film& film,
               std::span<float> error)
    : store_(store), start_(start), film_(film), error_(error) {
  assert(store.has_means() && store.holds(start.taken, start.wanted));
  // What the passes keep of their last rows is to stay in the second-level cache.
  constexpr std::size_t most_bytes = std::size_t(1) << 19;
  const WindowKernel& kernel = *estimator(start.settings.estimator).window;
  const std::size_t bytes_of_pixel = sizeof(float) * std::size_t(kernel.values) + 1;
  const std::size_t bytes = 3 * std::size_t(film.width()) * bytes_of_pixel;
  const auto most = std::uint32_t(std::clamp<std::size_t>(most_bytes / bytes, 2, 16));
  taken_.resize(film.size());
  wanted_.resize(film.size());
  restart(std::min(passes, most));
}

void Replay::restart(std::uint32_t passes) {
  passes_ = passes;
  possible_ = passes;
  totals_.assign(passes, {});
  seconds_ = 0.0;
}

/// Takes the rows [begin, end) through all passes; calls for different rows may come from
/// different threads.
void Replay::run(int begin, int end, double threads) {
  const Stopwatch watch;
  Band band(*this, begin, end);
  band.run();
  const std::lock_guard lock(mutex_);
  band.add_totals(totals_);
  seconds_ += watch.seconds() / threads;
}

void run_replays(std::span<const std::unique_ptr<Replay>> replays) {
  const auto run_all = [](std::span<Replay* const> running) {
    // A band takes rows around it through the passes too, so that there are no more bands than it
    // takes to keep all threads at work.
    constexpr std::size_t least_rows = 64;
    const auto threads = std::size_t(tbb::this_task_arena::max_concurrency());
    parallel_for(running.size(), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const auto rows = std::size_t(running[i]->store_.height());
        const std::size_t bands =
            std::clamp<std::size_t>(threads / std::gcd(threads, running.size()), 1,
                                    std::max<std::size_t>(rows / least_rows, 1));
        parallel_for(bands, 1, [&](std::size_t begin, std::size_t end) {
          for (std::size_t band = begin; band < end; ++band) {
            running[i]->run(int(band * rows / bands), int((band + 1) * rows / bands),
                            double(threads));
          }
        });
      }
    });
  };
  std::vector<Replay*> running;
  for (const auto& replay : replays) {
    running.push_back(replay.get());
  }
  run_all(running);
  std::erase_if(running, [](const Replay* replay) { return replay->possible_ == replay->passes_; });
  for (Replay* replay : running) {
    replay->restart(replay->possible_);
  }
  run_all(running);
}

}  // namespace quartet
