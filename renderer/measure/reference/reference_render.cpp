#include "renderer/measure/reference/reference_render.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>
#include <utility>

#include "renderer/adaptive/lab.h"
#include "renderer/base/parallel.h"
#include "renderer/base/stopwatch.h"
#include "renderer/trace/store/running_mean.h"

namespace quartet {

namespace {

constexpr int tile_side = 16;  // neighbours meet the same shapes

std::array<SampleSource, 2> sources_of(const std::shared_ptr<const TraceScene>& scene,
                                       RenderSettings settings) {
  std::array<SampleSource, 2> sources;
  const auto seeds = half_seeds(settings.seed);
  for (std::size_t half = 0; half < 2; ++half) {
    settings.seed = seeds[half];
    sources[half] = sample_source(scene, settings);
  }
  return sources;
}

int tiles(int side) {
  return (side + tile_side - 1) / tile_side;
}

}  // namespace

ReferenceRender::ReferenceRender(std::shared_ptr<const TraceScene> scene,
                                 const RenderSettings& settings)
    : ReferenceRender(sources_of(scene, settings), settings) {
  sums_.scene_name = scene->scene().name;
  sums_.scene_hash = scene_hash(scene->scene());
}

ReferenceRender::ReferenceRender(std::array<SampleSource, 2> sources,
                                 const RenderSettings& settings)
    : sources_(std::move(sources)) {
  sums_.settings = settings;
  const std::size_t pixels = std::size_t(settings.width) * std::size_t(settings.height);
  sums_.halves.fill(
      {std::vector<glm::dvec3>(pixels, glm::dvec3(0.0)), std::vector<std::uint32_t>(pixels, 0)});
}

void ReferenceRender::add(std::uint32_t spp) {
  add(spp, nullptr);
}

bool ReferenceRender::add(std::uint32_t spp, const std::function<bool()>& gives_way) {
  // A pass that is given up has added to some pixels and not to others.
  const auto before = gives_way ? sums_.halves : decltype(sums_.halves){};
  std::atomic<bool> given_up = false;
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  if (sums_.spp + spp > most) {
    throw std::runtime_error(
        fmt::format("a reference of more than {} samples a pixel is not possible", most));
  }
  const Stopwatch watch;
  ReferenceSums after;  // for its counts alone
  after.spp = sums_.spp + spp;
  const std::size_t columns = std::size_t(tiles(sums_.settings.width));
  const std::size_t count = columns * std::size_t(tiles(sums_.settings.height));
  parallel_for(2 * count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t job = begin; job < end; ++job) {
      if (given_up || (gives_way && gives_way())) {
        given_up = true;
        return;
      }
      const std::size_t half = job % 2;
      const std::uint64_t first = sums_.samples_of(half);
      add_tile(half, job / 2, std::uint32_t(first), std::uint32_t(after.samples_of(half) - first));
    }
  });
  if (given_up) {
    sums_.halves = before;
    return false;
  }
  sums_.spp = after.spp;
  sums_.seconds += watch.seconds();
  return true;
}

void ReferenceRender::add_tile(std::size_t half, std::size_t tile, std::uint32_t first,
                               std::uint32_t count) {
  constexpr std::uint32_t batch = 64;
  std::array<glm::vec3, batch> samples;
  const int width = sums_.settings.width;
  const int left = int(tile % std::size_t(tiles(width))) * tile_side;
  const int top = int(tile / std::size_t(tiles(width))) * tile_side;
  const int right = std::min(left + tile_side, width);
  const int bottom = std::min(top + tile_side, sums_.settings.height);
  ReferenceSums::Half& into = sums_.halves[half];
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const std::size_t pixel = std::size_t(y) * std::size_t(width) + std::size_t(x);
      // One by one and in order, so that pauses change nothing.
      glm::dvec3 sum = into.sums[pixel];
      for (std::uint32_t done = 0; done < count; done += batch) {
        const std::span<glm::vec3> some(samples.data(), std::min(batch, count - done));
        sources_[half](x, y, first + done, some);
        for (const glm::vec3& sample : some) {
          if (acceptable(sample)) {
            sum += glm::dvec3(sample);
          } else {
            ++into.rejected[pixel];
          }
        }
      }
      into.sums[pixel] = sum;
    }
  }
}

void ReferenceRender::resume(ReferenceSums sums, const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw std::runtime_error(fmt::format(
        "{} cannot be gone on with: {}; choose another name, or remove it", path.string(), reason));
  };
  if (sums.scene_hash != sums_.scene_hash) {
    refuse(fmt::format("it shows '{}' as of hash {}, not '{}' of hash {}", sums.scene_name,
                       sums.scene_hash, sums_.scene_name, sums_.scene_hash));
  }
  const RenderSettings& made = sums.settings;
  const RenderSettings& wanted = sums_.settings;
  if (made.width != wanted.width || made.height != wanted.height) {
    refuse(fmt::format("it has {}x{} pixels, not {}x{}", made.width, made.height, wanted.width,
                       wanted.height));
  }
  if (made.integrator != wanted.integrator) {
    refuse(fmt::format("it was made with {}, not {}", integrator(made.integrator).id,
                       integrator(wanted.integrator).id));
  }
  if (made.sampler != wanted.sampler) {
    refuse(fmt::format("it was made with the sampler {}, not {}", sampler_row(made.sampler).id,
                       sampler_row(wanted.sampler).id));
  }
  if (made.seed != wanted.seed) {
    refuse(fmt::format("it was made with seed {}, not {}", made.seed, wanted.seed));
  }
  if (made.max_depth != wanted.max_depth) {
    refuse("it was made with another depth");
  }
  if (made.camera != wanted.camera) {
    refuse("it was seen by another camera");
  }
  sums_ = std::move(sums);
}

}  // namespace quartet
