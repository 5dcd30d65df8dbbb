#include "renderer/image/file_writer.h"

#include <fmt/format.h>

#include <sys/types.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace quartet {

namespace {

[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, std::string_view reason) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), reason));
}

std::string text_of(int error) {
  return std::generic_category().message(error);
}

}  // namespace

FileWriter::FileWriter(const std::filesystem::path& path)
    : path_(path), file_(std::fopen(path.c_str(), "wb")) {
  if (file_ == nullptr) {
    throw_cannot_write(path_, text_of(errno));
  }
}

FileWriter::~FileWriter() {
  if (file_ != nullptr) {
    std::fclose(file_);
  }
}

void FileWriter::check(bool ok) {
  if (!ok) {
    if (error_ == 0) {
      error_ = errno != 0 ? errno : EIO;
    }
    throw_error();
  }
}

void FileWriter::throw_error() const {
  throw_cannot_write(path_, text_of(error_));
}

void FileWriter::write(const void* bytes, std::size_t size) {
  check(size == 0 || std::fwrite(bytes, 1, size, file_) == size);
  position_ += size;
}

void FileWriter::seek(std::uint64_t position) {
  check(fseeko(file_, static_cast<off_t>(position), SEEK_SET) == 0);
  position_ = position;
}

void FileWriter::close() {
  std::FILE* file = file_;
  file_ = nullptr;
  const bool closed = std::fclose(file) == 0;
  if (error_ != 0) {
    throw_error();
  }
  check(closed);
}

void FileWriter::fail(std::string_view reason) {
  if (error_ != 0) {
    throw_error();
  }
  throw_cannot_write(path_, reason);
}

}  // namespace quartet
