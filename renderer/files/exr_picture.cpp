#include <fmt/format.h>

#include <stdexcept>
#include <variant>

#include "renderer/files/exr_header.h"
#include "renderer/files/picture_formats.h"

namespace quartet {
namespace {

const std::vector<float>& floats_of(const ExrImage& exr, const std::string& channel) {
  const ExrChannel* found = exr.find(channel);
  const auto* floats = found == nullptr ? nullptr : std::get_if<std::vector<float>>(&found->pixels);
  if (floats == nullptr) {
    throw std::runtime_error(
        fmt::format("its channel {} holds integers; float or half would be right", channel));
  }
  return *floats;
}

Picture picture_of(const ExrImage& exr, const ExrLayer& layer) {
  const ExrWindow seen = intersection(exr.data, exr.display);
  if (seen.width == 0 || seen.height == 0) {
    throw std::runtime_error(
        fmt::format("its pixels cover {} and the picture is {}; pixels in the picture would be "
                    "right",
                    text_of(exr.data), text_of(exr.display)));
  }
  Picture picture;
  picture.width = exr.display.width;
  picture.height = exr.display.height;
  picture.left = seen.x - exr.display.x;
  picture.top = seen.y - exr.display.y;
  picture.layer = layer.name;
  picture.attributes = exr.attributes;
  picture.image = RadianceImage(seen.width, seen.height);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float>& from =
        floats_of(exr, layer.channels[layer.channels.size() == 1 ? 0 : std::size_t(axis)]);
    for (int y = 0; y < seen.height; ++y) {
      const std::size_t row = std::size_t(seen.y + y - exr.data.y) * std::size_t(exr.width());
      for (int x = 0; x < seen.width; ++x) {
        picture.image.at(x, y)[axis] = from[row + std::size_t(seen.x + x - exr.data.x)];
      }
    }
  }
  if (!layer.name.empty()) {
    picture.notes.push_back(one_line(fmt::format("of its layers '{}' is taken", layer.name)));
  }
  if (layer.channels.size() == 1) {
    picture.notes.push_back(
        one_line(fmt::format("it has luminance alone ({}), which is taken for R, G and B alike",
                             layer.channels.front())));
  }
  if (picture.uncovered() > 0) {
    picture.notes.push_back(fmt::format("its pixels cover {} of the picture, which is {}",
                                        text_of(exr.data), text_of(exr.display)));
  }
  if (!exr.rec709) {
    picture.notes.emplace_back(
        "its primaries are not those of Rec. 709; its numbers are taken as they are");
  }
  return picture;
}

}  // namespace

Picture read_exr_picture(const std::filesystem::path& path, const PictureOptions& options,
                         const std::stop_token& stop) {
  const std::vector<ExrPartHeader> headers = read_exr_headers(path);
  const auto with_path = [&](const auto& action) {
    try {
      return action();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}: {}", path.string(), one_line(error.what())));
    }
  };
  const ExrLayer layer = with_path([&] { return choose_exr_layer(headers, options); });
  const ExrImage exr = read_exr_channels(path, layer.part, layer.channels, stop);
  return with_path([&] { return picture_of(exr, layer); });
}

}  // namespace quartet
