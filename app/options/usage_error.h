#pragma once

#include <stdexcept>

namespace quartet {

/// Arguments that cannot be meant. what() is one line that says what would be right; exit code 2.
struct UsageError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace quartet
