#include "renderer/files/file_target.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <climits>
#include <stdexcept>
#include <string>
#include <system_error>

#include "renderer/base/system_calls.h"

namespace quartet {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse_target(const fs::path& path, std::string_view reason) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), reason));
}

std::string errno_text(int error) {
  return std::generic_category().message(error);
}

/// A file that is closed with the block it is opened in.
class Opened {
 public:
  explicit Opened(const fs::path& path)
      : file_(system_calls().open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC, 0)) {}
  ~Opened() {
    if (file_ >= 0) {
      system_calls().close(file_);
    }
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  int file() const { return file_; }

 private:
  int file_;
};

}  // namespace

fs::path target_of(const fs::path& name) {
  fs::path target = name;
  std::error_code ignored;
  for (int links = 0; fs::is_symlink(target, ignored); ++links) {
    constexpr int most_links = 40;  // what Linux itself follows
    if (links == most_links) {
      refuse_target(name, "it is a link that leads back to itself");
    }
    target = target.parent_path() / fs::read_symlink(target);  // an absolute one stays as it is
  }
  struct stat status {};
  if (::stat(target.c_str(), &status) != 0) {
    if (errno == ENAMETOOLONG) {
      refuse_target(name, fmt::format("it is too long; a name of at most {} bytes, in a path of at "
                                      "most {}, would be right",
                                      NAME_MAX, PATH_MAX - 1));
    }
    if (target != name && !fs::is_directory(target.parent_path(), ignored)) {
      refuse_target(
          name, fmt::format("it is a link to {}, whose folder does not exist", target.string()));
    }
    return target;
  }
  if (S_ISDIR(status.st_mode)) {
    refuse_target(name, "it is a folder; the name of a file would be right");
  }
  if (!S_ISREG(status.st_mode)) {
    refuse_target(name, "it is a pipe, socket or device; the name of a file would be right");
  }
  // The superuser may write where nobody is meant to.
  if ((status.st_mode & 0222) == 0 ||
      ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) {
    refuse_target(name, fmt::format("it is write-protected (mode {:03o}); chmod u+w, or another "
                                    "name, would be right",
                                    status.st_mode & 07777));
  }
  return target;
}

void make_durable(const fs::path& temporary, const fs::path& final) {
  const Opened opened(temporary);
  if (opened.file() < 0) {
    refuse_target(final, errno_text(errno));
  }
  struct stat old {};
  struct stat made {};
  if (::stat(final.c_str(), &old) == 0 && ::fstat(opened.file(), &made) == 0) {
    if (old.st_uid != made.st_uid || old.st_gid != made.st_gid) {
      // Only the superuser may give a file away; the group alone is often allowed.
      if (::fchown(opened.file(), old.st_uid, old.st_gid) != 0) {
        static_cast<void>(::fchown(opened.file(), uid_t(-1), old.st_gid) == 0);
      }
    }
    // Not asked of disks that have no permissions and would refuse.
    if (old.st_mode != made.st_mode && ::fchmod(opened.file(), old.st_mode & 0777) != 0) {
      refuse_target(final, errno_text(errno));
    }
  }
  // EINVAL: a file system that cannot be asked.
  if (system_calls().fsync(opened.file()) != 0 && errno != EINVAL) {
    refuse_target(final, errno_text(errno));
  }
}

std::string checksum_text(const fs::path& path) {
  const Opened opened(path);
  if (opened.file() < 0) {
    refuse_target(path, errno_text(errno));
  }
  std::array<unsigned char, 1 << 15> bytes{};
  uLong sum = ::crc32(0, nullptr, 0);
  off_t size = 0;
  for (;;) {
    const ssize_t got = system_calls().read(opened.file(), bytes.data(), bytes.size(), size);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      refuse_target(path, errno_text(errno));
    }
    if (got == 0) {
      return fmt::format("{:08x} {}", sum, size);
    }
    sum = ::crc32(sum, bytes.data(), uInt(got));
    size += got;
  }
}

}  // namespace quartet
