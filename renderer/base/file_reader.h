#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace quartet {

/// A regular file being read, whose end is known: nobody can make it ask for more memory than the
/// file has bytes.
class FileReader {
 public:
  /// Throws std::runtime_error "cannot read PATH: REASON".
  explicit FileReader(const std::filesystem::path& path);
  ~FileReader();
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return position_; }
  std::uint64_t left() const { return position_ < size_ ? size_ - position_ : 0; }
  void seek(std::uint64_t position) { position_ = position; }

  /// Just so many bytes. Throws std::runtime_error with the reason alone, for instance if there are
  /// not so many.
  void read(void* bytes, std::size_t size);

 private:
  std::size_t read_at(std::uint64_t position, char* bytes, std::size_t size) const;

  int file_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0;
  std::vector<char> buffer_;        // what is read ahead for small reads
  std::uint64_t buffer_begin_ = 0;  // where in the file it begins
};

}  // namespace quartet
