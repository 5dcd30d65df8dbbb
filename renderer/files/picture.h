#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/files/exr.h"

namespace quartet {

struct PictureOptions {
  std::string layer;                     ///< of an EXR; empty: the only one of colour
  std::string layer_option = "--layer";  ///< the option that a message names for choosing one
};

/// A picture of any program as linear radiance with Rec. 709 primaries: what each pixel adds to
/// black. Numbers of the file that are not finite are kept.
struct Picture {
  RadianceImage image;  ///< the pixels that the file has, within the frame
  int width = 0;        ///< of the frame, which is the whole picture as it is meant to be seen
  int height = 0;
  int left = 0;  ///< where `image` begins in the frame; 0 but in cropped EXR files
  int top = 0;
  std::string layer;               ///< of an EXR, that was taken; empty if it has no name
  std::vector<std::string> notes;  ///< what was done that nobody asked for, a line each
  std::map<std::string, std::string> attributes;  ///< texts of an EXR's header

  /// Pixels of the frame that the file says nothing of.
  std::size_t uncovered() const { return std::size_t(width) * std::size_t(height) - image.size(); }
};

/// Reads EXR (any part and layer, colour or luminance), PNG, PFM and Radiance HDR, told apart by
/// what is in the file and not by its name. Numbers are checked against the file's size before they
/// cost memory. Throws std::runtime_error that names the path, what is wrong and what would be
/// right, and Cancelled soon after a stop was asked for.
Picture read_picture(const std::filesystem::path& path, const PictureOptions& options = {},
                     const std::stop_token& stop = {});

/// Whether a file is, by its first bytes or its name, one for read_picture.
bool is_picture(const std::filesystem::path& path);

}  // namespace quartet
