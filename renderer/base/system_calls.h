#pragma once

#include <sys/types.h>

#include <cstddef>

namespace quartet {

/// The calls of the operating system that files are written and read with. One table for the
/// program, so that a test can let each of them fail in turn; nobody else replaces any.
struct SystemCalls {
  int (*open)(const char* path, int flags, mode_t mode);
  int (*close)(int file);
  ssize_t (*read)(int file, void* bytes, std::size_t size, off_t position);
  ssize_t (*write)(int file, const void* bytes, std::size_t size, off_t position);
  int (*fsync)(int file);
  int (*mkdir)(const char* path, mode_t mode);
  int (*link)(const char* from, const char* to);
  int (*rename)(const char* from, const char* to);
  int (*exchange)(const char* one, const char* other);  ///< both must be there
};

SystemCalls& system_calls();

}  // namespace quartet
