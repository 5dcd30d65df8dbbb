#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/files/leftovers.h"

namespace quartet {

/// A hidden folder in which files are made before they get their names: NAME.part with a random
/// name, open to this user alone, so that nobody can foresee or replace what is in it. It is locked
/// as long as its writer lives: a lock that can be taken proves that the writer is dead, also where
/// processes cannot see each other but share a disk of this machine.
class StagingFolder {
 public:
  /// Throws std::runtime_error "cannot write into the folder PARENT: REASON".
  explicit StagingFolder(const std::filesystem::path& parent);
  ~StagingFolder();  ///< removes it, with the files that are in it
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const std::filesystem::path& parent() const { return parent_; }
  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return folder_; }

  /// Into another folder of the same disk, or back. False if that is not possible.
  bool move_to(const std::filesystem::path& parent);

  /// From here on what is in it is meant to be in the parent, and whoever finds it there after the
  /// writer's death moves it: the files first, `last` at the end. False if that is not possible.
  bool begin_commit();
  /// Takes that back.
  void give_up_commit();

  /// Leaves it where it is, for others to finish what it was begun for.
  void leave() { left_ = true; }

 private:
  std::filesystem::path parent_;
  std::filesystem::path path_;
  int folder_ = -1;
  bool left_ = false;
  std::optional<Leftover> leftover_;
};

/// What a dead writer left in `parent`: unfinished work is removed, and what was being given its
/// names (see begin_commit) gets them, the file `last` as the last one. What cannot be proved to be
/// dead stays: that of other users, and all on disks that other machines may write to.
void clear_dead_staging(const std::filesystem::path& parent, const std::string& last);

/// The name of a file in a staging folder that keeps what `name` was before.
std::string backup_name(const std::string& name);

/// Keeps others from changing files in a folder by this means meanwhile. Waits for them for some
/// seconds, and goes on without where locks are not possible.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_ = -1;
};

/// Waits until the names in a folder are on the disk; some file systems cannot be asked.
void sync_folder(const std::filesystem::path& folder);

}  // namespace quartet
