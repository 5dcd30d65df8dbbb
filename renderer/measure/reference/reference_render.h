#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "renderer/measure/reference/reference_sums.h"
#include "renderer/trace/store/sample_store.h"

namespace quartet {

/// A reference in the making. Keeps sums and not samples: 56 bytes a pixel, however many samples
/// there are. It can go on from the sums of a file, and ends to the bit where it would have ended
/// without the pause.
class ReferenceRender {
 public:
  /// Of a scene. The halves have seeds of their own, made of settings.seed.
  ReferenceRender(std::shared_ptr<const TraceScene> scene, const RenderSettings& settings);
  /// Of any two sources of samples, which must know nothing of each other; only the size is looked
  /// at in `settings`.
  ReferenceRender(std::array<SampleSource, 2> sources, const RenderSettings& settings);

  /// Adds so many samples a pixel, to each half in turn, on the threads of the current TBB arena.
  void add(std::uint32_t spp);
  /// The same, unless `gives_way`, which is asked often and on these threads, says that it is to
  /// end: then the sums are as before, and it returns false.
  bool add(std::uint32_t spp, const std::function<bool()>& gives_way);

  /// Takes up sums in the place of what is here. Throws std::runtime_error with the reason if they
  /// are not of this scene with these settings; `path` is where they come from.
  void resume(ReferenceSums sums, const std::filesystem::path& path);

  const ReferenceSums& sums() const { return sums_; }
  std::shared_ptr<const Reference> reference() const {
    return std::make_shared<const Reference>(reference_of(sums_));
  }

 private:
  void add_tile(std::size_t half, std::size_t tile, std::uint32_t first, std::uint32_t count);

  std::array<SampleSource, 2> sources_;
  ReferenceSums sums_;
};

}  // namespace quartet
