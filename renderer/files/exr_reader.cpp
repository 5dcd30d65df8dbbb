#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <system_error>

#include "renderer/base/cancel.h"
#include "renderer/files/exr.h"
#include "renderer/files/exr_header.h"

namespace quartet {
namespace {

/// OpenEXR's stream over a file whose end is known.
class ExrSource : public Imf::IStream {
 public:
  ExrSource(FileReader& file, const std::string& name) : Imf::IStream(name.c_str()), file_(file) {}
  bool read(char bytes[], int size) override {
    file_.read(bytes, std::size_t(std::max(size, 0)));
    return file_.left() > 0;
  }
  std::uint64_t tellg() override { return file_.position(); }
  void seekg(std::uint64_t position) override { file_.seek(position); }

 private:
  FileReader& file_;
};

ExrWindow window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}

/// Memory for a channel, where OpenEXR is to put it.
void add_channel(ExrImage& image, const char* name, const Imf::Channel& channel,
                 Imf::FrameBuffer& buffer) {
  if (channel.xSampling != 1 || channel.ySampling != 1) {
    throw std::runtime_error(
        fmt::format("channel {} is subsampled; channels with a value for each pixel, such as "
                    "R G B, would be right",
                    name));
  }
  const ExrWindow& window = image.data;
  const std::size_t width = std::size_t(window.width);
  const std::size_t size = width * std::size_t(window.height);
  ExrChannel& result = image.channels.emplace_back();
  result.name = name;
  result.half = channel.type == Imf::HALF;
  const auto insert = [&](Imf::PixelType type, const auto* pixels) {
    buffer.insert(name, Imf::Slice::Make(type, pixels, Imath::V2i(window.x, window.y), window.width,
                                         window.height, sizeof(*pixels), sizeof(*pixels) * width));
  };
  if (channel.type == Imf::UINT) {
    insert(Imf::UINT, result.pixels.emplace<std::vector<std::uint32_t>>(size).data());
  } else {
    insert(Imf::FLOAT, result.pixels.emplace<std::vector<float>>(size).data());
  }
}

/// Rows that are read between two looks at whether to stop: whole blocks of every compression, and
/// some ten milliseconds of work.
int band_rows(const ExrImage& image) {
  constexpr std::size_t block = 256;
  constexpr std::size_t numbers = std::size_t(1) << 21;
  const std::size_t row =
      std::size_t(image.width()) * std::max<std::size_t>(image.channels.size(), 1);
  return int(std::max(numbers / row / block, std::size_t(1)) * block);
}

void read_pixels(Imf::InputFile& file, ExrImage& image, const std::stop_token& stop) {
  const Imf::Header& header = file.header();
  Imf::FrameBuffer buffer;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    check_cancelled(stop);
    add_channel(image, it.name(), it.channel(), buffer);
  }
  file.setFrameBuffer(buffer);
  const int end = image.data.y + image.height();
  const int step = band_rows(image);
  for (int y = image.data.y; y < end; y += std::min(step, end - y)) {
    check_cancelled(stop);
    file.readPixels(y, y + std::min(step, end - y) - 1);
  }
}

ExrImage read_checked(FileReader& file, const std::string& name, const std::stop_token& stop) {
  const std::uint64_t block = check_exr_headers(file);
  file.seek(0);
  // OpenEXR checks the windows against this before it takes memory for them.
  static const bool limited = (Imf::Header::setMaxImageSize(max_exr_side, max_exr_side), true);
  static_cast<void>(limited);
  ExrSource source(file, name);
  // Each thread has two blocks in memory.
  constexpr std::uint64_t most_bytes = std::uint64_t(1) << 27;
  const std::uint64_t threads = most_bytes / 2 / std::max<std::uint64_t>(block, 1);
  Imf::InputFile input(source, int(std::min(std::uint64_t(exr_threads()), threads)));
  const Imf::Header& header = input.header();
  ExrImage image;
  image.data = window_of(header.dataWindow());
  image.display = window_of(header.displayWindow());
  read_pixels(input, image, stop);
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute())) {
      image.attributes[it.name()] = text->value();
    }
  }
  return image;
}

}  // namespace

ExrImage read_exr(const std::filesystem::path& path, const std::stop_token& stop) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(fmt::format("cannot read {}: no such file", path.string()));
  }
  FileReader file(path);
  try {
    return read_checked(file, path.string(), stop);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("cannot read {} as EXR: {}", path.string(), one_line(error.what())));
  }
}

}  // namespace quartet
