// How the window's process ends. Each test's body is a process of its own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "app/terminal/end_signals.h"
#include "app/window/closing_time.h"
#include "renderer/files/leftovers.h"
#include "tests/files/temp_folder.h"
#include "tests/wait_until.h"

namespace quartet {
namespace {

using test::wait_until;

/// Says 3 if the signal was taken, and whoever watches saw it, while the program went on.
[[noreturn]] void end_by(int signal) {
  const BlockedSignals signals;
  std::atomic<bool> ended = false;
  const SignalWatch watch(signals, [&] { ended = true; });
  kill(getpid(), signal);
  _exit(wait_until([&] { return ended.load(); }) ? 3 : 4);
}

TEST(EndSignals, AreTakenByTheWatchAndDoNotEndTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(end_by(signal), testing::ExitedWithCode(3), "") << signal;
  }
}

[[noreturn]] void end_by_two() {
  const BlockedSignals signals;
  std::atomic<bool> ended = false;
  const SignalWatch watch(signals, [&] { ended = true; });
  kill(getpid(), SIGTERM);
  if (wait_until([&] { return ended.load(); })) {
    kill(getpid(), SIGTERM);
    std::this_thread::sleep_for(test::patience);
  }
  _exit(4);
}

TEST(EndSignals, ASecondOneEndsTheProgram) {
  EXPECT_EXIT(end_by_two(), testing::KilledBySignal(SIGTERM), "");
}

[[noreturn]] void ignore_and_raise() {
  signal(SIGHUP, SIG_IGN);
  {
    const BlockedSignals signals;
    std::atomic<bool> ended = false;
    const SignalWatch watch(signals, [&] { ended = true; });
    kill(getpid(), SIGHUP);
    kill(getpid(), SIGINT);
    if (!wait_until([&] { return ended.load(); })) {
      _exit(4);
    }
  }
  _exit(5);
}

TEST(EndSignals, OnesThatWereToBeIgnoredStillAre) {
  EXPECT_EXIT(ignore_and_raise(), testing::ExitedWithCode(5), "");
}

TEST(EndSignals, AfterwardsTheyAreWhatTheyWere) {
  sigset_t before;
  sigset_t after;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  {
    const BlockedSignals signals;
    const SignalWatch watch(signals, [] {});
  }
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(sigismember(&before, signal), sigismember(&after, signal)) << signal;
  }
}

/// Something that never ends is being closed, with a file that is half written.
[[noreturn]] void close_what_does_not_end(const std::filesystem::path& file) {
  write_bytes_to(file, "half");
  const Leftover leftover(file);
  const ClosingTime closing(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(test::patience);
  _exit(4);
}

[[noreturn]] void close_what_ends() {
  { const ClosingTime closing(test::patience); }
  _exit(5);
}

TEST(ClosingTime, EndsTheProgramWhateverIsUnderWay) {
  const TempFolder folder;
  EXPECT_EXIT(close_what_does_not_end(folder / "file"), testing::ExitedWithCode(0), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "file"));
}

TEST(ClosingTime, DoesNothingToWhatIsClosedInTime) {
  EXPECT_EXIT(close_what_ends(), testing::ExitedWithCode(5), "");
}

}  // namespace
}  // namespace quartet
