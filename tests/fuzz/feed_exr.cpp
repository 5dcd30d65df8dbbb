#include <memory>

#include "renderer/files/exr.h"
#include "renderer/measure/reference/reference.h"
#include "tests/fuzz/feed.h"
#include "tests/fuzz/mesh_promises.h"
#include "tests/fuzz/picture_promises.h"

namespace quartet {
namespace {

void promise_image(const ExrImage& image) {
  promise(image.width() > 0 && image.height() > 0, "a picture has no pixels");
  const std::size_t size = std::size_t(image.width()) * std::size_t(image.height());
  for (const ExrChannel& channel : image.channels) {
    promise(std::visit([](const auto& pixels) { return pixels.size(); }, channel.pixels) == size,
            "a channel has not a number for each pixel");
  }
}

}  // namespace

/// The input is an EXR file.
void feed_exr(std::string_view input) {
  const std::filesystem::path path = scratch_file("picture.exr", input);
  succeeds<std::runtime_error>("picture.exr", [&] {
    const ExrImage image = read_exr(path);
    promise_image(image);
    const RadianceImage radiance = radiance_of(image, path);
    promise(radiance.width() == image.display.width && radiance.height() == image.display.height,
            "a picture is not of the size that is shown");
  });
  promise_picture(path, "picture.exr");
  succeeds<std::runtime_error>("picture.exr", [&] {
    const std::shared_ptr<const Reference> reference = load_reference(path);
    for (const glm::vec3& pixel : reference->image.pixels()) {
      promise_finite(pixel, "a reference");
    }
  });
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_exr)
