#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/measure/rejected_count.h"
#include "renderer/study/needs/model.h"

namespace quartet {

/// Independent pictures of one model, one a seed, each of as many samples a pixel.
struct ModelPictures {
  std::vector<RadianceImage> seeds;
  double rays = 0.0;     ///< a sample, mean over all; the same on every machine
  double seconds = 0.0;  ///< a picture, median, wall-clock
  RejectedCount rejected;
};

/// Pictures with seeds first_seed, first_seed + 1, …, on the threads of the current TBB arena.
/// Models with the same seed share their random numbers, so that paths that are alike have the same
/// noise. Nothing if `stop` ended it. `progress` is told after each picture how much is done.
std::optional<ModelPictures> render_model(const Model& model, std::uint32_t spp,
                                          std::uint64_t first_seed, std::uint32_t seeds,
                                          std::stop_token stop,
                                          const std::function<void(double)>& progress);

}  // namespace quartet
