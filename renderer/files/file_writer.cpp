#include "renderer/files/file_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/types.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

#include "renderer/base/system_calls.h"

namespace quartet {

namespace {

constexpr std::size_t write_buffer_bytes = std::size_t(1) << 16;

[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, std::string_view reason) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), reason));
}

std::string text_of(int error) {
  return std::generic_category().message(error);
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path) : path_(path) {
  buffer_.reserve(write_buffer_bytes);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC;
  file_ = system_calls().open(path.c_str(), flags, 0666);
  if (file_ < 0) {
    throw_cannot_write(path_, text_of(errno));
  }
}

FileWriter::~FileWriter() {
  if (file_ >= 0) {
    system_calls().close(file_);
  }
}

void FileWriter::fail_with(int error) {
  error_ = error_ != 0 ? error_ : error != 0 ? error : EIO;
  throw_cannot_write(path_, text_of(error_));
}

void FileWriter::put(const char* bytes, std::size_t size) {
  if (error_ != 0) {
    fail_with(error_);
  }
  while (size > 0) {
    const ssize_t written = system_calls().write(file_, bytes, size, off_t(flushed_));
    if (written < 0 && errno == EINTR) {
      continue;
    }
    if (written <= 0) {
      fail_with(written < 0 ? errno : ENOSPC);
    }
    bytes += written;
    size -= std::size_t(written);
    flushed_ += std::size_t(written);
  }
}

void FileWriter::flush() {
  put(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void FileWriter::write(const void* bytes, std::size_t size) {
  const char* const from = static_cast<const char*>(bytes);
  if (buffer_.size() + size > write_buffer_bytes) {
    flush();
  }
  if (size > write_buffer_bytes) {
    put(from, size);
  } else {
    buffer_.insert(buffer_.end(), from, from + size);
  }
}

void FileWriter::seek(std::uint64_t position) {
  flush();
  flushed_ = position;
}

void FileWriter::close() {
  if (error_ == 0) {
    flush();
  }
  const int file = file_;
  file_ = -1;
  const bool closed = system_calls().close(file) == 0;
  if (!closed || error_ != 0) {
    fail_with(errno);
  }
}

void FileWriter::fail(std::string_view reason) {
  if (error_ != 0) {
    fail_with(error_);
  }
  throw_cannot_write(path_, reason);
}

}  // namespace quartet
