#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace quartet {

/// A file being written, in a folder that is nobody else's (see StagedFiles); a link is not
/// followed. Any failure (no such folder, disk full) throws std::runtime_error
/// "cannot write PATH: REASON". The first failure is kept and thrown again by close(), because the
/// image libraries swallow some errors in their destructors.
class FileWriter {
 public:
  explicit FileWriter(const std::filesystem::path& path);
  ~FileWriter();  ///< closes, and ignores errors: whoever wants the file calls close()
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void seek(std::uint64_t position);
  std::uint64_t position() const { return flushed_ + buffer_.size(); }

  /// Hands everything to the operating system; after it returns the file is complete.
  void close();

  /// For a library that failed while writing this file: throws the file's own error if there is
  /// one, such as a full disk, else the library's reason.
  [[noreturn]] void fail(std::string_view reason);

 private:
  void put(const char* bytes, std::size_t size);
  void flush();
  [[noreturn]] void fail_with(int error);

  std::filesystem::path path_;
  std::vector<char> buffer_;   // not yet handed to the operating system
  std::uint64_t flushed_ = 0;  // where in the file the buffer begins
  int file_ = -1;
  int error_ = 0;  // errno of the first failure
};

}  // namespace quartet
