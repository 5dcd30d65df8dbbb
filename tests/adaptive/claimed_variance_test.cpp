#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "renderer/adaptive/film/film.h"
#include "renderer/adaptive/lab.h"
#include "renderer/base/parallel.h"
#include "renderer/scene/load_scene.h"
#include "tests/trace/statistics.h"

// The variance of a pixel's mean, as a film has it, against how far that mean really scatters over
// seeds.

namespace quartet {
namespace {

using test::Moments;

/// The film's variance over the true one, each summed over pixels and channels, at these numbers of
/// samples a pixel (ascending).
std::vector<double> claimed_over_actual(const std::shared_ptr<const TraceScene>& scene,
                                        RenderSettings settings, std::uint32_t seeds,
                                        const std::vector<std::uint32_t>& spp) {
  const auto pixels = std::size_t(settings.width) * std::size_t(settings.height);
  std::vector<double> claimed(spp.size() * pixels, 0.0);
  std::vector<std::array<Moments, 3>> means(spp.size() * pixels);
  for (std::uint32_t k = 0; k < seeds; ++k) {
    settings.seed = 1000 + k;
    const SampleSource source = sample_source(scene, settings);
    Film film(settings.width, settings.height,
              {.variance = true, .replicated = settings.sampler == SamplerId::replicated});
    film.keep_sums();
    parallel_for(pixels, 256, [&](std::size_t begin, std::size_t end) {
      std::vector<std::vector<glm::vec3>> radiance(end - begin);
      std::vector<SampleJob> jobs;
      for (std::size_t i = begin; i < end; ++i) {
        radiance[i - begin].resize(spp.back());
        jobs.push_back({int(i) % settings.width, int(i) / settings.width, 0, radiance[i - begin]});
      }
      source(jobs);
      for (std::size_t i = begin; i < end; ++i) {
        std::span<const glm::vec3> rest = radiance[i - begin];
        for (std::size_t at = 0; at < spp.size(); ++at) {
          const std::size_t count = spp[at] - (at > 0 ? spp[at - 1] : 0);
          film.add(i, rest.first(count));
          rest = rest.subspan(count);
          const glm::dvec3 variance = film.variance_of_mean(i);
          claimed[at * pixels + i] += variance.x + variance.y + variance.z;
          for (int c = 0; c < 3; ++c) {
            means[at * pixels + i][std::size_t(c)].add(double(film.mean(c)[i]));
          }
        }
      }
    });
  }
  std::vector<double> ratios;
  for (std::size_t at = 0; at < spp.size(); ++at) {
    double of_films = 0.0;
    double of_means = 0.0;
    for (std::size_t i = at * pixels; i < (at + 1) * pixels; ++i) {
      of_films += claimed[i] / seeds;
      for (const Moments& channel : means[i]) {
        of_means += channel.variance();
      }
    }
    ratios.push_back(of_films / of_means);
  }
  return ratios;
}

std::vector<double> ratios_in(const std::string& name, int width, int height, SamplerId sampler,
                              std::uint32_t seeds, const std::vector<std::uint32_t>& spp) {
  const auto scene = std::make_shared<const TraceScene>(open_scene(name));
  RenderSettings settings = default_settings(scene->scene());
  settings.width = width;
  settings.height = height;
  settings.sampler = sampler;
  return claimed_over_actual(scene, settings, seeds, spp);
}

// Edges everywhere, so that no few pixels decide. Over eight other sets of 16 seeds the ratios
// scattered about 1 with a standard deviation of 0.02: a false alarm in 10^5.
TEST(ClaimedVariance, IsRightOfSamplersThatKnowIt) {
  for (const SamplerRow& row : samplers()) {
    const double ratio = ratios_in("failures/checker-sharp", 32, 24, row.key, 16, {16}).front();
    if (row.knows_variance) {
      EXPECT_NEAR(ratio, 1.0, 0.1) << row.id;
    } else {
      EXPECT_GT(ratio, 2.0) << row.id << ": it could be called a variance of the mean";
    }
  }
}

// A table for people; takes two minutes. --gtest_also_run_disabled_tests
TEST(ClaimedVariance, DISABLED_InFull) {
  for (const std::string name : {"cornell-checker", "cornell-box", "failures/checker-sharp"}) {
    for (const SamplerRow& row : samplers()) {
      const std::vector<double> ratios = ratios_in(name, 120, 68, row.key, 48, {4, 16, 64});
      fmt::print("{:<24} {:<12} {:6.3f} {:6.3f} {:6.3f}\n", name, row.id, ratios[0], ratios[1],
                 ratios[2]);
      for (const double ratio : ratios) {
        EXPECT_TRUE(!row.knows_variance || std::abs(ratio - 1.0) < 0.1) << name << " " << row.id;
      }
    }
  }
}

}  // namespace
}  // namespace quartet
