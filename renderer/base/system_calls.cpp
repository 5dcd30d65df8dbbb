#include "renderer/base/system_calls.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

namespace quartet {

SystemCalls& system_calls() {
  static SystemCalls calls{
      .open = [](const char* path, int flags, mode_t mode) { return ::open(path, flags, mode); },
      .close = ::close,
      .read = ::pread,
      .write = ::pwrite,
      .fsync = ::fsync,
      .mkdir = ::mkdir,
      .link = ::link,
      .rename = std::rename,
      .exchange =
          [](const char* one, const char* other) {
            return ::renameat2(AT_FDCWD, one, AT_FDCWD, other, RENAME_EXCHANGE);
          },
  };
  return calls;
}

}  // namespace quartet
