#include "renderer/base/regular_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "renderer/base/cancel.h"
#include "renderer/base/system_calls.h"

namespace quartet {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view reason) {
  throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), reason));
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  fail(path, std::generic_category().message(error));
}

/// An open file descriptor.
class OpenFile {
 public:
  // O_NONBLOCK: opening a pipe would wait for somebody to write into it.
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(system_calls().open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK, 0)) {
    if (descriptor_ < 0) {
      fail(path, errno);
    }
  }
  ~OpenFile() { system_calls().close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

std::size_t checked_size(const OpenFile& file, const std::filesystem::path& path) {
  struct stat status {};
  if (::fstat(file.descriptor(), &status) != 0) {
    fail(path, errno);
  }
  if (S_ISDIR(status.st_mode)) {
    fail(path, "it is a folder; a file would be right");
  }
  if (!S_ISREG(status.st_mode)) {
    fail(path, "it is a pipe, socket or device; a regular file would be right");
  }
  return std::size_t(status.st_size);
}

}  // namespace

std::size_t regular_file_size(const std::filesystem::path& path) {
  return checked_size(OpenFile(path), path);
}

std::string read_regular_file(const std::filesystem::path& path, std::size_t limit,
                              const std::stop_token& stop) {
  const OpenFile file(path);
  const std::size_t size = checked_size(file, path);
  if (size > limit) {
    fail(path, fmt::format("it has {} bytes; at most {} would be right", size, limit));
  }
  constexpr std::size_t step = std::size_t(1) << 20;
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    check_cancelled(stop);
    const ssize_t got = system_calls().read(file.descriptor(), bytes.data() + done,
                                            std::min(step, size - done), off_t(done));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      fail(path, errno);
    }
    if (got == 0) {
      break;  // it was cut meanwhile; what is there is what it holds now
    }
    done += std::size_t(got);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace quartet
