#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <string>

namespace quartet {

/// A check for an option: a finite number within [low, high]. CLI11's own range lets NaN pass.
inline CLI::Validator number_between(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) {
          return "";
        }
        return fmt::format("'{}' is not a number from {} to {}", text, low, high);
      },
      "NUMBER");
}

/// A check for an option: a finite number above 0.
inline CLI::Validator number_above_zero() {
  return number_between(1e-30, 1e30);
}

}  // namespace quartet
