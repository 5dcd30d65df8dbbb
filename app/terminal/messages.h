#pragma once

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace quartet {

/// Before anything is opened: descriptors 0 to 2 that are closed get something harmless, so that no
/// file that is written later becomes the standard output or error; and a reader that goes away, or
/// a limit on the size of files, is an error of the write and not the end of the program.
void prepare_streams() noexcept;

// Messages for people, on the standard error. They may be lost: what a full disk or a closed pipe
// does not take is dropped, because work that is done must not be lost with it. Nothing else may
// write there.

/// Writes the bytes as they are.
void tell_raw(std::string_view bytes) noexcept;

/// One line "quartet: MESSAGE", with what would steer a terminal made visible.
void tell_line(fmt::string_view format, fmt::format_args values) noexcept;

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) noexcept {
  tell_line(format, fmt::make_format_args(values...));
}

/// One line "quartet: warning: MESSAGE".
void warn_line(fmt::string_view format, fmt::format_args values) noexcept;

template <class... Values>
void warn(fmt::format_string<Values...> format, Values&&... values) noexcept {
  warn_line(format, fmt::make_format_args(values...));
}

}  // namespace quartet
