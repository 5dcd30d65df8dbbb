#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/base/number_text.h"
#include "renderer/view/views.h"

namespace quartet {

/// A picture without anything to see, and why.
View blank_view(const Snapshot& snapshot, std::string note);

/// A number a pixel as the bar's colours.
View numbers_view(const Snapshot& snapshot, std::span<const float> numbers, ColorBar bar);

/// A ViewRow::lines: a number each.
std::vector<std::string> lines_of(glm::vec3 values);
/// A ViewRow::lines: the samples of the pixel.
std::vector<std::string> count_lines(const Snapshot& snapshot, std::size_t lane,
                                     const ViewSettings& settings, std::size_t pixel);

}  // namespace quartet
