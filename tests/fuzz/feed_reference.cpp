#include <algorithm>
#include <bit>
#include <charconv>
#include <memory>
#include <optional>

#include "renderer/measure/reference/reference_render.h"
#include "renderer/measure/reference/reference_sums.h"
#include "tests/fuzz/feed.h"
#include "tests/fuzz/mesh_promises.h"

namespace quartet {
namespace {

constexpr const char* reference_name = "reference.exr";

std::shared_ptr<const TraceScene> ball_under_a_sky() {
  Scene scene;
  scene.name = "ball";
  scene.width = 2;
  scene.height = 2;
  scene.max_depth = 3;
  scene.environment = ConstantEnvironment{glm::vec3(1.0f)};
  scene.materials.emplace_back();
  Shape ball;
  ball.geometry = Sphere{.center = {0.0f, 0.0f, 3.0f}};
  scene.shapes.push_back(ball);
  return std::make_shared<const TraceScene>(std::move(scene));
}

ReferenceRender new_render() {
  static const auto scene = ball_under_a_sky();
  RenderSettings settings = default_settings(scene->scene());
  settings.seed = reference_seed;
  return {scene, settings};
}

/// A reference that nothing is wrong with, as it comes out of its file.
ExrImage sound_reference() {
  static const ExrImage exr = [] {
    ReferenceRender render = new_render();
    render.add(4);
    return exr_of(render.sums(), "quartet reference");
  }();
  return exr;
}

/// The 32 bits of a pixel of a channel.
void set_bits(ExrChannel& channel, std::size_t pixel, std::uint32_t bits) {
  std::visit(
      [&](auto& pixels) {
        if (pixel < pixels.size()) {
          pixels[pixel] = std::bit_cast<typename std::decay_t<decltype(pixels)>::value_type>(bits);
        }
      },
      channel.pixels);
}

/// A line of the input: NAME=TEXT sets a line of the header, CHANNEL@PIXEL=BITS the bits of a
/// pixel as a decimal number, and NAME alone removes a line of the header or a channel.
void edit(ExrImage& exr, std::string_view line) {
  const std::size_t equals = line.find('=');
  const std::string name(line.substr(0, std::min(line.find('@'), equals)));
  if (equals == std::string_view::npos) {
    exr.attributes.erase(name);
    std::erase_if(exr.channels, [&](const ExrChannel& channel) { return channel.name == name; });
  } else if (name.size() == equals) {
    exr.attributes[name] = line.substr(equals + 1);
  } else {
    const auto number = [&](std::size_t from, std::size_t to) {
      std::uint32_t value = 0;
      std::from_chars(line.data() + from, line.data() + to, value);
      return value;
    };
    for (ExrChannel& channel : exr.channels) {
      if (channel.name == name) {
        set_bits(channel, number(name.size() + 1, equals), number(equals + 1, line.size()));
      }
    }
  }
}

void go_on_with(const ReferenceSums& sums) {
  ReferenceRender render = new_render();
  const bool taken =
      succeeds<std::runtime_error>(reference_name, [&] { render.resume(sums, reference_name); });
  if (!taken) {
    return;
  }
  promise(sums.scene_hash == new_render().sums().scene_hash, "the sums are of another scene");
  const std::optional<ReferenceSums> again =
      sums_of(exr_of(sums, "quartet reference"), reference_name);
  promise(again && again->spp == sums.spp && again->halves == sums.halves,
          "sums come back from their file as others");
  if (sums.spp < 1'000'000) {
    render.add(2);
    promise(render.sums().spp == sums.spp + 2, "samples are not counted");
  }
}

}  // namespace

/// The input edits the file of a sound reference, of 2 x 2 pixels. Then it is read, and gone on
/// with.
void feed_reference(std::string_view input) {
  ExrImage exr = sound_reference();
  while (!input.empty()) {
    const std::string_view line = input.substr(0, input.find('\n'));
    input.remove_prefix(std::min(line.size() + 1, input.size()));
    edit(exr, line);
  }
  std::optional<ReferenceSums> sums;
  succeeds<std::runtime_error>(reference_name, [&] { sums = sums_of(exr, reference_name); });
  if (!sums) {
    return;
  }
  const Reference reference = reference_of(*sums);
  promise(reference.image.width() == exr.width() && reference.image.height() == exr.height(),
          "a reference is not of the size of its file");
  promise(reference.spp == sums->spp, "a reference has another number of samples than its file");
  go_on_with(*sums);
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_reference)
