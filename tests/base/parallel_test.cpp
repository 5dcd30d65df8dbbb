#include "renderer/base/parallel.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace quartet {
namespace {

/// Whether a number next to 0 is above it, on each of some threads.
std::vector<char> tiny_is_something() {
  volatile float tiny = std::numeric_limits<float>::denorm_min();
  std::vector<char> answers(64);
  parallel_for(answers.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      answers[i] = tiny > 0.0f ? 1 : 0;
    }
  });
  return answers;
}

TEST(Parallel, NumbersNextToZeroAreAsTheCallerHasThem) {
  constexpr unsigned take_for_zero = 0x8040;  // results and operands
  const unsigned before = _mm_getcsr();
  tbb::task_arena arena(4);
  // The first call decides how the arena has it, as Embree's did.
  _mm_setcsr(before | take_for_zero);
  arena.execute([] { parallel_for(8, 1, [](std::size_t, std::size_t) {}); });
  const std::vector<char> as_zero = tiny_is_something();
  _mm_setcsr(before & ~take_for_zero);
  const std::vector<char> as_they_are = tiny_is_something();
  _mm_setcsr(before);
  EXPECT_EQ(std::ranges::count(as_zero, 0), 64);
  EXPECT_EQ(std::ranges::count(as_they_are, 1), 64);
}

}  // namespace
}  // namespace quartet
