#pragma once

#include <cerrno>
#include <string>

#include "renderer/base/system_calls.h"

namespace quartet {

/// While it lives, the n-th call of the operating system that writes or reads files fails with an
/// error. One at a time.
class FaultyCalls {
 public:
  explicit FaultyCalls(int nth, int error = EIO) : old_(system_calls()) {
    left = nth;
    error_number = error;
    real = old_;
    SystemCalls& calls = system_calls();
    calls.open = [](const char* path, int flags, mode_t mode) {
      return fails("open") ? -1 : real.open(path, flags, mode);
    };
    calls.close = [](int file) {
      const int result =
          real.close(file);  // a file that could not be closed is closed all the same
      return fails("close") ? -1 : result;
    };
    calls.read = [](int file, void* bytes, std::size_t size, off_t position) {
      return fails("read") ? ssize_t(-1) : real.read(file, bytes, size, position);
    };
    calls.write = [](int file, const void* bytes, std::size_t size, off_t position) {
      return fails("write") ? ssize_t(-1) : real.write(file, bytes, size, position);
    };
    calls.fsync = [](int file) { return fails("fsync") ? -1 : real.fsync(file); };
    calls.mkdir = [](const char* path, mode_t mode) {
      return fails("mkdir") ? -1 : real.mkdir(path, mode);
    };
    calls.link = [](const char* from, const char* to) {
      return fails("link") ? -1 : real.link(from, to);
    };
    calls.rename = [](const char* from, const char* to) {
      return fails("rename") ? -1 : real.rename(from, to);
    };
    calls.exchange = [](const char* one, const char* other) {
      return fails("exchange") ? -1 : real.exchange(one, other);
    };
  }
  ~FaultyCalls() { system_calls() = old_; }
  FaultyCalls(const FaultyCalls&) = delete;
  FaultyCalls& operator=(const FaultyCalls&) = delete;

  bool happened() const { return left <= 0; }
  const std::string& call() const { return failed; }  ///< which it was

 private:
  static bool fails(const char* call) {
    if (--left != 0) {
      return false;
    }
    failed = call;
    errno = error_number;
    return true;
  }

  static inline int left = 0;
  static inline int error_number = EIO;
  static inline SystemCalls real;
  static inline std::string failed;
  SystemCalls old_;
};

/// While it lives, what has to do with one call is replaced.
class ReplacedCalls {
 public:
  ReplacedCalls() : old_(system_calls()) {}
  ~ReplacedCalls() { system_calls() = old_; }
  ReplacedCalls(const ReplacedCalls&) = delete;
  ReplacedCalls& operator=(const ReplacedCalls&) = delete;

  SystemCalls* operator->() { return &system_calls(); }

 private:
  SystemCalls old_;
};

/// While it lives, nothing can be written for lack of space.
class FullDisk {
 public:
  FullDisk() {
    calls_->write = [](int, const void*, std::size_t, off_t) {
      errno = ENOSPC;
      return ssize_t(-1);
    };
  }

 private:
  ReplacedCalls calls_;
};

}  // namespace quartet
