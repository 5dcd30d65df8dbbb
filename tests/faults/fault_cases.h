#pragma once

#include <ImfThreading.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <stdexcept>
#include <string>

#include "renderer/files/exr_header.h"
#include "tests/faults/failing_new.h"
#include "tests/files/faulty_calls.h"
#include "tests/files/temp_folder.h"

namespace quartet::test {

/// What came of work in which one thing failed.
struct FaultOutcome {
  std::string fault;  ///< what failed, for messages
  std::string error;  ///< what the work threw; empty if nothing
};

/// Does the work again and again, and lets in turn each of its calls of the operating system fail,
/// or every `stride`-th if the work takes long; the last time none fails. `judge` looks at what
/// each time left.
inline void fail_each_call(const std::function<void()>& work, int stride,
                           const std::function<void(const FaultOutcome&)>& judge) {
  for (int n = 1;; n += stride) {
    FaultOutcome outcome;
    bool failed = false;
    {
      const FaultyCalls faults(n);
      outcome.error = error_of(work);
      failed = faults.happened();
      outcome.fault = "call " + std::to_string(n) + ", " + faults.call();
    }
    SCOPED_TRACE(outcome.fault + ": " + outcome.error);
    judge(outcome);
    if (!failed) {
      EXPECT_EQ(outcome.error, "");
      return;
    }
  }
}

/// Keeps OpenEXR to the thread that calls it. Its threads have a queue, and where the queue finds
/// no memory to grow, the task that was to enter it has been counted already: whoever wrote the
/// picture waits for it for ever. Whether the queue has to grow is up to how quickly the threads
/// empty it.
inline void without_exr_threads() {
  exr_threads();  // sets them up at the first call
  Imf::setGlobalThreadCount(0);
}

/// Does the work in a process of its own, and throws what it threw. An object of the JSON library
/// that found no memory is half made, and ends the program when it is touched again, at the latest
/// by its destructor: by an assertion, or by a null pointer where assertions are off. Nothing can
/// be done about it from outside; here it is an error like others, and files must be whole after
/// it.
inline void in_a_child(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDERR_FILENO);
    _exit(error_of(work).empty() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) {
    EXPECT_TRUE(WTERMSIG(status) == SIGABRT || WTERMSIG(status) == SIGSEGV) << status;
    throw std::runtime_error("terminated");
  }
  if (WEXITSTATUS(status) == 2) {
    throw std::runtime_error("done without");
  }
  if (WEXITSTATUS(status) != 0) {
    throw std::runtime_error("failed");
  }
}

/// Like fail_each_call, with allocations: each of the first ones, then ever fewer of the others.
/// `child`: see in_a_child.
inline void fail_each_allocation(const std::function<void()>& work, int stride, bool child,
                                 const std::function<void(const FaultOutcome&)>& judge) {
  without_exr_threads();
  const long all = 60 / stride;
  for (long n = 1;; n += n < all ? 1 : 1 + n * std::min(stride, 4) / 9) {
    FaultOutcome outcome;
    bool failed = false;
    const auto fail_one = [&] {
      const FailingNew failing(n);
      const std::string error = error_of(work);
      failed = failing.happened();
      if (child && failed && error.empty()) {
        _exit(2);  // it did without
      }
      if (!error.empty()) {
        throw std::runtime_error(error);
      }
    };
    outcome.error = error_of([&] { child ? in_a_child(fail_one) : fail_one(); });
    outcome.fault = "allocation " + std::to_string(n);
    SCOPED_TRACE(outcome.fault + ": " + outcome.error);
    judge(outcome);
    if (child ? outcome.error.empty() : !failed) {
      EXPECT_EQ(outcome.error, "");
      EXPECT_GT(n, 1);
      return;
    }
  }
}

}  // namespace quartet::test
