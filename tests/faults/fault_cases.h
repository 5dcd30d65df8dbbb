#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/faults/failing_new.h"
#include "tests/image/faulty_calls.h"
#include "tests/image/temp_folder.h"

namespace quartet::test {

/// What came of work in which one thing failed.
struct FaultOutcome {
  std::string fault;  ///< what failed, for messages
  std::string error;  ///< what the work threw; empty if nothing
};

/// Does the work again and again, and lets in turn each of its calls of the operating system fail;
/// the last time none fails. `judge` looks at what each time left.
inline void fail_each_call(const std::function<void()>& work,
                           const std::function<void(const FaultOutcome&)>& judge) {
  for (int n = 1;; ++n) {
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
      EXPECT_GT(n, 1);
      return;
    }
  }
}

/// The same with allocations: each of the first `all`, then ever fewer of the others.
inline void fail_each_allocation(const std::function<void()>& work, long all,
                                 const std::function<void(const FaultOutcome&)>& judge) {
  for (long n = 1;; n += n < all ? 1 : n / 9 + 1) {
    FaultOutcome outcome;
    bool failed = false;
    {
      const FailingNew failing(n);
      outcome.error = error_of(work);
      failed = failing.happened();
    }
    outcome.fault = "allocation " + std::to_string(n);
    SCOPED_TRACE(outcome.fault + ": " + outcome.error);
    judge(outcome);
    if (!failed) {
      EXPECT_EQ(outcome.error, "");
      EXPECT_GT(n, 1);
      return;
    }
  }
}

}  // namespace quartet::test
