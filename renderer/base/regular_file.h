#pragma once

#include <cstddef>
#include <filesystem>
#include <stop_token>
#include <string>

namespace quartet {

/// Throws std::runtime_error "cannot read PATH: REASON" unless `path` is a regular file, or a link
/// to one: reading a pipe or a device may never end. Returns its size in bytes.
std::size_t regular_file_size(const std::filesystem::path& path);

/// The bytes of a regular file of at most `limit` bytes. Throws like regular_file_size, also for a
/// file that is larger (with its size and the limit), that cannot be opened or that fails while
/// it is read; throws Cancelled once `stop` is asked for.
std::string read_regular_file(const std::filesystem::path& path, std::size_t limit,
                              const std::stop_token& stop = {});

}  // namespace quartet
