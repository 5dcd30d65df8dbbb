#include "renderer/image/staged_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "renderer/image/png.h"
#include "tests/image/temp_folder.h"

namespace quartet {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

using Names = std::vector<std::string>;

TEST(StagedFiles, AppearOnCommitAndReplaceOldOnes) {
  const TempFolder folder;
  write_bytes_to(folder / "panels.csv", "old");
  {
    StagedFiles staged(folder.path());
    staged.write("panels.csv", "new");
    const fs::path image = staged.stage("images.png");
    EXPECT_EQ(image.parent_path(), folder.path());
    write_png(image, DisplayImage(2, 2));
    EXPECT_EQ(bytes_of(folder / "panels.csv"), "old");
    EXPECT_FALSE(fs::exists(folder / "images.png"));
    staged.commit();
  }
  EXPECT_EQ(names_in(folder.path()), (Names{"images.png", "panels.csv"}));
  EXPECT_EQ(bytes_of(folder / "panels.csv"), "new");
  EXPECT_EQ(read_png(folder / "images.png"), DisplayImage(2, 2));
}

TEST(StagedFiles, WithoutCommitLeaveNothingAndOldFilesWhole) {
  const TempFolder folder;
  write_bytes_to(folder / "panels.csv", "old");
  const std::string error = error_of([&] {
    StagedFiles staged(folder.path());
    staged.write("panels.csv", "new");
    staged.write("panels.json", "{}");
    throw std::runtime_error("interrupted");
  });
  EXPECT_EQ(error, "interrupted");
  EXPECT_EQ(names_in(folder.path()), Names{"panels.csv"});
  EXPECT_EQ(bytes_of(folder / "panels.csv"), "old");
}

TEST(StagedFiles, CreateTheFolderAndRemoveItIfAbandoned) {
  const TempFolder folder;
  for (const char* name : {"out/deep", "out/deep/"}) {
    { StagedFiles(folder / name).write("a.txt", "a"); }
    EXPECT_EQ(names_in(folder.path()), Names{});
  }
  {
    StagedFiles staged(folder / "out/deep");
    staged.write("a.txt", "a");
    staged.commit();
  }
  EXPECT_EQ(bytes_of(folder / "out/deep/a.txt"), "a");
}

TEST(StagedFiles, KeepACreatedFolderThatOthersUse) {
  const TempFolder folder;
  {
    StagedFiles staged(folder / "out");
    staged.write("a.txt", "a");
    write_bytes_to(folder / "out/other.txt", "other");
  }
  EXPECT_EQ(names_in(folder / "out"), Names{"other.txt"});
}

TEST(StagedFiles, KeepAnEmptyFolderThatWasThere) {
  const TempFolder folder;
  { StagedFiles(folder.path()).write("a.txt", "a"); }
  EXPECT_TRUE(fs::is_directory(folder.path()));
}

TEST(StagedFiles, SayWhyAFolderCannotBeUsed) {
  const TempFolder folder;
  write_bytes_to(folder / "file", "");
  for (const fs::path& bad : {folder / "file", folder / "file/deep", fs::path("/proc/quartet")}) {
    const std::string error = error_of([&] { StagedFiles staged(bad); });
    EXPECT_TRUE(error.starts_with("cannot create the output folder " + bad.string() + ": "))
        << error;
  }
  EXPECT_TRUE(error_of([] {
                StagedFiles staged("/proc");
              }).starts_with("cannot write into the folder /proc: "));
  EXPECT_EQ(names_in(folder.path()), Names{"file"});
}

TEST(StagedFiles, RefuseNamesThatAreNoFiles) {
  const TempFolder folder;
  fs::create_directory(folder / "images.png");
  StagedFiles staged(folder.path());
  for (const char* name : {"", ".", "..", "a/b.png", "/tmp/a.png", "b/"}) {
    EXPECT_NE(error_of([&] { staged.stage(name); }).find("is no name for an output file"),
              std::string::npos)
        << name;
  }
  EXPECT_NE(error_of([&] { staged.stage("images.png"); }).find("it is a folder"),
            std::string::npos);
  staged.write("a.txt", "a");
  EXPECT_NE(error_of([&] { staged.write("a.txt", "b"); }).find("written twice"), std::string::npos);
}

TEST(StagedFiles, CommitNothingIfOneWasNeverWritten) {
  const TempFolder folder;
  write_bytes_to(folder / "a.txt", "old");
  {
    StagedFiles staged(folder.path());
    staged.write("a.txt", "new");
    staged.stage("b.txt");
    EXPECT_EQ(error_of([&] { staged.commit(); }),
              "cannot write " + (folder / "b.txt").string() + ": No such file or directory");
    EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  }
  EXPECT_EQ(names_in(folder.path()), Names{"a.txt"});
}

TEST(StagedFiles, AFullDiskLeavesTheOldFileWhole) {
  const TempFolder folder;
  write_bytes_to(folder / "images.png", "old");
  const std::string error = error_of([&] {
    StagedFiles staged(folder.path());
    const fs::path path = staged.stage("images.png");
    fs::create_symlink("/dev/full", path);
    write_png(path, DisplayImage(50, 50));
    staged.commit();
  });
  EXPECT_NE(error.find("No space left on device"), std::string::npos) << error;
  EXPECT_NE(error.find("images.png"), std::string::npos) << error;
  EXPECT_EQ(names_in(folder.path()), Names{"images.png"});
  EXPECT_EQ(bytes_of(folder / "images.png"), "old");
}

}  // namespace
}  // namespace quartet
