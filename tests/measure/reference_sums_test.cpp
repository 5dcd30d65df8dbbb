#include "renderer/measure/reference/reference_sums.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/measure/reference/reference_render.h"
#include "renderer/scene/load_scene.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

TEST(ReferenceSums, EveryChannelOfItsFileHoldsItsOwnNumber) {
  ReferenceSums sums;
  sums.scene_name = "some scene";
  sums.scene_hash = "0123";
  sums.spp = 9;  // five and four
  sums.seconds = 2.5;
  sums.settings.width = 2;
  sums.settings.height = 1;
  sums.settings.seed = 77;
  sums.settings.max_depth = 6;
  sums.settings.integrator = IntegratorId::kajiya;
  sums.settings.sampler = SamplerId::replicated;
  sums.halves[0].sums = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  sums.halves[0].rejected = {1, 0};
  sums.halves[1].sums = {{7.0, 8.0, 9.0}, {10.0, 11.0, 12.0}};
  sums.halves[1].rejected = {2, 3};
  const ExrImage exr = exr_of(sums, "quartet reference x");
  const auto floats = [&](const char* name) {
    return std::get<std::vector<float>>(exr.find(name)->pixels);
  };
  const auto words = [&](const std::string& name) {
    return std::get<std::vector<std::uint32_t>>(exr.find(name)->pixels);
  };
  using Floats = std::vector<float>;
  using Words = std::vector<std::uint32_t>;
  // Of 9 less 3 samples, the sums are 8, 10, 12 and 14, 16, 18.
  EXPECT_EQ(floats("R"), (Floats{8.0f / 6, 14.0f / 6}));
  EXPECT_EQ(floats("G"), (Floats{10.0f / 6, 16.0f / 6}));
  EXPECT_EQ(floats("B"), (Floats{12.0f / 6, 18.0f / 6}));
  EXPECT_EQ(floats("SampleCount"), (Floats{6, 6}));
  EXPECT_EQ(floats("Rejected"), (Floats{3, 3}));
  EXPECT_EQ(words("Half0.Rejected"), (Words{1, 0}));
  EXPECT_EQ(words("Half1.Rejected"), (Words{2, 3}));
  EXPECT_EQ(exr.channels.size(), 5u + 2 * 7);
  double expected = 0.0;
  for (const std::string half : {"Half0", "Half1"}) {
    const std::array<Words, 6> parts{words(half + ".R.high"), words(half + ".R.low"),
                                     words(half + ".G.high"), words(half + ".G.low"),
                                     words(half + ".B.high"), words(half + ".B.low")};
    for (std::size_t pixel = 0; pixel < 2; ++pixel) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint64_t bits =
            std::uint64_t(parts[2 * c][pixel]) << 32 | parts[2 * c + 1][pixel];
        EXPECT_EQ(std::bit_cast<double>(bits), expected += 1.0) << half << " " << pixel << " " << c;
      }
    }
  }
  const Reference reference = reference_of(sums);
  EXPECT_EQ(reference.rejected, 6u);
  EXPECT_EQ(reference.halves[0].at(0, 0), glm::vec3(1.0f, 2.0f, 3.0f) / 4.0f);
  EXPECT_EQ(reference.halves[1].at(1, 0), glm::vec3(10.0f, 11.0f, 12.0f));
  std::map<std::string, std::string> attributes = exr.attributes;
  EXPECT_NE(attributes.at("noiseFloor").find("relmse "), std::string::npos);
  for (const char* told_elsewhere : {"reference", "camera", "version", "noiseFloor"}) {
    EXPECT_EQ(attributes.erase(told_elsewhere), 1u) << told_elsewhere;
  }
  EXPECT_EQ(attributes,
            (std::map<std::string, std::string>{{"scene", "some scene"},
                                                {"sceneHash", "0123"},
                                                {"integrator", "kajiya"},
                                                {"sampler", "replicated"},
                                                {"maxDepth", "6"},
                                                {"seed", "77"},
                                                {"spp", "9"},
                                                {"seconds", "2.5"},
                                                {"commandLine", "quartet reference x"}}));
}

TEST(ReferenceSums, FilesOfBeforeThereWasAChoiceHaveTheSamplerOfThen) {
  ReferenceSums sums;
  sums.scene_hash = "0123";
  sums.spp = 2;
  sums.settings.width = sums.settings.height = 1;
  sums.settings.sampler = SamplerId::replicated;
  for (auto& half : sums.halves) {
    half = {{glm::dvec3(1.0)}, {0}};
  }
  for (const auto& [name, expected] : {std::pair{"cornell-box", SamplerId::sobol},
                                       {"synthetic:bernoulli", SamplerId::independent}}) {
    sums.scene_name = name;
    ExrImage exr = exr_of(sums, "");
    EXPECT_EQ(sums_of(exr, "x.exr").value().settings.sampler, SamplerId::replicated);
    EXPECT_EQ(exr.attributes.erase("sampler"), 1u);
    EXPECT_EQ(sums_of(exr, "x.exr").value().settings.sampler, expected) << name;
  }
}

TEST(ReferenceSums, TheSeedsOfItsHalvesDifferFromEachOtherAndFromSeedToSeed) {
  const auto a = half_seeds(5);
  const auto b = half_seeds(6);
  EXPECT_NE(a[0], a[1]);
  EXPECT_NE(a[0], b[0]);
  EXPECT_NE(a[1], b[1]);
  const auto scene = std::make_shared<const TraceScene>(open_scene("synthetic:log-normal"));
  RenderSettings own = default_settings(scene->scene());
  own.width = 4;
  own.height = 3;
  own.seed = 5;
  ReferenceRender render(scene, own);
  render.add(2);
  const auto reference = render.reference();
  EXPECT_NE(reference->halves[0], reference->halves[1]);
  ++own.seed;
  ReferenceRender other(scene, own);
  other.add(2);
  EXPECT_NE(other.reference()->halves[0], reference->halves[0]);
  EXPECT_NE(other.reference()->halves[1], reference->halves[1]);
}

TEST(ReferenceSums, CountsMayBeIntegersAsTheyOnceWere) {
  ReferenceSums sums;
  sums.scene_name = "two";
  sums.scene_hash = "abc";
  sums.settings.width = 2;
  sums.settings.height = 1;
  // More than a float counts one by one.
  sums.spp = (std::uint64_t(1) << 25) + 3;
  sums.halves[0].sums = sums.halves[1].sums = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  sums.halves[0].rejected = {0, 2};
  sums.halves[1].rejected = {0, 0};
  ExrImage exr = exr_of(sums, "quartet reference x");
  EXPECT_EQ(sums_of(exr, "x.exr")->spp, sums.spp);
  const auto set_counts = [&](const char* name, std::vector<std::uint32_t> counts) {
    const_cast<ExrChannel*>(exr.find(name))->pixels = std::move(counts);
  };
  set_counts("SampleCount", {(1u << 25) + 3, (1u << 25) + 1});
  set_counts("Rejected", {0, 2});
  EXPECT_EQ(sums_of(exr, "x.exr")->halves, sums.halves);
  set_counts("SampleCount", {(1u << 25) + 4, (1u << 25) + 1});
  EXPECT_NE(error_of([&] { sums_of(exr, "x.exr"); }).find("SampleCount 33554436"),
            std::string::npos);
}

}  // namespace
}  // namespace quartet
