#include "renderer/trace/store/sample_store.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <x86intrin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "renderer/scene/load_scene.h"
#include "renderer/trace/integrator.h"
#include "tests/trace/require.h"

namespace quartet {
namespace {

using Counts = std::vector<std::uint32_t>;

constexpr std::size_t plenty = std::size_t(1) << 30;

/// What the source below makes of an address: different everywhere.
glm::vec3 sample_at(int x, int y, std::uint32_t index) {
  return {float(x), float(y), float(index)};
}

/// A source that counts how often it makes each sample.
class CountingSource {
 public:
  CountingSource(int width, int height, std::uint32_t indices)
      : width_(width),
        indices_(indices),
        times_(std::size_t(width) * std::size_t(height) * indices) {}

  SampleSource source() {
    return [this](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
      for (std::size_t i = 0; i < radiance.size(); ++i) {
        const std::uint32_t index = first + std::uint32_t(i);
        times_[at(std::size_t(y) * std::size_t(width_) + std::size_t(x), index)]++;
        radiance[i] = sample_at(x, y, index);
      }
    };
  }
  int times(std::size_t pixel, std::uint32_t index) const { return times_[at(pixel, index)]; }
  std::uint64_t total() const {
    return std::accumulate(times_.begin(), times_.end(), std::uint64_t(0));
  }

 private:
  std::size_t at(std::size_t pixel, std::uint32_t index) const { return pixel * indices_ + index; }

  int width_;
  std::size_t indices_;
  std::vector<std::atomic<int>> times_;
};

void expect_samples(const SampleStore& store, std::size_t pixel, std::uint32_t begin,
                    std::uint32_t end) {
  std::vector<glm::vec3> samples(end - begin);
  store.read(pixel, begin, samples);
  const int x = int(pixel) % store.width();
  const int y = int(pixel) / store.width();
  for (std::uint32_t i = begin; i < end; ++i) {
    ASSERT_EQ(samples[i - begin], sample_at(x, y, i)) << "pixel " << pixel << " index " << i;
  }
}

void expect_samples(const SampleStore& store, const Counts& begin, const Counts& end) {
  for (std::size_t pixel = 0; pixel < begin.size(); ++pixel) {
    if (begin[pixel] < end[pixel]) {
      expect_samples(store, pixel, begin[pixel], end[pixel]);
    }
  }
}

TEST(SampleStore, TracesEachSampleOnceHoweverOftenItIsAskedFor) {
  constexpr int width = 37;
  constexpr int height = 23;
  constexpr std::size_t pixels = width * height;
  CountingSource counting(width, height, 400);
  SampleStore store(width, height, plenty);
  std::mt19937 random(1);
  Counts reached(pixels, 0);
  for (int pass = 0; pass < 40; ++pass) {
    // Four lanes have used different numbers of samples; each asks for more, or for nothing.
    Counts begin(pixels);
    Counts end(pixels);
    for (std::size_t p = 0; p < pixels; ++p) {
      begin[p] = reached[p] > 0 ? std::uint32_t(random() % (reached[p] + 1)) : 0;
      end[p] = random() % 3 ? begin[p] + std::uint32_t(random() % 12) : begin[p];
      reached[p] = std::max(reached[p], end[p]);
    }
    ASSERT_TRUE(test::require(store, begin, end, counting.source()));
    expect_samples(store, begin, end);
  }
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::uint32_t i = 0; i < 400; ++i) {
      ASSERT_EQ(counting.times(p, i), i < reached[p] ? 1 : 0) << "pixel " << p << " index " << i;
    }
    expect_samples(store, p, 0, reached[p]);
  }
  const std::uint64_t sum = std::accumulate(reached.begin(), reached.end(), std::uint64_t(0));
  EXPECT_EQ(counting.total(), sum);
  EXPECT_EQ(store.traced(), sum);
  EXPECT_EQ(store.stored(), sum);
  EXPECT_FALSE(store.partial());
}

TEST(SampleStore, AsksForNothingWhereBeginIsNotBeforeEnd) {
  CountingSource counting(3, 1, 100);
  SampleStore store(3, 1, plenty);
  ASSERT_TRUE(test::require(store, Counts{5, 7, 0}, Counts{5, 2, 0}, counting.source()));
  EXPECT_EQ(counting.total(), 0u);
  EXPECT_EQ(store.stored(), 0u);
}

TEST(SampleStore, BeginBeyondWhatIsStoredLeavesTheGapOut) {
  CountingSource counting(2, 1, 100);
  SampleStore store(2, 1, plenty);
  ASSERT_TRUE(test::require(store, Counts{0, 0}, Counts{4, 4}, counting.source()));
  ASSERT_TRUE(test::require(store, Counts{10, 4}, Counts{13, 6}, counting.source()));
  expect_samples(store, 0, 10, 13);
  expect_samples(store, 1, 0, 6);
  EXPECT_EQ(store.stored(), 10u) << "what is beyond a gap is not kept";
  EXPECT_EQ(store.traced(), 13u);
  ASSERT_TRUE(test::require(store, Counts{0, 0}, Counts{12, 1}, counting.source()));
  expect_samples(store, 0, 0, 12);
  EXPECT_EQ(counting.times(0, 2), 1);
  EXPECT_EQ(counting.times(0, 7), 1);
  EXPECT_EQ(counting.times(0, 11), 2);
  EXPECT_EQ(counting.times(1, 0), 1);
}

TEST(SampleStore, OfSeveralWishesOnlyWhatTheyNameIsTraced) {
  CountingSource counting(1, 1, 100);
  SampleStore store(1, 1, plenty);
  const Counts taken[] = {{40}, {7}, {20}, {9}, {60}};
  const std::vector<std::uint16_t> wanted[] = {{5}, {3}, {4}, {6}, {0}};
  std::vector<SampleWish> wishes;
  for (std::size_t i = 0; i < std::size(taken); ++i) {
    wishes.push_back({taken[i], wanted[i]});
  }
  EXPECT_EQ(store.missing(wishes), 8u + 4 + 5);
  ASSERT_TRUE(store.require(wishes, counting.source()));
  EXPECT_EQ(counting.total(), 8u + 4 + 5);
  expect_samples(store, 0, 7, 15);
  expect_samples(store, 0, 20, 24);
  expect_samples(store, 0, 40, 45);
  // What joins is kept, the rest is loose.
  EXPECT_EQ(store.stored(), 8u);
  store.forget_loose();
  EXPECT_EQ(store.missing(wishes), 4u + 5);
  // From one before what is kept to one after it.
  ASSERT_TRUE(test::require(store, Counts{5}, Counts{17}, counting.source()));
  expect_samples(store, 0, 5, 17);
  EXPECT_EQ(counting.times(0, 10), 1);
  EXPECT_EQ(store.stored(), 10u);
}

TEST(SampleStore, KeepsSamplesWhileItGrows) {
  // One sample at a time and many.
  CountingSource counting(2, 1, 40000);
  SampleStore store(2, 1, plenty);
  std::uint32_t one = 0;
  for (std::uint32_t many = 1; many < 30000; many = many * 3 / 2 + 1) {
    one = std::min(one + 1, many);
    ASSERT_TRUE(test::require(store, Counts{0, 0}, Counts{one, many}, counting.source()));
    expect_samples(store, 0, 0, one);
    expect_samples(store, 1, 0, many);
    EXPECT_EQ(counting.total(), one + many);
  }
  EXPECT_GE(store.bytes(), store.stored() * sizeof(glm::vec3));
}

TEST(SampleStore, ForgetsWhatWasUsedWhenOverItsBudgetAndMakesItAgain) {
  constexpr int width = 64;
  constexpr int height = 64;
  constexpr std::size_t pixels = width * height;
  CountingSource counting(width, height, 1024);
  constexpr std::size_t budget = std::size_t(8) << 20;
  SampleStore store(width, height, budget);
  Counts used(pixels, 0);
  Counts end(pixels, 200);
  ASSERT_TRUE(test::require(store, used, end, counting.source()));
  EXPECT_GT(store.bytes(), budget);
  for (std::size_t p = 0; p < pixels; ++p) {
    used[p] = 150 + std::uint32_t(p % 51);  // to 200, which is all of them
  }
  store.trim(used);
  EXPECT_TRUE(store.partial());
  EXPECT_LE(store.bytes(), budget);
  std::uint64_t left = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    left += 200 - used[p];
  }
  EXPECT_EQ(store.stored(), left);
  // Going on from there traces nothing again, ...
  Counts further(pixels, 220);
  ASSERT_TRUE(test::require(store, used, further, counting.source()));
  expect_samples(store, used, further);
  EXPECT_EQ(counting.total(), pixels * 220);
  // ... and a replay from the start makes the same samples.
  ASSERT_TRUE(test::require(store, Counts(pixels, 0), further, counting.source()));
  expect_samples(store, Counts(pixels, 0), further);
  EXPECT_EQ(store.traced(), counting.total());
  EXPECT_EQ(store.stored(), left + pixels * 20) << "it is not kept: it is before what is";
}

TEST(SampleStore, KeepsEverythingWhileWithinItsBudget) {
  CountingSource counting(8, 8, 100);
  SampleStore store(8, 8, plenty);
  ASSERT_TRUE(test::require(store, Counts(64, 0), Counts(64, 50), counting.source()));
  store.trim(Counts(64, 50));
  EXPECT_FALSE(store.partial());
  expect_samples(store, Counts(64, 0), Counts(64, 50));
}

TEST(SampleStore, OfMoreThanItsBudgetItKeepsWhatIsTakenFirst) {
  constexpr std::size_t budget = std::size_t(4) << 20;
  for (const bool is_needed : {true, false}) {
    CountingSource counting(64, 64, 600);
    SampleStore store(64, 64, budget);
    const Counts none(64 * 64, 0);
    const Counts end(64 * 64, 500);
    ASSERT_TRUE(test::require(store, none, end, counting.source()));
    // By lanes that are behind, or by a replay that may come.
    store.trim(Counts(64 * 64, is_needed ? 100 : UINT32_MAX));
    EXPECT_TRUE(store.partial());
    EXPECT_LE(store.bytes(), budget);
    EXPECT_GT(store.bytes(), budget * 9 / 10);
    const auto kept = std::uint32_t(store.stored() / (64 * 64));
    EXPECT_EQ(store.stored() % (64 * 64), 0u);
    const std::uint32_t first = is_needed ? 100 : 0;
    const Counts begin(64 * 64, first);
    ASSERT_TRUE(test::require(store, begin, Counts(64 * 64, first + kept), counting.source()));
    EXPECT_EQ(counting.total(), 64u * 64 * 500) << "nothing is traced again";
    ASSERT_TRUE(test::require(store, begin, Counts(64 * 64, first + kept + 1), counting.source()));
    EXPECT_EQ(counting.total(), 64u * 64 * 501);
    expect_samples(store, begin, Counts(64 * 64, first + kept + 1));
  }
}

TEST(SampleStore, MakesRoomForWhatComes) {
  constexpr std::size_t budget = std::size_t(4) << 20;
  CountingSource counting(64, 64, 600);
  SampleStore store(64, 64, budget);
  ASSERT_TRUE(test::require(store, Counts(64 * 64, 0), Counts(64 * 64, 40), counting.source()));
  ASSERT_LT(store.bytes(), budget);
  store.trim(Counts(64 * 64, 0), std::size_t(3) << 20);
  EXPECT_LE(store.bytes(), std::size_t(1) << 20);
  EXPECT_GT(store.stored(), 0u);
}

TEST(SampleStore, BlocksAreUsedAgain) {
  // Growing pixel by pixel must not leave every smaller block behind as waste.
  CountingSource counting(64, 64, 600);
  SampleStore store(64, 64, plenty);
  for (std::uint32_t n = 4; n <= 512; n *= 2) {
    ASSERT_TRUE(test::require(store, Counts(64 * 64, 0), Counts(64 * 64, n), counting.source()));
  }
  EXPECT_LT(store.bytes(), 2.2 * double(store.stored()) * sizeof(glm::vec3));
}

TEST(SampleStore, ASourceThatThrowsLeavesTheStoreUsable) {
  CountingSource counting(64, 64, 20);
  SampleStore store(64, 64, plenty);
  const Counts none(64 * 64, 0);
  const Counts some(64 * 64, 3);
  const Counts more(64 * 64, 9);
  ASSERT_TRUE(test::require(store, none, some, counting.source()));
  const SampleSource failing = [](int x, int, std::uint32_t, std::span<glm::vec3> radiance) {
    if (x == 40) {
      throw std::runtime_error("no more");
    }
    std::fill(radiance.begin(), radiance.end(), glm::vec3(-1.0f));
  };
  EXPECT_THROW(test::require(store, none, more, failing), std::runtime_error);
  expect_samples(store, none, some);
  EXPECT_EQ(store.stored(), 64u * 64 * 3);
  ASSERT_TRUE(test::require(store, none, more, counting.source()));
  expect_samples(store, none, more);
}

TEST(SampleStore, SharesTheTimeOfAPassAmongTheCellsOfThePicture) {
  // Two tiles and so two cells, in one of which a sample takes a hundred times longer, and three
  // rays more.
  constexpr std::size_t side = std::size_t(SampleStore::tile_size);
  SampleStore store(2 * int(side), int(side), plenty);
  const SampleSource slow = [](std::span<SampleJob> jobs) {
    for (SampleJob& job : jobs) {
      const bool right = std::size_t(job.x) >= side;
      std::fill(job.radiance.begin(), job.radiance.end(), glm::vec3(1.0f));
      std::fill(job.rays.begin(), job.rays.end(), std::uint16_t(right ? 4 : 1));
      job.work = double(job.radiance.size()) * (right ? 100.0 : 1.0);
    }
  };
  const std::size_t size = 2 * side * side;
  const auto work_of = [&](std::uint16_t count, int column) {
    const Counts taken(size, count);
    const std::vector<std::uint16_t> wanted(size, count);
    return store.tile_work(column, 0, taken, wanted);
  };
  double before = 0.0;
  for (const std::uint16_t count : {std::uint16_t(3), std::uint16_t(9)}) {
    ASSERT_TRUE(test::require(store, Counts(size, 0), Counts(size, count), slow));
    EXPECT_EQ(work_of(count, 0), side * side * count * (1 + 1));
    EXPECT_EQ(work_of(count, 1), side * side * count * (1 + 4));
    SampleCosts::Work left;
    SampleCosts::Work right;
    left.units[0] = work_of(count, 0);
    right.units[SampleCosts::cell(1, 2)] = work_of(count, 1);
    const double cheap = store.costs().rates().of(left);
    const double dear = store.costs().rates().of(right);
    EXPECT_NEAR(dear / cheap, 100.0, 1e-9);
    // Every second of a pass is given to some sample.
    EXPECT_NEAR((cheap + dear) / store.seconds(), 1.0, 1e-9);
    EXPECT_GT(store.seconds(), before);
    before = store.seconds();
  }
}

TEST(SampleStore, KnowsTheRaysOfEachSampleOfEachPixel) {
  constexpr int columns = 19;  // not whole tiles
  constexpr int rows = 11;
  const auto rays_of = [](int x, int y, std::uint32_t index) {
    return std::uint16_t((std::uint32_t(x) * 7 + std::uint32_t(y) * 13 + index * 5) % 60000);
  };
  const SampleSource source = [&](std::span<SampleJob> jobs) {
    for (SampleJob& job : jobs) {
      std::fill(job.radiance.begin(), job.radiance.end(), glm::vec3(1.0f));
      for (std::uint32_t k = 0; k < job.rays.size(); ++k) {
        job.rays[k] = rays_of(job.x, job.y, job.first + k);
      }
    }
  };
  Counts taken;
  std::vector<std::uint16_t> wanted;
  for (std::uint32_t i = 0; i < columns * rows; ++i) {
    taken.push_back(20 + i % 7);
    wanted.push_back(std::uint16_t(i % 5));
  }
  for (const bool keep_means : {false, true}) {
    SampleStore store(columns, rows, plenty, keep_means);
    ASSERT_TRUE(test::require(store, Counts(taken.size(), 0), taken, source));
    std::uint64_t work = 0;
    for (int row = 0; row < store.tile_rows(); ++row) {
      for (int column = 0; column < store.tile_columns(); ++column) {
        work += store.tile_work(column, row, taken, wanted);
      }
    }
    std::uint64_t expected = 0;
    for (std::uint32_t i = 0; i < taken.size(); ++i) {
      for (std::uint32_t k = taken[i] - wanted[i]; k < taken[i]; ++k) {
        expected += 1u + rays_of(int(i) % columns, int(i) / columns, k);
      }
    }
    EXPECT_EQ(work, expected);
  }
}

TEST(SampleSource, OnePixelAfterTheOtherIsTimed) {
  std::array<double, 2> inside{};
  const SampleSource source = [&](int x, int, std::uint32_t, std::span<glm::vec3>) {
    const std::uint64_t before = __rdtsc();
    volatile double sink = 0.0;
    for (int i = 0; i < 100000; ++i) {
      sink = sink + 1.0;
    }
    inside[std::size_t(x)] = double(__rdtsc() - before);
  };
  std::array<glm::vec3, 3> radiance;
  std::array jobs{SampleJob{0, 0, 0, std::span(radiance).first(1)},
                  SampleJob{1, 0, 0, std::span(radiance).last(2)}};
  source(jobs);
  // Whatever else the machine did meanwhile only adds to it.
  EXPECT_GE(jobs[0].work, inside[0]);
  EXPECT_GE(jobs[1].work, inside[1]);
  EXPECT_GT(std::min(inside[0], inside[1]), 100.0) << "more than a count of samples";
}

TEST(SampleStoreThreads, StoppingAPassKeepsWhatIsDone) {
  constexpr int width = 128;
  constexpr int height = 96;
  constexpr std::size_t pixels = width * height;
  CountingSource counting(width, height, 64);
  SampleStore store(width, height, plenty);
  const Counts none(pixels, 0);
  const Counts some(pixels, 5);
  const Counts more(pixels, 20);
  ASSERT_TRUE(test::require(store, none, some, counting.source()));
  std::stop_source stop;
  std::atomic<int> calls = 0;
  const SampleSource stopping = [&, trace = counting.source()](int x, int y, std::uint32_t first,
                                                               std::span<glm::vec3> radiance) {
    if (++calls == 1000) {
      stop.request_stop();
    }
    trace(x, y, first, radiance);
  };
  EXPECT_FALSE(test::require(store, none, more, stopping, stop.get_token()));
  EXPECT_EQ(store.traced(), counting.total());
  EXPECT_EQ(store.stored(), counting.total());
  EXPECT_GT(counting.total(), pixels * 5);
  EXPECT_LT(counting.total(), pixels * 20);
  expect_samples(store, none, some);
  // The rest, and only the rest, is traced when it is asked for again.
  ASSERT_TRUE(test::require(store, none, more, counting.source()));
  EXPECT_EQ(counting.total(), pixels * 20);
  expect_samples(store, none, more);
}

TEST(SampleStoreThreads, APassThatIsStoppedBeforeItBeginsTracesNothing) {
  CountingSource counting(64, 64, 8);
  SampleStore store(64, 64, plenty);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(test::require(store, Counts(64 * 64, 0), Counts(64 * 64, 4), counting.source(),
                             stop.get_token()));
  EXPECT_EQ(counting.total(), 0u);
  EXPECT_EQ(store.stored(), 0u);
}

TEST(SampleStoreThreads, AnyNumberOfThreadsGivesTheSameSamples) {
  const TraceScene scene(load_scene(find_scene("cornell-checker")));
  RenderSettings settings = default_settings(scene.scene());
  settings.width = 64;
  settings.height = 36;
  const CameraRays camera(settings.camera, settings.width, settings.height);
  const SampleSource source = [&](int x, int y, std::uint32_t first,
                                  std::span<glm::vec3> radiance) {
    integrator(settings.integrator).trace(scene, settings, camera, x, y, first, radiance);
  };
  const std::size_t pixels = std::size_t(settings.width) * std::size_t(settings.height);
  Counts end(pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    end[p] = std::uint32_t(1 + p % 5);
  }
  // More threads than processors too.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
  std::vector<glm::vec3> alone;
  for (const int threads : {1, 2, 8}) {
    tbb::task_arena arena(threads);
    SampleStore store(settings.width, settings.height, plenty);
    arena.execute([&] {
      // In two passes, so that ranges grow.
      ASSERT_TRUE(test::require(store, Counts(pixels, 0), Counts(pixels, 1), source));
      ASSERT_TRUE(test::require(store, Counts(pixels, 0), end, source));
    });
    std::vector<glm::vec3> all;
    for (std::size_t p = 0; p < pixels; ++p) {
      std::vector<glm::vec3> samples(end[p]);
      store.read(p, 0, samples);
      all.insert(all.end(), samples.begin(), samples.end());
    }
    if (threads == 1) {
      alone = all;
    }
    ASSERT_EQ(all.size(), alone.size());
    EXPECT_EQ(std::memcmp(all.data(), alone.data(), all.size() * sizeof(glm::vec3)), 0)
        << threads << " threads";
  }
  EXPECT_GT(
      std::count_if(alone.begin(), alone.end(), [](glm::vec3 sample) { return sample.y > 0.0f; }),
      1000);
}

}  // namespace
}  // namespace quartet
