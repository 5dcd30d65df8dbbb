#include "app/terminal/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "app/terminal/messages.h"
#include "renderer/base/printable.h"

namespace quartet {
namespace {

using std::chrono::seconds;

std::string duration_text(double duration) {
  const auto total = long(std::max(0.0, duration) + 0.5);
  return total < 3600 ? fmt::format("{}:{:02}", total / 60, total % 60)
                      : fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

std::string bar(double fraction) {
  constexpr int cells = 24;
  const int full = int(fraction * cells);
  return std::string(std::size_t(full), '#') + std::string(std::size_t(cells - full), '.');
}

}  // namespace

Progress::Progress(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO)) {
}

Progress::~Progress() {
  if (bar_shown_) {
    tell_raw("\r\033[K");
  }
}

void Progress::update(double fraction, std::string_view detail) {
  const auto now = Clock::now();
  const auto interval =
      terminal_ ? Clock::duration(std::chrono::milliseconds(100)) : Clock::duration(seconds(5));
  if (now - start_ < seconds(1) || now - last_ < interval) {
    return;
  }
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      fraction > 0.0 ? duration_text(elapsed * (1.0 - fraction) / fraction) + " left" : "";
  if (terminal_) {
    bar_shown_ = true;
    tell_raw(fmt::format("\r\033[K{} [{}] {:3.0f} % {} · {}", what_, bar(fraction),
                         100.0 * fraction, left, printable(detail)));
  } else {
    tell_raw(
        fmt::format("{}: {:.0f} %, {}, {}\n", what_, 100.0 * fraction, left, printable(detail)));
  }
}

}  // namespace quartet
