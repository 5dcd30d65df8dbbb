#include "renderer/base/file_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "renderer/base/system_calls.h"

namespace quartet {
namespace {

constexpr std::size_t read_ahead_bytes = std::size_t(1) << 16;

[[noreturn]] void throw_cannot_read(const std::filesystem::path& path, std::string_view reason) {
  throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), reason));
}

}  // namespace

FileReader::FileReader(const std::filesystem::path& path) {
  buffer_.reserve(read_ahead_bytes);
  // O_NONBLOCK: opening a pipe would wait for somebody to write into it.
  file_ = system_calls().open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK, 0);
  if (file_ < 0) {
    throw_cannot_read(path, std::generic_category().message(errno));
  }
  struct stat status {};
  const bool known = ::fstat(file_, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    system_calls().close(file_);
    throw_cannot_read(path, S_ISDIR(status.st_mode)
                                ? "it is a folder; a file would be right"
                                : "it is a pipe, socket or device; a regular file would be right");
  }
  size_ = std::uint64_t(status.st_size);
}

FileReader::~FileReader() {
  system_calls().close(file_);
}

/// As many bytes as one call gives; 0 at the end.
std::size_t FileReader::read_at(std::uint64_t position, char* bytes, std::size_t size) const {
  for (;;) {
    const ssize_t got = system_calls().read(file_, bytes, size, off_t(position));
    if (got >= 0) {
      return std::size_t(got);
    }
    if (errno != EINTR) {
      throw std::runtime_error(std::generic_category().message(errno));
    }
  }
}

void FileReader::read(void* bytes, std::size_t size) {
  if (size > left()) {
    throw std::runtime_error(
        fmt::format("it ends too early: {} bytes were to follow at byte {}, and it has {}", size,
                    position_, size_));
  }
  char* into = static_cast<char*>(bytes);
  while (size > 0) {
    if (position_ >= buffer_begin_ && position_ < buffer_begin_ + buffer_.size()) {
      const std::size_t at = std::size_t(position_ - buffer_begin_);
      const std::size_t some = std::min(size, buffer_.size() - at);
      std::memcpy(into, buffer_.data() + at, some);
      into += some;
      size -= some;
      position_ += some;
      continue;
    }
    std::size_t got = 0;
    if (size >= read_ahead_bytes) {
      got = read_at(position_, into, size);
      into += got;
      size -= got;
      position_ += got;
    } else {
      buffer_.resize(read_ahead_bytes);
      buffer_begin_ = position_;
      got = read_at(position_, buffer_.data(), buffer_.size());
      buffer_.resize(got);
    }
    if (got == 0) {
      throw std::runtime_error("it was cut while it was read");
    }
  }
}

}  // namespace quartet
