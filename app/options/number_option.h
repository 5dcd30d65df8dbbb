#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace quartet {

/// What a number of the command line may be, both ends included.
template <class Number>
struct NumberRange {
  Number low;
  Number high;
};

/// A number above 0 that squares and quotients of it cannot lead far beyond what floats hold.
template <std::floating_point Number>
inline constexpr NumberRange<Number> above_zero{Number(1e-30), Number(1e30)};

/// "0 to 4096".
template <class Number>
std::string range_text(const NumberRange<Number>& range) {
  return fmt::format("{} to {}", range.low, range.high);
}

/// The number that the whole text says, if it lies in the range. Decimal whatever the locale; whole
/// numbers as digits alone. CLI11's own conversion wraps what is negative or too large around,
/// takes 010 for 8, and lets NaN pass.
template <class Number>
std::optional<Number> number_in(std::string_view text, const NumberRange<Number>& range) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const bool whole_text = error == std::errc() && stop == end;
  // Also false for NaN.
  return whole_text && number >= range.low && number <= range.high ? std::optional(number)
                                                                   : std::nullopt;
}

/// "'-1' is not a whole number from 0 to 4096".
template <class Number>
std::string out_of_range(std::string_view text, const NumberRange<Number>& range) {
  return fmt::format("'{}' is not a {}number from {}", text,
                     std::is_integral_v<Number> ? "whole " : "", range_text(range));
}

/// An option whose words, each a number in the range, go to `keep` one by one. Every numeric option
/// of the program is made here, so that none reads numbers in another way.
template <class Number>
CLI::Option* add_number_words(CLI::App& command, const std::string& names,
                              const NumberRange<Number>& range, const std::string& description,
                              std::function<void(const std::vector<Number>&)> keep,
                              std::function<std::string()> default_text = {}) {
  const bool shows_default = bool(default_text);
  CLI::Option* const option = command.add_option(
      names, CLI::callback_t([range, keep = std::move(keep)](const CLI::results_t& words) {
        std::vector<Number> numbers;
        for (const std::string& word : words) {
          const std::optional<Number> number = number_in(word, range);
          if (!number) {
            return false;
          }
          numbers.push_back(*number);
        }
        keep(numbers);
        return true;
      }),
      description, shows_default, std::move(default_text));
  return option->type_name(std::is_integral_v<Number> ? "WHOLE" : "NUMBER")
      ->check(CLI::Validator(
          [range](std::string& text) -> std::string {
            return number_in(text, range) ? "" : out_of_range(text, range);
          },
          range_text(range)));
}

/// An option that is one number; the help shows the value that it has before.
template <class Number>
requires std::is_arithmetic_v<Number> CLI::Option* add_number(
    CLI::App& command, const std::string& names, Number& value,
    const NumberRange<std::type_identity_t<Number>>& range, const std::string& description) {
  return add_number_words<Number>(
      command, names, range, description,
      [&value](const std::vector<Number>& numbers) { value = numbers.front(); },
      [&value] { return fmt::format("{}", value); });
}

/// The same where no number means something of its own.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& names, std::optional<Number>& value,
                        const NumberRange<std::type_identity_t<Number>>& range,
                        const std::string& description) {
  return add_number_words<Number>(
      command, names, range, description,
      [&value](const std::vector<Number>& numbers) { value = numbers.front(); });
}

/// An option of several numbers, separated by commas; the caller says how many.
template <class Number>
CLI::Option* add_numbers(CLI::App& command, const std::string& names, std::vector<Number>& values,
                         const NumberRange<std::type_identity_t<Number>>& range,
                         const std::string& description) {
  return add_number_words<Number>(
             command, names, range, description,
             [&values](const std::vector<Number>& numbers) { values = numbers; })
      ->delimiter(',');
}

}  // namespace quartet
