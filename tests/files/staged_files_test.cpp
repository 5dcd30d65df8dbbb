#include "renderer/files/staged_files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/terminal/interrupt.h"
#include "renderer/files/png.h"
#include "tests/files/faulty_calls.h"
#include "tests/files/temp_folder.h"

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

const std::string set_list(StagedFiles::set_list_name);

/// Writes a set of these files, all with this text.
void write_set(const fs::path& folder, const Names& names, const std::string& text) {
  StagedFiles staged(folder);
  for (const std::string& name : names) {
    staged.write(name, text);
  }
  staged.commit();
}

unsigned mode_of(const fs::path& path) {
  return unsigned(fs::status(path).permissions());
}

/// Runs `action` in a process of its own, which `signal` must end.
void expect_killed(int signal, const std::function<void()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), signal);
}

TEST(StagedFiles, AppearOnCommitAndReplaceOldOnes) {
  const TempFolder folder;
  write_bytes_to(folder / "panels.csv", "old");
  {
    StagedFiles staged(folder.path());
    staged.write("panels.csv", "new");
    const fs::path image = staged.stage("images.png");
    write_png(image, DisplayImage(2, 2));
    EXPECT_EQ(bytes_of(folder / "panels.csv"), "old");
    EXPECT_FALSE(fs::exists(folder / "images.png"));
    staged.commit();
  }
  EXPECT_EQ(names_in(folder.path()), (Names{"images.png", "panels.csv", set_list}));
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
    const FullDisk full;
    write_png(path, DisplayImage(50, 50));
    staged.commit();
  });
  EXPECT_NE(error.find("No space left on device"), std::string::npos) << error;
  EXPECT_NE(error.find("images.png"), std::string::npos) << error;
  EXPECT_EQ(names_in(folder.path()), Names{"images.png"});
  EXPECT_EQ(bytes_of(folder / "images.png"), "old");
}

TEST(StagedFiles, KeepPermissionsAndLinksAndRespectWriteProtection) {
  const TempFolder folder;
  fs::create_directory(folder / "deep");
  write_bytes_to(folder / "secret.txt", "old");
  write_bytes_to(folder / "deep/far.txt", "old");
  fs::permissions(folder / "secret.txt", fs::perms(0600));
  fs::create_symlink("deep/far.txt", folder / "link.txt");
  fs::create_symlink("deep/new.txt", folder / "dangling.txt");
  write_set(folder.path(), {"secret.txt", "link.txt", "dangling.txt", "plain.txt"}, "new");
  EXPECT_EQ(mode_of(folder / "secret.txt"), 0600u);
  const unsigned mask = umask(0);
  umask(mask);
  EXPECT_EQ(mode_of(folder / "plain.txt"), 0666u & ~mask);
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling.txt"));
  for (const char* name : {"secret.txt", "deep/far.txt", "deep/new.txt", "plain.txt"}) {
    EXPECT_EQ(bytes_of(folder / name), "new") << name;
  }
  EXPECT_EQ(names_in(folder / "deep"), (Names{"far.txt", "new.txt"}));

  fs::permissions(folder / "secret.txt", fs::perms(0444));
  fs::create_symlink("nowhere/new.txt", folder / "lost.txt");
  fs::create_symlink("loop.txt", folder / "loop.txt");
  fs::create_symlink("/dev/null", folder / "null.txt");
  ASSERT_EQ(mkfifo((folder / "pipe.txt").c_str(), 0600), 0);
  const std::vector<std::pair<std::string, std::string>> refused{
      {"secret.txt", "write-protected (mode 444)"},
      {"lost.txt", "whose folder does not exist"},
      {"loop.txt", "leads back to itself"},
      {"null.txt", "it is a pipe, socket or device"},
      {"pipe.txt", "it is a pipe, socket or device"}};
  for (const auto& [name, reason] : refused) {
    const auto tries = std::to_array<std::function<void()>>(
        {[&, name = name] { StagedFiles staged(folder.path(), {name}); },
         [&, name = name] { write_set(folder.path(), {name}, "new"); }});
    for (const auto& try_it : tries) {
      const std::string error = error_of(try_it);
      EXPECT_TRUE(error.starts_with("cannot write " + (folder / name).string() + ": ")) << error;
      EXPECT_NE(error.find(reason), std::string::npos) << error;
    }
  }
  EXPECT_EQ(bytes_of(folder / "secret.txt"), "new");
}

TEST(StagedFiles, ASetNamesItsFilesWithTheirChecksums) {
  const TempFolder folder;
  StagedFiles staged(folder / "out");
  staged.write("a.txt", "123456789");
  staged.write("b.txt", "");
  const std::string run = staged.run();
  staged.commit();
  EXPECT_EQ(run.size(), 16u);
  // The checksum's own test value.
  const std::string list = bytes_of(folder / "out" / set_list);
  EXPECT_NE(list.find("\nrun " + run + "\ncbf43926 9 a.txt\n00000000 0 b.txt\n"), std::string::npos)
      << list;
}

TEST(StagedFiles, LeaveStrangersAlone) {
  const TempFolder folder;
  const fs::path out = folder / "out";
  write_set(out, {"a.txt", "b.txt"}, "old");
  write_bytes_to(out / "notes.txt", "mine");
  fs::create_directory(out / "deep");
  write_bytes_to(out / "deep/more.txt", "mine");
  write_set(out, {"a.txt", "b.txt"}, "new");
  EXPECT_EQ(names_in(out), (Names{"a.txt", "b.txt", "deep", "notes.txt", set_list}));
  EXPECT_EQ(bytes_of(out / "a.txt"), "new");
  EXPECT_EQ(bytes_of(out / "notes.txt"), "mine");
  EXPECT_EQ(bytes_of(out / "deep/more.txt"), "mine");
  EXPECT_EQ(names_in(folder.path()), Names{"out"});
}

TEST(StagedFiles, AFolderThatSomebodyIsInStaysTheSameOne) {
  const TempFolder folder;
  const fs::path out = folder / "out";
  write_set(out, {"a.txt", "b.txt"}, "old");
  const fs::path before = fs::current_path();
  fs::current_path(out);
  write_set(".", {"a.txt", "b.txt"}, "new");
  EXPECT_EQ(bytes_of("a.txt"), "new");
  fs::current_path(before);
  EXPECT_EQ(bytes_of(out / "b.txt"), "new");
}

/// All files of the set have this text, and nothing else is there.
void expect_set(const fs::path& folder, const std::string& text) {
  const Names names{"a.txt", "b.txt", "c.txt"};
  for (const std::string& name : names) {
    EXPECT_EQ(bytes_of(folder / name), text) << name;
  }
  const std::string list = bytes_of(folder / set_list);
  EXPECT_NE(list.find(" c.txt\n"), std::string::npos);
}

TEST(StagedFiles, ASuddenEndLeavesAFolderOfOursOldOrNew) {
  // The n-th change of a name is the last thing that happens.
  for (int last = 1; last < 8; ++last) {
    SCOPED_TRACE(last);
    const TempFolder folder;
    const fs::path out = folder / "out";
    write_set(out, {"a.txt", "b.txt", "c.txt"}, "old");
    const pid_t child = fork();
    if (child == 0) {
      static int left;
      static SystemCalls real;
      left = last;
      real = system_calls();
      system_calls().rename = [](const char* from, const char* to) {
        const int result = real.rename(from, to);
        return --left == 0 ? raise(SIGKILL) : result;
      };
      system_calls().exchange = [](const char* one, const char* other) {
        const int result = real.exchange(one, other);
        return --left == 0 ? raise(SIGKILL) : result;
      };
      write_set(out, {"a.txt", "b.txt", "c.txt"}, "new");
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    const std::string text = bytes_of(out / "a.txt");
    EXPECT_EQ(text, last == 1 ? "old" : "new");
    expect_set(out, text);
    // The next one removes what is left.
    write_set(out, {"a.txt", "b.txt", "c.txt"}, "newer");
    expect_set(out, "newer");
    EXPECT_EQ(names_in(out).size(), 4u);
    EXPECT_EQ(names_in(folder.path()), Names{"out"});
    if (WIFEXITED(status)) {
      EXPECT_GT(last, 2) << "never ended while names were changed";
      return;
    }
  }
  ADD_FAILURE() << "it never came to its end";
}

TEST(StagedFiles, WithStrangersTheNextOneFinishesWhatASuddenEndLeft) {
  for (int last = 1; last < 12; ++last) {
    SCOPED_TRACE(last);
    const TempFolder folder;
    write_bytes_to(folder / "notes.txt", "mine");
    write_set(folder.path(), {"a.txt", "b.txt", "c.txt"}, "old");
    const pid_t child = fork();
    if (child == 0) {
      static int left;
      static SystemCalls real;
      left = last;
      real = system_calls();
      system_calls().rename = [](const char* from, const char* to) {
        const int result = real.rename(from, to);
        return --left == 0 ? raise(SIGKILL) : result;
      };
      write_set(folder.path(), {"a.txt", "b.txt", "c.txt"}, "new");
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    { StagedFiles next(folder.path()); }
    expect_set(folder.path(), "new");
    EXPECT_EQ(names_in(folder.path()), (Names{"a.txt", "b.txt", "c.txt", "notes.txt", set_list}));
    EXPECT_EQ(bytes_of(folder / "notes.txt"), "mine");
    if (WIFEXITED(status)) {
      EXPECT_GT(last, 4) << "never ended while names were changed";
      return;
    }
  }
  ADD_FAILURE() << "it never came to its end";
}

TEST(StagedFiles, WhatIsLeftIsRemovedOnceItsWriterIsDead) {
  const TempFolder folder;
  expect_killed(SIGKILL, [&] {
    StagedFiles staged(folder.path());
    staged.write("a.txt", "dead");
    raise(SIGKILL);
  });
  EXPECT_EQ(names_in(folder.path()).size(), 1u);
  StagedFiles alive(folder.path());
  EXPECT_EQ(names_in(folder.path()), Names{});
  alive.write("a.txt", "alive");
  { StagedFiles other(folder.path()); }
  alive.commit();
  EXPECT_EQ(bytes_of(folder / "a.txt"), "alive");
}

TEST(StagedFiles, ASignalLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    SCOPED_TRACE(signal);
    const TempFolder folder;
    write_bytes_to(folder / "a.txt", "old");
    expect_killed(signal, [&] {
      handle_signals();
      StagedFiles staged(folder.path());
      staged.write("a.txt", "new");
      StagedFiles deep(folder / "out/deep");
      deep.write("b.txt", "new");
      raise(signal);
    });
    EXPECT_EQ(names_in(folder.path()), Names{"a.txt"});
    EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  }
}

TEST(StagedFiles, ASignalWhileNamesAreChangedWaits) {
  const TempFolder folder;
  write_bytes_to(folder / "notes.txt", "mine");
  write_set(folder.path(), {"a.txt", "b.txt", "c.txt"}, "old");
  expect_killed(SIGTERM, [&] {
    handle_signals();
    static SystemCalls real;
    real = system_calls();
    system_calls().rename = [](const char* from, const char* to) {
      raise(SIGTERM);
      return real.rename(from, to);
    };
    write_set(folder.path(), {"a.txt", "b.txt", "c.txt"}, "new");
  });
  expect_set(folder.path(), "new");
  EXPECT_EQ(names_in(folder.path()).size(), 5u);
}

TEST(StagedFiles, AnyCallThatFailsLeavesOldOrNewAndSaysWhich) {
  for (const bool strangers : {false, true}) {
    int calls = 0;
    for (bool failed = true; failed; ++calls) {
      const TempFolder folder;
      const fs::path out = folder / "out";
      write_set(out, {"a.txt", "b.txt", "c.txt"}, "old");
      if (strangers) {
        write_bytes_to(out / "notes.txt", "mine");
      }
      std::string error;
      std::string call;
      {
        const FaultyCalls faults(calls + 1);
        error = error_of([&] { write_set(out, {"a.txt", "b.txt", "c.txt"}, "new"); });
        failed = faults.happened();
        call = faults.call();
      }
      SCOPED_TRACE(fmt::format("{}: {}", call, error));
      expect_set(out, error.empty() ? "new" : "old");
      EXPECT_EQ(names_in(out).size(), strangers ? 5u : 4u);
      EXPECT_EQ(names_in(folder.path()), Names{"out"});
    }
    EXPECT_GT(calls, 20);
  }
}

TEST(StagedFiles, WorkThatCannotBeWrittenIsKeptElsewhere) {
  const TempFolder folder;
  const fs::path out = folder / "out";
  StagedFiles staged(out);
  staged.write("early.txt", "");
  fs::remove_all(out);
  write_bytes_to(out, "a file in the way");
  const std::string error =
      error_of([&] { staged.finish([&] { staged.write("a.txt", "work"); }); });
  EXPECT_TRUE(error.starts_with("cannot ")) << error;
  const std::string place = "what was made is in ";
  const std::size_t at = error.find(place);
  ASSERT_NE(at, std::string::npos) << error;
  const fs::path kept = error.substr(at + place.size());
  EXPECT_EQ(bytes_of(kept / "a.txt"), "work");
  EXPECT_EQ(names_in(kept), Names{"a.txt"});
  fs::remove_all(kept);
}

TEST(StagedFiles, AFolderThatWentAwayIsMadeAgain) {
  const TempFolder folder;
  StagedFiles staged(folder / "out");
  fs::remove_all(folder / "out");
  staged.finish([&] { staged.write("a.txt", "work"); });
  EXPECT_EQ(bytes_of(folder / "out/a.txt"), "work");
}

TEST(StagedFiles, WhatIsNotWantedChangesNothing) {
  const TempFolder folder;
  write_bytes_to(folder / "a.txt", "better");
  StagedFiles staged(folder.path());
  staged.write("a.txt", "worse");
  EXPECT_FALSE(staged.commit([] { return false; }));
  EXPECT_EQ(bytes_of(folder / "a.txt"), "better");
  EXPECT_TRUE(staged.commit([] { return true; }));
  EXPECT_EQ(bytes_of(folder / "a.txt"), "worse");
}

}  // namespace
}  // namespace quartet
