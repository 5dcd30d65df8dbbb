#include "renderer/files/staged_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "renderer/files/file_target.h"
#include "renderer/files/file_writer.h"

namespace quartet {

namespace fs = std::filesystem;

namespace {

std::string random_hexadecimal() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

/// A new folder among the system's temporary files.
fs::path rescue_folder() {
  return fs::temp_directory_path() / ("quartet-rescued-" + random_hexadecimal());
}

void check_name(std::string_view name) {
  const fs::path path(name);
  if (path.empty() || path != path.filename() || path == "." || path == "..") {
    throw std::runtime_error(fmt::format(
        "'{}' is no name for an output file; one such as images.png would be right", name));
  }
}

}  // namespace

StagedFiles::StagedFiles(const fs::path& folder, const std::vector<std::string>& names)
    : folder_(folder.empty() ? "." : folder), run_(random_hexadecimal()) {
  try {
    make_folder();
    clear_dead();
    // Permission bits would not tell about read-only file systems, nor about root.
    const StagingFolder trial(folder_);
    for (const std::string& name : names) {
      check_name(name);
      target_of(folder_ / name);
    }
  } catch (...) {
    remove_created_folders();
    throw;
  }
}

/// Where this or an earlier program may have died while it wrote into this folder.
void StagedFiles::clear_dead() {
  const std::string last(set_list_name);
  std::error_code ignored;
  clear_dead_staging(fs::canonical(folder_, ignored).parent_path(), last);
  const FolderLock lock(folder_);
  clear_dead_staging(folder_, last);
}

StagedFiles::~StagedFiles() {
  discard();
  remove_created_folders();
}

void StagedFiles::make_folder() {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path each = folder_; !each.empty() && !fs::exists(each, error);
       each = each.parent_path()) {
    missing.push_back(each);
  }
  std::ranges::reverse(missing);
  for (const fs::path& each : missing) {
    created_folders_.emplace(created_folders_.begin(), each, Leftover(each));
    if (!fs::create_directory(each, error)) {
      created_folders_.erase(created_folders_.begin());
    }
  }
  std::error_code ignored;
  if (!fs::is_directory(folder_, ignored)) {
    throw std::runtime_error(
        fmt::format("cannot create the output folder {}: {}", folder_.string(),
                    error ? error.message() : "a file of that name is in the way"));
  }
}

void StagedFiles::remove_created_folders() {
  // fs::remove leaves a folder that is not empty.
  for (const auto& [folder, leftover] : created_folders_) {
    std::error_code ignored;
    fs::remove(folder, ignored);
  }
  created_folders_.clear();
}

void StagedFiles::discard() {
  staged_.clear();
  stagings_.clear();
  leftovers_.clear();
}

StagingFolder& StagedFiles::staging_in(const fs::path& folder) {
  for (const auto& staging : stagings_) {
    if (staging->parent() == folder) {
      return *staging;
    }
  }
  stagings_.push_back(std::make_unique<StagingFolder>(folder));
  return *stagings_.back();
}

fs::path StagedFiles::stage(std::string_view final_name) {
  check_name(final_name);
  std::error_code ignored;
  if (!fs::exists(folder_, ignored)) {
    make_folder();
  }
  const fs::path final = target_of(folder_ / final_name);
  if (std::ranges::find(staged_, final, &Staged::final) != staged_.end()) {
    throw std::runtime_error(fmt::format("{} would be written twice", final.string()));
  }
  staged_.push_back(
      {&staging_in(final.parent_path()), final.filename().string(), final, false, {}, {}});
  fs::path temporary = staged_.back().temporary();
  leftovers_.emplace_back(temporary);
  return temporary;
}

void StagedFiles::write(std::string_view final_name, std::string_view text) {
  FileWriter file(stage(final_name));
  file.write(text);
  file.close();
}

/// The list that says what belongs together; it gets its name last.
void StagedFiles::list_set() {
  std::string text = fmt::format(
      "These files belong together. Others in this folder, and files whose CRC-32 or bytes differ, "
      "do not.\nrun {}\n",
      run_);
  for (const Staged& file : staged_) {
    text += fmt::format("{} {}\n", checksum_text(file.temporary()), file.name);
  }
  write(set_list_name, text);
}

bool StagedFiles::commit(const std::function<bool()>& wanted) {
  for (const Staged& file : staged_) {
    make_durable(file.temporary(), file.final);
  }
  if (staged_.size() > 1) {
    list_set();
    make_durable(staged_.back().temporary(), staged_.back().final);
  }
  {
    const FolderLock lock(staged_.empty() ? folder_ : staged_.front().staging->parent());
    // Of one who died since then and was giving his files their names: they would come later, over
    // these.
    clear_dead_staging(folder_, std::string(set_list_name));
    if (wanted && !wanted()) {
      return false;
    }
    const HoldSignals hold;
    if (!exchange_folder()) {
      rename_each();
    }
    discard();
    created_folders_.clear();
  }
  return true;
}

/// An error of a writer, which knows the temporary name alone.
std::string StagedFiles::with_final_names(std::string text) const {
  for (const Staged& file : staged_) {
    const std::string temporary = file.temporary().string();
    if (const std::size_t at = text.find(temporary); at != std::string::npos) {
      text.replace(at, temporary.size(), file.final.string());
    }
  }
  return text;
}

bool StagedFiles::finish(const std::function<void()>& write, const std::function<bool()>& wanted) {
  std::string reason;
  bool out_of_memory = false;
  try {
    write();
    return commit(wanted);
  } catch (const std::exception& error) {
    out_of_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    reason = with_final_names(error.what());
  }
  discard();
  remove_created_folders();
  try {
    folder_ = rescue_folder();
    make_folder();
    write();
    commit();
  } catch (const std::exception&) {
    // It is not the place that is wrong.
    if (out_of_memory) {
      throw std::bad_alloc();
    }
    throw std::runtime_error(reason);
  }
  throw std::runtime_error(fmt::format("{}; what was made is in {}", reason, folder_.string()));
}

}  // namespace quartet
