#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/files/staged_files.h"

namespace quartet {

/// A file of text that an option asks for. Whether it can be written is known before the work that
/// the text is made of.
class OptionalFile {
 public:
  /// Of an empty path, none.
  explicit OptionalFile(const std::filesystem::path& path) : name_(path.filename().string()) {
    if (!path.empty()) {
      files_.emplace(path.parent_path(), std::vector{name_});
    }
  }

  /// Writes text() if it was asked for.
  template <class Text>
  void write(const Text& text) {
    if (files_) {
      files_->finish([&] { files_->write(name_, text()); });
    }
  }

 private:
  std::string name_;
  std::optional<StagedFiles> files_;
};

}  // namespace quartet
