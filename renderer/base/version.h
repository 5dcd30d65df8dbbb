#pragma once

#include <string_view>

namespace quartet {

/// The version of Quartet, as "1.2.3".
std::string_view version();

}  // namespace quartet
