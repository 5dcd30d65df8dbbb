#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/trace/store/sample_source.h"

namespace quartet {

/// The mean of as many first samples of every pixel, without a store.
struct UniformPicture {
  RadianceImage image;
  std::vector<std::uint32_t> rejected;  ///< samples of each pixel that are not in its mean
  std::uint64_t work = 0;               ///< of all, as the source counts it: rays, of the tracer
};

/// Runs on the threads of the current TBB arena. Throws Cancelled once `stop` is requested.
UniformPicture uniform_picture(const SampleSource& source, int width, int height, std::uint32_t spp,
                               const std::stop_token& stop = {});

}  // namespace quartet
