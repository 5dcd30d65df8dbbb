#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "renderer/base/file_reader.h"
#include "renderer/files/exr.h"
#include "renderer/files/picture.h"

namespace quartet {

// One reader a format, each for a file that begins as the format does. They throw
// std::runtime_error with the reason alone; only that of EXR names the path.

Picture read_exr_picture(const std::filesystem::path& path, const PictureOptions& options,
                         const std::stop_token& stop);
Picture read_png_picture(FileReader& file, const std::stop_token& stop);
Picture read_pfm_picture(FileReader& file, const std::stop_token& stop);
Picture read_hdr_picture(FileReader& file, const std::stop_token& stop);

/// Throws std::runtime_error unless such a picture is one of ours in size, and its pixels could
/// come out of so many bytes, where `pixels_a_byte` is how far the format compresses at most.
void check_claimed_size(std::uint64_t width, std::uint64_t height, double pixels_a_byte,
                        std::uint64_t bytes);

/// A black picture that fills its frame.
Picture whole_picture(std::uint64_t width, std::uint64_t height);

/// A line of a header without its end, of at most 4096 bytes; throws if it is longer.
std::string read_header_line(FileReader& file);

/// Where the colour of a picture is in an EXR file.
struct ExrLayer {
  std::size_t part = 0;
  std::string name;                   ///< with the part's where there are several; may be empty
  std::vector<std::string> channels;  ///< as the file names them: R G B, or luminance alone
};

/// The layer of that name, or whose name ends in .NAME if only one does. Without a name: the layer
/// of colour that has no name, else the only one of colour, else the only luminance. Throws
/// std::runtime_error that lists all layers if that is not one.
ExrLayer choose_exr_layer(std::span<const ExrPartHeader> parts, const PictureOptions& options);

}  // namespace quartet
