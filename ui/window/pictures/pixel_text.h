#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/view/pixel_values.h"
#include "renderer/view/views.h"

namespace quartet {

/// A number in at most about six characters: 0.412, 31.3, 1.2e4.
std::string short_number(float value);
std::string three_numbers(glm::vec3 values);

/// What a view says of a pixel, in lines of a number each.
std::vector<std::string> pixel_lines(const Snapshot& snapshot, std::size_t lane, ViewKind kind,
                                     std::size_t other, int x, int y);

/// Samples, state, error and rejected samples of a pixel: from the longest text to the shortest.
/// `rejected_index` is that of the first rejected sample, once it is known.
std::vector<std::string> read_out_texts(const Estimator& row, const PixelValues& values,
                                        std::optional<std::uint32_t> rejected_index);

}  // namespace quartet
