#pragma once

#include <vector>

namespace quartet {

/// Tops of labels of one height that stand below each other between `low` and `high` without
/// touching, each as near to where it is wanted as the others let it. `wanted` rises, as the result
/// does; what does not fit at all hangs out beyond `high`.
std::vector<double> label_places(const std::vector<double>& wanted, double height, double low,
                                 double high);

}  // namespace quartet
