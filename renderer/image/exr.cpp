#include "renderer/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <half.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "renderer/image/file_writer.h"

namespace quartet {

namespace {

// Larger than any picture of ours, and small enough that a damaged header cannot ask for all
// memory: 2^28 numbers are 1 GB.
constexpr int kMaxSide = 1 << 16;
constexpr std::size_t kMaxNumbers = std::size_t(1) << 28;

/// OpenEXR's stream over FileWriter, so that a full disk is an error with its reason.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(FileWriter& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int size) override {
    file_.write(bytes, static_cast<std::size_t>(size));
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  FileWriter& file_;
};

/// Threads that compress rows, of OpenEXR's own; they start with the first file that is written.
int compression_threads() {
  static const int count = [] {
    Imf::setGlobalThreadCount(tbb::this_task_arena::max_concurrency());
    return Imf::globalThreadCount();
  }();
  return count;
}

Imath::Box2i box_of(const ExrWindow& window) {
  return {Imath::V2i(window.x, window.y),
          Imath::V2i(window.x + window.width - 1, window.y + window.height - 1)};
}

ExrWindow window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}

std::string text_of(const ExrWindow& window) {
  return fmt::format("{}x{} at ({}, {})", window.width, window.height, window.x, window.y);
}

bool contains(const ExrWindow& outer, const ExrWindow& inner) {
  return inner.x >= outer.x && inner.y >= outer.y &&
         inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

/// OpenEXR addresses a pixel as base + x * xStride + y * yStride with x, y in the data window, so
/// the base lies before the buffer if the window does not start at 0.
template <class T>
Imf::Slice slice_of(Imf::PixelType type, const T* pixels, const ExrWindow& window) {
  return Imf::Slice::Make(type, pixels, Imath::V2i(window.x, window.y), window.width, window.height,
                          sizeof(T), sizeof(T) * static_cast<std::size_t>(window.width));
}

/// One line, whatever a library's message looks like.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

Imf::Header header_of(const ExrImage& image) {
  Imf::Header header(box_of(image.display), box_of(image.data), 1.f, Imath::V2f(0.f, 0.f), 1.f,
                     Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  for (const auto& [name, text] : image.attributes) {
    header.insert(name, Imf::StringAttribute(text));
  }
  return header;
}

ExrChannel read_channel(Imf::InputFile& file, const char* name, const Imf::Channel& channel,
                        const ExrWindow& window) {
  const std::size_t size =
      static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
  ExrChannel result{name, {}, channel.type == Imf::HALF};
  Imf::FrameBuffer buffer;
  if (channel.type == Imf::UINT) {
    auto& pixels = result.pixels.emplace<std::vector<std::uint32_t>>(size);
    buffer.insert(name, slice_of(Imf::UINT, pixels.data(), window));
  } else {
    auto& pixels = result.pixels.emplace<std::vector<float>>(size);
    buffer.insert(name, slice_of(Imf::FLOAT, pixels.data(), window));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.y, window.y + window.height - 1);
  return result;
}

ExrImage read_file(const std::filesystem::path& path) {
  // OpenEXR checks the windows against this before it takes memory for them.
  static const bool limited = (Imf::Header::setMaxImageSize(kMaxSide, kMaxSide), true);
  static_cast<void>(limited);
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  ExrImage image;
  image.data = window_of(header.dataWindow());
  image.display = window_of(header.displayWindow());

  std::size_t channels = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    ++channels;
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
      throw std::runtime_error(
          fmt::format("channel {} is subsampled; channels with a value for each pixel, such as "
                      "R G B, would be right",
                      it.name()));
    }
  }
  const std::size_t numbers = channels * static_cast<std::size_t>(image.data.width) *
                              static_cast<std::size_t>(image.data.height);
  if (numbers > kMaxNumbers) {
    throw std::runtime_error(
        fmt::format("{} pixels with {} channels would take {} MB; at most {} MB would be right",
                    text_of(image.data), channels, numbers >> 18, kMaxNumbers >> 18));
  }
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    image.channels.push_back(read_channel(file, it.name(), it.channel(), image.data));
  }
  for (auto it = header.begin(); it != header.end(); ++it) {
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute())) {
      image.attributes[it.name()] = text->value();
    }
  }
  return image;
}

}  // namespace

const ExrChannel* ExrImage::find(std::string_view name) const {
  const auto it = std::ranges::find(channels, name, &ExrChannel::name);
  return it == channels.end() ? nullptr : &*it;
}

void ExrImage::add(std::string name, std::vector<float> pixels) {
  channels.push_back({std::move(name), std::move(pixels)});
}

void ExrImage::add(std::string name, std::vector<std::uint32_t> pixels) {
  channels.push_back({std::move(name), std::move(pixels)});
}

void ExrImage::add_radiance(const RadianceImage& radiance) {
  for (const auto& [name, axis] : {std::pair{"R", 0}, std::pair{"G", 1}, std::pair{"B", 2}}) {
    std::vector<float> pixels(radiance.size());
    std::ranges::transform(radiance.pixels(), pixels.begin(),
                           [axis = axis](const glm::vec3& c) { return c[axis]; });
    add(name, std::move(pixels));
  }
}

void write_exr(const std::filesystem::path& path, const ExrImage& image) {
  [[maybe_unused]] const std::size_t size =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  FileWriter file(path);
  try {
    Imf::Header header = header_of(image);
    Imf::FrameBuffer buffer;
    std::vector<std::vector<half>> halves;
    for (const ExrChannel& channel : image.channels) {
      assert(header.channels().findChannel(channel.name) == nullptr);
      if (const auto* counts = std::get_if<std::vector<std::uint32_t>>(&channel.pixels)) {
        assert(counts->size() == size && !channel.half);
        header.channels().insert(channel.name, Imf::Channel(Imf::UINT));
        buffer.insert(channel.name, slice_of(Imf::UINT, counts->data(), image.data));
        continue;
      }
      const auto& floats = std::get<std::vector<float>>(channel.pixels);
      assert(floats.size() == size);
      header.channels().insert(channel.name, Imf::Channel(channel.half ? Imf::HALF : Imf::FLOAT));
      if (channel.half) {
        const auto& stored = halves.emplace_back(floats.begin(), floats.end());
        buffer.insert(channel.name, slice_of(Imf::HALF, stored.data(), image.data));
      } else {
        buffer.insert(channel.name, slice_of(Imf::FLOAT, floats.data(), image.data));
      }
    }
    ExrStream stream(file, path.string());
    Imf::OutputFile output(stream, header, compression_threads());
    output.setFrameBuffer(buffer);
    output.writePixels(image.height());
  } catch (const std::exception& error) {
    file.fail(one_line(error.what()));
  }
  file.close();
}

ExrImage read_exr(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(fmt::format("cannot read {}: no such file", path.string()));
  }
  try {
    return read_file(path);
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("cannot read {} as EXR: {}", path.string(), one_line(error.what())));
  }
}

RadianceImage radiance_of(const ExrImage& image, const std::filesystem::path& path) {
  const ExrWindow& data = image.data;
  const ExrWindow& shown = image.display;
  if (!contains(data, shown)) {
    throw std::runtime_error(fmt::format(
        "{}: its pixels cover {} but the picture is {}; an EXR with pixels for the whole picture "
        "would be right",
        path.string(), text_of(data), text_of(shown)));
  }
  RadianceImage radiance(shown.width, shown.height);
  for (const auto& [name, axis] : {std::pair{"R", 0}, std::pair{"G", 1}, std::pair{"B", 2}}) {
    const ExrChannel* channel = image.find(name);
    if (channel == nullptr || !std::holds_alternative<std::vector<float>>(channel->pixels)) {
      std::string names;
      for (const ExrChannel& other : image.channels) {
        names += (names.empty() ? "" : ", ") + other.name;
      }
      throw std::runtime_error(
          fmt::format("{}: no channel {} of float or half; R, G and B are needed, there are: {}",
                      path.string(), name, names));
    }
    const auto& pixels = std::get<std::vector<float>>(channel->pixels);
    for (int y = 0; y < shown.height; ++y) {
      const std::size_t row = std::size_t(shown.y + y - data.y) * std::size_t(data.width);
      for (int x = 0; x < shown.width; ++x) {
        radiance.at(x, y)[axis] = pixels[row + std::size_t(shown.x + x - data.x)];
      }
    }
  }
  return radiance;
}

}  // namespace quartet
