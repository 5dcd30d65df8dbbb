#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/files/leftovers.h"
#include "renderer/files/staging_folder.h"

namespace quartet {

/// Output files that appear together or not at all. They are written into a hidden folder beside
/// their names (see StagingFolder) and get them by commit(); without a commit the destructor
/// removes them, and the folders it had to create. So a failed or interrupted export leaves the old
/// files whole and nothing half-written.
///
/// What is kept of a file that is replaced: its permissions, and its owner if that is allowed. A
/// symbolic link stays and what it leads to is replaced, or made where that does not exist yet. A
/// file that is write-protected is not replaced, whoever asks.
///
/// Several files are a set, and get a list that names them, `set_list_name`. If the folder holds
/// nothing else, old and new folder change places in one step: at no moment, and after no kind of
/// end, is it a mixture. Otherwise, or where the disk or somebody at work in the folder does not
/// allow that, the files are renamed one after the other: an error takes all back, and a program
/// that is killed meanwhile leaves the rest to the next one that writes into the folder.
///
/// For a single file: StagedFiles staged(path.parent_path(), {path.filename().string()});
/// staged.stage(path.filename().string()).
class StagedFiles {
 public:
  /// The file that names those of a set: the run, and checksum (CRC-32), bytes and name of each.
  static constexpr std::string_view set_list_name = "quartet-files.txt";

  /// Creates the folder if need be (empty means the current one), tries to write in it, and looks
  /// whether files of these names can be written. Removes what dead programs have left there.
  /// Throws std::runtime_error that names the folder or file and the reason.
  explicit StagedFiles(const std::filesystem::path& folder,
                       const std::vector<std::string>& names = {});
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// A random number in hexadecimal, for files that can hold it: equal in all of a set.
  const std::string& run() const { return run_; }

  /// The temporary path to write `final_name`, a name without folders, to. Throws
  /// std::runtime_error if the name is no file name, is that of something that cannot be replaced,
  /// or was staged before. A folder that went away is made again.
  std::filesystem::path stage(std::string_view final_name);

  /// Stages a text file and writes it. Throws std::runtime_error, for instance on a full disk.
  void write(std::string_view final_name, std::string_view text);

  /// Makes all staged files durable, then gives them their names. Throws std::runtime_error if one
  /// of them was never written or cannot be renamed. Where several programs write the same file,
  /// `wanted` is asked while none of the others can change it: if not, all stays as it is, and
  /// false is returned.
  bool commit(const std::function<bool()>& wanted = {});

  /// Work that took long: `write`, which stages and writes files, then commit(). If that fails it
  /// is done once more in a new folder among the system's temporary files, and the
  /// std::runtime_error says where that is.
  bool finish(const std::function<void()>& write, const std::function<bool()>& wanted = {});

 private:
  struct Staged {
    StagingFolder* staging;
    std::string name;  ///< in both folders
    std::filesystem::path final;
    // Known once commit() renames, so that it needs no memory between two files.
    bool replaces = false;  ///< whether there is one of that name
    std::filesystem::path source, backup;

    std::filesystem::path temporary() const { return staging->path() / name; }
  };

  void make_folder();
  void clear_dead();
  void remove_created_folders();
  void discard();
  StagingFolder& staging_in(const std::filesystem::path& folder);
  void list_set();
  std::string with_final_names(std::string text) const;
  bool exchange_folder();
  void rename_each();
  void take_back(std::size_t renamed);

  std::filesystem::path folder_;
  std::string run_;
  std::vector<std::pair<std::filesystem::path, Leftover>> created_folders_;  // innermost first
  std::vector<std::unique_ptr<StagingFolder>> stagings_;
  std::vector<Staged> staged_;
  std::vector<Leftover> leftovers_;
};

}  // namespace quartet
