#include "app/terminal/messages.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>
#include <string>

#include "renderer/base/printable.h"

namespace quartet {
namespace {

void tell_prefixed(std::string_view prefix, fmt::string_view format,
                   fmt::format_args values) noexcept {
  try {
    tell_raw(fmt::format("quartet: {}{}\n", prefix, printable(fmt::vformat(format, values))));
  } catch (const std::exception&) {
    tell_raw("quartet: out of memory for a message\n");
  }
}

}  // namespace

void prepare_streams() noexcept {
  // For reading alone, so that results that are written to an output that was closed are an error.
  int descriptor = 0;
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) {
    descriptor = ::open("/dev/null", O_RDONLY);  // the lowest that is free
  }
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void tell_raw(std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      return;
    }
    bytes.remove_prefix(std::size_t(written));
  }
}

void tell_line(fmt::string_view format, fmt::format_args values) noexcept {
  tell_prefixed("", format, values);
}

void warn_line(fmt::string_view format, fmt::format_args values) noexcept {
  tell_prefixed("warning: ", format, values);
}

}  // namespace quartet
