#pragma once

#include <cstddef>

namespace quartet {

/// While it lives, the n-th allocation by operator new fails, on whichever thread: of this program,
/// and of the C++ libraries that it uses. Only in the program that failing_new.cpp is linked into,
/// which replaces operator new. One at a time.
class FailingNew {
 public:
  explicit FailingNew(long nth);
  ~FailingNew();
  FailingNew(const FailingNew&) = delete;
  FailingNew& operator=(const FailingNew&) = delete;

  bool happened() const;
};

}  // namespace quartet
