#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace quartet {

/// Adds --out, the folder that a command writes its files into.
void add_out_option(CLI::App& command, std::string& folder);

/// Whether a picture of this size can be written, and read again, as what the file's extension
/// says: .exr with so many channels, or .png. Throws UsageError that begins with `option`, the name
/// of the one that decides the size, and says the limit.
void check_picture_size(const std::string& option, int width, int height,
                        const std::filesystem::path& file, std::size_t channels);

}  // namespace quartet
