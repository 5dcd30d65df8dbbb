#include "app/terminal/messages.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <string>

#include "renderer/base/printable.h"

namespace quartet {
namespace {

/// The exit status of `action` in a process of its own; -1 if a signal ended it.
int status_of(const std::function<int()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    _exit(action());
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Messages, AreLostWhereTheyCannotBeWrittenAndNothingElseIs) {
  EXPECT_EQ(status_of([] {
              dup2(open("/dev/full", O_WRONLY), STDERR_FILENO);
              warn("{}", std::string(100'000, 'a'));
              return 7;
            }),
            7);
  EXPECT_EQ(status_of([] {
              close(STDERR_FILENO);
              tell("closed");
              return 7;
            }),
            7);
  EXPECT_EQ(status_of([] {
              prepare_streams();
              std::array<int, 2> ends{};
              if (pipe(ends.data()) != 0) {
                return 1;
              }
              dup2(ends[1], STDERR_FILENO);
              close(ends[0]);
              tell("nobody reads this");
              return 7;
            }),
            7);
}

TEST(Messages, ClosedStreamsAreNotGivenToFiles) {
  for (int closed = 0; closed < 8; ++closed) {
    EXPECT_EQ(status_of([closed] {
                for (int descriptor = 0; descriptor < 3; ++descriptor) {
                  if ((closed & 1 << descriptor) != 0) {
                    close(descriptor);
                  }
                }
                prepare_streams();
                const int file = open("/dev/null", O_WRONLY);
                // Results that went nowhere must not pass for written.
                const bool fails = (closed & 2) == 0 || write(STDOUT_FILENO, "x", 1) < 0;
                return file > STDERR_FILENO && fails ? 7 : 1;
              }),
              7)
        << closed;
  }
}

TEST(Messages, AreOneLineThatSteersNoTerminal) {
  testing::internal::CaptureStderr();
  warn("no file {}", "a\x1b]0;title\x07\nb");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "quartet: warning: no file a\\x1b]0;title\\x07\\nb\n");
}

TEST(Printable, KeepsTextAndShowsWhatIsNone) {
  EXPECT_EQ(printable("Übung \\ 场景 🎲"), "Übung \\ 场景 🎲");
  EXPECT_EQ(printable("a\tb\rc\x7f"), "a\\tb\\x0dc\\x7f");
  EXPECT_EQ(printable("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(printable("caf\xe9s"), "caf\\xe9s");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m");  // one character that begins a sequence
  // NOLINTNEXTLINE(misc-misleading-bidirectional)
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb");                                            // from right to left
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                    // longer than it need be
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a pair
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");  // beyond the last
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

}  // namespace
}  // namespace quartet
