#include "renderer/image/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "renderer/image/file_writer.h"

namespace quartet {

namespace fs = std::filesystem;

namespace {

fs::path temporary_path(const fs::path& folder, std::string_view name) {
  return folder / fmt::format("{}.{}.part", name, ::getpid());
}

/// Waits until the file is on the disk: some file systems report a full disk or quota only then.
/// Throws std::runtime_error that names the final path.
void make_durable(const fs::path& temporary, const fs::path& final) {
  const auto fail = [&](int error) {
    throw std::runtime_error(
        fmt::format("cannot write {}: {}", final.string(), std::generic_category().message(error)));
  };
  const int file = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    fail(errno);
  }
  const int synced = ::fsync(file);
  const int error = errno;
  ::close(file);
  // EINVAL: a file system that cannot be asked.
  if (synced != 0 && error != EINVAL) {
    fail(error);
  }
}

}  // namespace

StagedFiles::StagedFiles(const fs::path& folder) : folder_(folder.empty() ? "." : folder) {
  std::error_code error;
  for (fs::path missing = folder_; !missing.empty() && !fs::exists(missing, error);
       missing = missing.parent_path()) {
    created_folders_.push_back(missing);
  }
  try {
    fs::create_directories(folder_, error);
    if (error || !fs::is_directory(folder_)) {
      throw std::runtime_error(
          fmt::format("cannot create the output folder {}: {}", folder_.string(),
                      error ? error.message() : "a file of that name is in the way"));
    }
    check_writable();
  } catch (...) {
    remove_created_folders();
    throw;
  }
}

StagedFiles::~StagedFiles() {
  for (const Staged& file : staged_) {
    std::error_code ignored;
    fs::remove(file.temporary, ignored);
  }
  remove_created_folders();
}

void StagedFiles::check_writable() const {
  // Permission bits would not tell about read-only file systems, nor about root.
  const fs::path trial = temporary_path(folder_, ".quartet");
  const int file = ::open(trial.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) {
    throw std::runtime_error(fmt::format("cannot write into the folder {}: {}", folder_.string(),
                                         std::generic_category().message(errno)));
  }
  ::close(file);
  ::unlink(trial.c_str());
}

void StagedFiles::remove_created_folders() {
  // fs::remove leaves a folder that is not empty.
  for (const fs::path& folder : created_folders_) {
    std::error_code ignored;
    fs::remove(folder, ignored);
  }
}

fs::path StagedFiles::stage(std::string_view final_name) {
  const fs::path name(final_name);
  if (name.empty() || name != name.filename() || name == "." || name == "..") {
    throw std::runtime_error(fmt::format(
        "'{}' is no name for an output file; one such as images.png would be right", final_name));
  }
  const fs::path final = folder_ / name;
  if (fs::is_directory(final)) {
    throw std::runtime_error(fmt::format(
        "cannot write {}: it is a folder; the name of a file would be right", final.string()));
  }
  if (std::ranges::find(staged_, final, &Staged::final) != staged_.end()) {
    throw std::runtime_error(fmt::format("{} would be written twice", final.string()));
  }
  staged_.push_back({temporary_path(folder_, final_name), final});
  return staged_.back().temporary;
}

void StagedFiles::write(std::string_view final_name, std::string_view text) {
  FileWriter file(stage(final_name));
  file.write(text);
  file.close();
}

void StagedFiles::commit() {
  for (const Staged& file : staged_) {
    make_durable(file.temporary, file.final);
  }
  for (const Staged& file : staged_) {
    std::error_code error;
    fs::rename(file.temporary, file.final, error);
    if (error) {
      throw std::runtime_error(
          fmt::format("cannot write {}: {}", file.final.string(), error.message()));
    }
  }
  staged_.clear();
  created_folders_.clear();
}

}  // namespace quartet
