#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace quartet {

/// Output files that appear together or not at all. Each is written under a temporary name in its
/// own folder (NAME.PID.part) and renamed by commit(); without a commit the destructor removes
/// them, and the folders it had to create. So a failed or interrupted export leaves the old files
/// whole and nothing half-written.
///
/// For a single file: StagedFiles staged(path.parent_path());
/// staged.stage(path.filename().string()).
class StagedFiles {
 public:
  /// Creates the folder if need be (empty means the current one) and tries to write in it. Throws
  /// std::runtime_error that names the folder and the reason.
  explicit StagedFiles(const std::filesystem::path& folder);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// The temporary path to write `final_name`, a name without folders, to. Throws
  /// std::runtime_error if the name is no file name, is that of an existing folder, or was staged
  /// before.
  std::filesystem::path stage(std::string_view final_name);

  /// Stages a text file and writes it. Throws std::runtime_error, for instance on a full disk.
  void write(std::string_view final_name, std::string_view text);

  /// Makes all staged files durable, then renames them over the old ones. Throws
  /// std::runtime_error if one of them was never written or cannot be renamed.
  void commit();

 private:
  struct Staged {
    std::filesystem::path temporary, final;
  };

  void check_writable() const;
  void remove_created_folders();

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> created_folders_;  // innermost first
  std::vector<Staged> staged_;
};

}  // namespace quartet
