#include "renderer/files/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <utility>

#include "renderer/files/exr_header.h"
#include "renderer/files/file_writer.h"

namespace quartet {

namespace {

/// OpenEXR's stream over FileWriter, so that a full disk is an error with its reason.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(FileWriter& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file) {}
  void write(const char bytes[], int size) override { file_.write(bytes, std::size_t(size)); }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  FileWriter& file_;
};

Imath::Box2i box_of(const ExrWindow& window) {
  return {Imath::V2i(window.x, window.y),
          Imath::V2i(window.x + window.width - 1, window.y + window.height - 1)};
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
                          sizeof(T), sizeof(T) * std::size_t(window.width));
}

Imf::Header header_of(const ExrImage& image) {
  Imf::Header header(box_of(image.display), box_of(image.data), 1.0f, Imath::V2f(0.0f, 0.0f), 1.0f,
                     Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
  for (const auto& [name, text] : image.attributes) {
    header.insert(name, Imf::StringAttribute(text));
  }
  return header;
}

}  // namespace

ExrWindow intersection(const ExrWindow& a, const ExrWindow& b) {
  const int left = std::max(a.x, b.x);
  const int top = std::max(a.y, b.y);
  const auto end = [](int begin, int size) { return std::int64_t(begin) + size; };
  const std::int64_t right = std::min(end(a.x, a.width), end(b.x, b.width));
  const std::int64_t bottom = std::min(end(a.y, a.height), end(b.y, b.height));
  return {left, top, int(std::max<std::int64_t>(0, right - left)),
          int(std::max<std::int64_t>(0, bottom - top))};
}

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

void check_exr_size(int width, int height, std::size_t channels) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  if (width > max_exr_side || height > max_exr_side || channels * pixels > max_exr_numbers) {
    throw std::runtime_error(fmt::format(
        "an EXR of {}x{} pixels with {} channels could not be read again; sides of at most {} and "
        "{} million numbers would be right",
        width, height, channels, max_exr_side, max_exr_numbers / 1'000'000));
  }
}

void write_exr(const std::filesystem::path& path, const ExrImage& image) {
  [[maybe_unused]] const std::size_t size =
      std::size_t(image.width()) * std::size_t(image.height());
  try {
    check_exr_size(image.width(), image.height(), image.channels.size());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), error.what()));
  }
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
    Imf::OutputFile output(stream, header, exr_threads());
    output.setFrameBuffer(buffer);
    output.writePixels(image.height());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    file.fail(one_line(error.what()));
  }
  file.close();
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
