#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

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

void read_pixels(Imf::InputPart& file, std::span<const std::string> channels, ExrImage& image,
                 const std::stop_token& stop) {
  const Imf::Header& header = file.header();
  Imf::FrameBuffer buffer;
  for (const std::string& name : channels) {
    check_cancelled(stop);
    add_channel(image, name.c_str(), header.channels()[name], buffer);
  }
  file.setFrameBuffer(buffer);
  const int end = image.data.y + image.height();
  const int step = band_rows(image);
  for (int y = image.data.y; y < end; y += std::min(step, end - y)) {
    check_cancelled(stop);
    file.readPixels(y, y + std::min(step, end - y) - 1);
  }
}

std::map<std::string, std::string> texts_of(const Imf::Header& header) {
  std::map<std::string, std::string> texts;
  for (auto it = header.begin(); it != header.end(); ++it) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
    if (text != nullptr && std::string_view(it.name()) != "type") {  // of OpenEXR's own making
      texts[it.name()] = text->value();
    }
  }
  return texts;
}

std::vector<std::string> channel_names_of(const Imf::Header& header) {
  std::vector<std::string> names;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    names.emplace_back(it.name());
  }
  return names;
}

/// Of EXR without a word about it, and of ours.
bool is_rec709(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) {
    return true;
  }
  constexpr float close = 1e-3f;
  const Imf::Chromaticities rec709;  // the default of the format
  const Imf::Chromaticities& found = Imf::chromaticities(header);
  return found.red.equalWithAbsError(rec709.red, close) &&
         found.green.equalWithAbsError(rec709.green, close) &&
         found.blue.equalWithAbsError(rec709.blue, close) &&
         found.white.equalWithAbsError(rec709.white, close);
}

/// A file whose headers OpenEXR has read, after they were looked at.
class ExrParts {
 public:
  ExrParts(FileReader& file, const std::string& name, const ExrSizes& sizes)
      : source_(file, name), input_(source_, threads_for(sizes)) {}

  std::vector<ExrPartHeader> headers() const {
    std::vector<ExrPartHeader> headers;
    for (int i = 0; i < input_.parts(); ++i) {
      const Imf::Header& header = input_.header(i);
      headers.push_back({input_.parts() > 1 && header.hasName() ? header.name() : "",
                         channel_names_of(header), texts_of(header)});
    }
    return headers;
  }

  /// All channels if `channels` is null.
  ExrImage read(std::size_t part, const std::vector<std::string>* channels,
                const std::stop_token& stop) {
    if (part >= std::size_t(input_.parts())) {
      throw std::runtime_error(fmt::format("it has no part {}, only {}", part, input_.parts()));
    }
    const Imf::Header& header = input_.header(int(part));
    const std::vector<std::string> all = channel_names_of(header);
    const std::vector<std::string>& wanted = channels == nullptr ? all : *channels;
    ExrImage image;
    image.data = window_of(header.dataWindow());
    image.display = window_of(header.displayWindow());
    image.rec709 = is_rec709(header);
    Imf::InputPart input(input_, int(part));
    read_pixels(input, wanted, image, stop);
    image.attributes = texts_of(header);
    return image;
  }

 private:
  static int threads_for(const ExrSizes& sizes) {
    // Each thread has two blocks in memory.
    constexpr std::uint64_t most_bytes = std::uint64_t(1) << 27;
    const std::uint64_t threads = most_bytes / 2 / std::max<std::uint64_t>(sizes.block, 1);
    return int(std::min(std::uint64_t(exr_threads()), threads));
  }

  ExrSource source_;
  Imf::MultiPartInputFile input_;
};

/// Calls check(ExrSizes) before OpenEXR has the file, then use(ExrParts&), and says of what they
/// throw which file it is about.
template <class Check, class Use>
auto with_exr(const std::filesystem::path& path, const Check& check, const Use& use) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    throw std::runtime_error(fmt::format("cannot read {}: no such file", path.string()));
  }
  FileReader file(path);
  try {
    const ExrSizes sizes = check_exr_headers(file);
    check(sizes);
    file.seek(0);
    // OpenEXR checks the windows against this before it takes memory for them.
    static const bool limited = (Imf::Header::setMaxImageSize(max_exr_side, max_exr_side), true);
    static_cast<void>(limited);
    ExrParts parts(file, path.string(), sizes);
    return use(parts);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(
        fmt::format("cannot read {} as EXR: {}", path.string(), one_line(error.what())));
  }
}

}  // namespace

ExrImage read_exr(const std::filesystem::path& path, const std::stop_token& stop) {
  return with_exr(
      path,
      [](const ExrSizes& sizes) {
        if (!sizes.parts.empty()) {
          check_exr_part(sizes, 0, sizes.parts.front().channels);
        }
      },
      [&](ExrParts& parts) { return parts.read(0, nullptr, stop); });
}

ExrImage read_exr_channels(const std::filesystem::path& path, std::size_t part,
                           const std::vector<std::string>& channels, const std::stop_token& stop) {
  return with_exr(
      path, [&](const ExrSizes& sizes) { check_exr_part(sizes, part, channels.size()); },
      [&](ExrParts& parts) { return parts.read(part, &channels, stop); });
}

std::vector<ExrPartHeader> read_exr_headers(const std::filesystem::path& path) {
  return with_exr(
      path, [](const ExrSizes&) {}, [](ExrParts& parts) { return parts.headers(); });
}

}  // namespace quartet
