#pragma once

#include <x86intrin.h>

#include <concepts>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <utility>

namespace quartet {

/// Samples first, first + 1, … of a pixel, wanted from a source. The source fills in the rest.
struct SampleJob {
  int x, y;  ///< counted from the top left
  std::uint32_t first;
  std::span<glm::vec3> radiance;  ///< linear
  /// The rays that each sample took, at most 65535; as many as samples, or empty where nobody asks.
  /// Comes as zeros, for a source that traces none.
  std::span<std::uint16_t> rays = {};
  /// What these samples took, above 0, in any unit that all jobs of a call share. It comes as the
  /// number of samples, for a source whose samples all take the same.
  double work = double(radiance.size());
};

/// Makes samples: the tracer, or anything else whose radiance is a pure function of scene, pixel
/// and index. Many pixels at a time, so that a source may work on several at once; what it makes of
/// one must not depend on the others. Called from many threads.
///
/// Made from a function of a span of jobs; or from one of (x, y, first, radiance), which is then
/// called for one pixel after the other, and its time is the work.
class SampleSource {
 public:
  SampleSource() = default;

  template <std::invocable<std::span<SampleJob>> Batch>
  SampleSource(Batch batch)  // NOLINT(google-explicit-constructor): functions are sources
      : batch_(std::move(batch)) {}

  template <std::invocable<int, int, std::uint32_t, std::span<glm::vec3>> Pixel>
  SampleSource(Pixel pixel)  // NOLINT(google-explicit-constructor)
      : batch_([pixel = std::move(pixel)](std::span<SampleJob> jobs) {
          std::uint64_t before = __rdtsc();
          for (SampleJob& job : jobs) {
            pixel(job.x, job.y, job.first, job.radiance);
            const std::uint64_t after = __rdtsc();
            job.work = double(after - before);
            before = after;
          }
        }) {}

  explicit operator bool() const { return bool(batch_); }

  void operator()(std::span<SampleJob> jobs) const { batch_(jobs); }
  void operator()(int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) const {
    SampleJob job{x, y, first, radiance};
    batch_({&job, 1});
  }

 private:
  std::function<void(std::span<SampleJob>)> batch_;
};

}  // namespace quartet
