#include "renderer/measure/reference/reference_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "renderer/base/version.h"
#include "renderer/measure/reference/noise_floors.h"
#include "renderer/scene/synthetic.h"

namespace quartet {

namespace {

constexpr std::string_view reference_kind = "uniform reference of two independent halves";
constexpr std::array channel_names{"R", "G", "B"};
constexpr std::array<std::string_view, 5> fov_axes{"x", "y", "diagonal", "smaller", "larger"};

std::string sum_channel(std::size_t half, int channel, std::string_view word) {
  return fmt::format("Half{}.{}.{}", half, channel_names[std::size_t(channel)], word);
}

std::string rejected_channel(std::size_t half) {
  return fmt::format("Half{}.Rejected", half);
}

// A camera as words, each with its numbers: shortest decimals that read back to the same float.

std::string text_of(glm::vec3 v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

std::string text_of(const Camera& camera) {
  return fmt::format("origin {} right {} up {} forward {} fov {} {} aperture {} focus {}",
                     text_of(camera.origin), text_of(camera.right), text_of(camera.up),
                     text_of(camera.forward), camera.fov, fov_axes[std::size_t(camera.fov_axis)],
                     camera.aperture_radius, camera.focus_distance);
}

/// Counts as floats, which round above 2^24, or as integers, as they once were.
class CountChannel {
 public:
  explicit CountChannel(const ExrChannel& channel) : channel_(channel) {}

  bool is(std::size_t pixel, std::uint64_t count) const {
    return std::visit(
        [&](const auto& pixels) {
          using Number = typename std::decay_t<decltype(pixels)>::value_type;
          return double(pixels[pixel]) == double(Number(count));
        },
        channel_.pixels);
  }
  std::string text(std::size_t pixel) const {
    return std::visit([&](const auto& pixels) { return fmt::format("{}", pixels[pixel]); },
                      channel_.pixels);
  }

 private:
  const ExrChannel& channel_;
};

/// Reads the header of a reference; each function throws std::runtime_error that says what is
/// wrong.
class Header {
 public:
  Header(const ExrImage& exr, std::filesystem::path path) : exr_(exr), path_(std::move(path)) {}

  const std::string& text(const std::string& name) const {
    const auto it = exr_.attributes.find(name);
    if (it == exr_.attributes.end()) {
      fail(fmt::format("its header has no '{}'", name));
    }
    return it->second;
  }

  template <class T>
  T number(const std::string& name) const {
    const std::string& digits = text(name);
    T value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) {
      fail(fmt::format("'{}' in its header is no number of '{}'", digits, name));
    }
    return value;
  }

  Camera camera() const {
    std::istringstream in(text("camera"));
    in.imbue(std::locale::classic());
    const auto word = [&](std::string_view expected) {
      std::string found;
      in >> found;
      if (found != expected) {
        in.setstate(std::ios::failbit);
      }
    };
    const auto vector = [&](glm::vec3& v) { in >> v.x >> v.y >> v.z; };
    Camera camera;
    std::string axis;
    word("origin"), vector(camera.origin);
    word("right"), vector(camera.right);
    word("up"), vector(camera.up);
    word("forward"), vector(camera.forward);
    word("fov"), in >> camera.fov >> axis;
    word("aperture"), in >> camera.aperture_radius;
    word("focus"), in >> camera.focus_distance;
    const auto* const known = std::ranges::find(fov_axes, axis);
    if (!in || known == fov_axes.end()) {
      fail(fmt::format("'{}' in its header is no camera", text("camera")));
    }
    camera.fov_axis = FovAxis(known - fov_axes.begin());
    return camera;
  }

  const std::vector<std::uint32_t>& words(const std::string& name) const {
    const ExrChannel* channel = exr_.find(name);
    if (channel == nullptr ||
        !std::holds_alternative<std::vector<std::uint32_t>>(channel->pixels)) {
      fail(fmt::format("it has no channel {} of integers", name));
    }
    return std::get<std::vector<std::uint32_t>>(channel->pixels);
  }

  CountChannel counts(const std::string& name) const {
    const ExrChannel* channel = exr_.find(name);
    if (channel == nullptr) {
      fail(fmt::format("it has no channel {}", name));
    }
    return CountChannel(*channel);
  }

  const std::vector<float>& numbers(const std::string& name) const {
    const ExrChannel* channel = exr_.find(name);
    if (channel == nullptr || !std::holds_alternative<std::vector<float>>(channel->pixels)) {
      fail(fmt::format("it has no channel {} of numbers", name));
    }
    return std::get<std::vector<float>>(channel->pixels);
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(
        fmt::format("{} is a damaged reference: {}; make it anew", path_.string(), reason));
  }

 private:
  const ExrImage& exr_;
  std::filesystem::path path_;
};

void add_half(const ReferenceSums& sums, std::size_t half, ExrImage& exr) {
  const auto& from = sums.halves[half];
  const std::size_t pixels = from.sums.size();
  for (int c = 0; c < 3; ++c) {
    std::vector<std::uint32_t> high(pixels);
    std::vector<std::uint32_t> low(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const auto bits = std::bit_cast<std::uint64_t>(from.sums[i][c]);
      high[i] = std::uint32_t(bits >> 32);
      low[i] = std::uint32_t(bits);
    }
    exr.add(sum_channel(half, c, "high"), std::move(high));
    exr.add(sum_channel(half, c, "low"), std::move(low));
  }
  exr.add(rejected_channel(half), from.rejected);
}

ReferenceSums::Half half_of(const Header& header, std::size_t half, std::size_t pixels) {
  ReferenceSums::Half result;
  result.sums.resize(pixels);
  for (int c = 0; c < 3; ++c) {
    const auto& high = header.words(sum_channel(half, c, "high"));
    const auto& low = header.words(sum_channel(half, c, "low"));
    for (std::size_t i = 0; i < pixels; ++i) {
      result.sums[i][c] = std::bit_cast<double>(std::uint64_t(high[i]) << 32 | low[i]);
    }
  }
  result.rejected = header.words(rejected_channel(half));
  return result;
}

std::string noise_floor_text(const Reference& reference) {
  NoiseFloors floors(reference);
  std::string text;
  for (const Metric& row : metrics()) {
    text += fmt::format("{}{} {:.6g}", text.empty() ? "" : ", ", row.id, floors.of(row));
  }
  return text;
}

/// The mean of what is in the film, 0 if nothing is.
glm::vec3 pixel_mean(const glm::dvec3& sum, std::uint64_t samples, std::uint64_t rejected) {
  return samples > rejected ? glm::vec3(sum / double(samples - rejected)) : glm::vec3(0.0f);
}

/// Numbers that the work goes on with, and that no run of this program gives.
void check_header(const Header& header, const ReferenceSums& sums, int depth) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  if (sums.spp < 1 || sums.spp > most) {
    header.fail(fmt::format("'spp' is {}; from 1 to {} is possible", sums.spp, most));
  }
  constexpr double most_seconds = 1e10;  // three centuries
  if (!(sums.seconds >= 0.0 && sums.seconds <= most_seconds)) {
    header.fail(
        fmt::format("'seconds' is {}; from 0 to {} is possible", sums.seconds, most_seconds));
  }
  if (depth < -1) {
    header.fail(fmt::format("'maxDepth' is {}; -1 or more is possible", depth));
  }
}

/// Whether the header is that of these pixels: counts, sums and means of each are known twice.
void check_pixels(const Header& header, const ReferenceSums& sums) {
  const auto& [first, second] = sums.halves;
  const std::array<const std::vector<float>*, 3> means{&header.numbers("R"), &header.numbers("G"),
                                                       &header.numbers("B")};
  const CountChannel in_mean = header.counts("SampleCount");
  const CountChannel rejected = header.counts("Rejected");
  for (std::size_t i = 0; i < first.sums.size(); ++i) {
    const auto fail = [&](std::string_view reason) {
      const std::size_t width = std::size_t(sums.settings.width);
      header.fail(fmt::format("pixel {},{}: {}", i % width, i / width, reason));
    };
    const std::uint64_t left_out = std::uint64_t(first.rejected[i]) + second.rejected[i];
    if (!rejected.is(i, left_out) || first.rejected[i] > sums.samples_of(0) ||
        second.rejected[i] > sums.samples_of(1)) {
      fail(fmt::format("its halves rejected {} and {} samples, both together {}", first.rejected[i],
                       second.rejected[i], rejected.text(i)));
    }
    if (!in_mean.is(i, sums.spp - left_out)) {
      fail(fmt::format("SampleCount {} and Rejected {} are not the {} spp of its header",
                       in_mean.text(i), rejected.text(i), sums.spp));
    }
    const glm::vec3 mean = pixel_mean(first.sums[i] + second.sums[i], sums.spp, left_out);
    for (int c = 0; c < 3; ++c) {
      // Samples are neither negative nor infinite. Written so that NaN fails.
      const bool possible = first.sums[i][c] >= 0.0 && second.sums[i][c] >= 0.0 &&
                            std::isfinite(first.sums[i][c]) && std::isfinite(second.sums[i][c]);
      if (!possible || !(mean[c] == (*means[std::size_t(c)])[i])) {
        fail(fmt::format("{} is {}, and its sums make {}", channel_names[std::size_t(c)],
                         (*means[std::size_t(c)])[i], mean[c]));
      }
    }
  }
}

/// Files of before there was a choice do not name it: all scenes that are traced had the first.
SamplerId sampler_of(const ExrImage& exr, const std::string& scene_name) {
  const auto named = exr.attributes.find("sampler");
  if (named != exr.attributes.end()) {
    return find_sampler(named->second).key;
  }
  return is_synthetic_name(scene_name) ? SamplerId::independent : SamplerId::sobol;
}

}  // namespace

Reference reference_of(const ReferenceSums& sums) {
  const RenderSettings& settings = sums.settings;
  Reference reference;
  reference.spp = sums.spp;
  reference.settings = settings;
  reference.scene_name = sums.scene_name;
  reference.scene_hash = sums.scene_hash;
  reference.image = RadianceImage(settings.width, settings.height);
  reference.halves.fill(reference.image);
  const auto& [first, second] = sums.halves;
  for (std::size_t i = 0; i < reference.image.size(); ++i) {
    const std::uint64_t rejected = std::uint64_t(first.rejected[i]) + second.rejected[i];
    reference.rejected += rejected;
    reference.image.pixels()[i] = pixel_mean(first.sums[i] + second.sums[i], sums.spp, rejected);
    for (std::size_t half = 0; half < 2; ++half) {
      reference.halves[half].pixels()[i] = pixel_mean(
          sums.halves[half].sums[i], sums.samples_of(half), sums.halves[half].rejected[i]);
    }
  }
  return reference;
}

ExrImage exr_of(const ReferenceSums& sums, const std::string& command_line) {
  const RenderSettings& settings = sums.settings;
  const Reference reference = reference_of(sums);
  const std::size_t pixels = reference.image.size();
  ExrImage exr(settings.width, settings.height);
  exr.add_radiance(reference.image);
  std::vector<float> rejected(pixels);
  std::vector<float> in_mean(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint32_t left_out = sums.halves[0].rejected[i] + sums.halves[1].rejected[i];
    rejected[i] = float(left_out);
    in_mean[i] = float(std::uint32_t(sums.spp) - left_out);
  }
  exr.add("SampleCount", std::move(in_mean));
  exr.add("Rejected", std::move(rejected));
  add_half(sums, 0, exr);
  add_half(sums, 1, exr);
  exr.attributes = {
      {"reference", std::string(reference_kind)},
      {"scene", sums.scene_name},
      {"sceneHash", sums.scene_hash},
      {"camera", text_of(settings.camera)},
      {"integrator", std::string(integrator(settings.integrator).id)},
      {"sampler", std::string(sampler_row(settings.sampler).id)},
      {"maxDepth",
       std::to_string(settings.max_depth == std::numeric_limits<int>::max() ? -1
                                                                            : settings.max_depth)},
      {"seed", std::to_string(settings.seed)},
      {"spp", std::to_string(sums.spp)},
      {"seconds", fmt::format("{:.6g}", sums.seconds)},
      {"noiseFloor", noise_floor_text(reference)},
      {"version", std::string(version())},
      {"commandLine", command_line},
  };
  return exr;
}

bool holds_sums(const std::map<std::string, std::string>& attributes) {
  const auto kind = attributes.find("reference");
  return kind != attributes.end() && kind->second == reference_kind;
}

std::optional<ReferenceSums> sums_of(const ExrImage& exr, const std::filesystem::path& path) {
  if (!holds_sums(exr.attributes)) {
    return std::nullopt;
  }
  const Header header(exr, path);
  ReferenceSums sums;
  sums.scene_name = header.text("scene");
  sums.scene_hash = header.text("sceneHash");
  sums.spp = header.number<std::uint64_t>("spp");
  sums.seconds = header.number<double>("seconds");
  RenderSettings& settings = sums.settings;
  settings.camera = header.camera();
  settings.width = exr.width();
  settings.height = exr.height();
  settings.seed = header.number<std::uint64_t>("seed");
  const int depth = header.number<int>("maxDepth");
  settings.max_depth = depth < 0 ? std::numeric_limits<int>::max() : depth;
  try {
    settings.integrator = find_integrator(header.text("integrator")).key;
    settings.sampler = sampler_of(exr, sums.scene_name);
  } catch (const std::invalid_argument& error) {
    header.fail(error.what());
  }
  const std::size_t pixels = std::size_t(exr.width()) * std::size_t(exr.height());
  for (std::size_t half = 0; half < 2; ++half) {
    sums.halves[half] = half_of(header, half, pixels);
  }
  check_header(header, sums, depth);
  if (exr.data != exr.display) {
    header.fail("its pixels are not those of its picture");
  }
  check_pixels(header, sums);
  return sums;
}

std::uint64_t samples_in(const std::filesystem::path& path, const ReferenceSums& like) {
  try {
    const std::optional<ReferenceSums> sums = sums_of(read_exr(path), path);
    const bool same =
        sums && sums->scene_hash == like.scene_hash && sums->settings == like.settings;
    return same ? sums->spp : 0;
  } catch (const std::runtime_error&) {
    return 0;
  }
}

}  // namespace quartet
