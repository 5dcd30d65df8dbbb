#pragma once

#include <cstddef>
#include <string>

namespace quartet {

/// Why pictures of this size are not begun: so many lanes of them would not fit this machine's
/// memory. "30000x30000 would take about 629 GiB of memory, and this machine has 15 GiB; choose a
/// smaller size"; empty if they fit. A picture that cannot fit should be refused before an hour of
/// work, and before the system ends whatever is largest.
std::string memory_refusal(int width, int height, std::size_t lanes);

}  // namespace quartet
