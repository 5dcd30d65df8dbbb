#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/view/pixel_values.h"

namespace quartet {

/// Short numbers.
std::string three_numbers(glm::vec3 values);

/// Samples, state, error and rejected samples of a pixel: from the longest text to the shortest.
/// `rejected_index` is that of the first rejected sample, once it is known.
std::vector<std::string> read_out_texts(const Estimator& row, const PixelValues& values,
                                        std::optional<std::uint32_t> rejected_index);

}  // namespace quartet
