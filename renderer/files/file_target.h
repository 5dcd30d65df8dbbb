#pragma once

#include <filesystem>

namespace quartet {

/// Where a file of this name would be written: the end of the links that the name may be, else the
/// name itself. Throws std::runtime_error that says what stands in the way: a folder, a pipe or
/// device, write protection, a link into a folder that does not exist.
std::filesystem::path target_of(const std::filesystem::path& name);

/// Waits until a new file is on the disk - some file systems report a full disk or quota only
/// then - and gives it the permissions and the owner of the one that it will replace, if there is
/// one. Throws std::runtime_error that names the final path.
void make_durable(const std::filesystem::path& temporary, const std::filesystem::path& final);

/// Checksum (CRC-32, as zlib and gzip have it) and bytes of a file, "1c291ca3 30399". Throws
/// std::runtime_error that names the file.
std::string checksum_text(const std::filesystem::path& path);

}  // namespace quartet
