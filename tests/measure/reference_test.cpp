#include "renderer/measure/reference/reference.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>

#include "renderer/adaptive/lab.h"
#include "renderer/files/exr.h"
#include "renderer/measure/reference/reference_render.h"
#include "renderer/scene/load_scene.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

constexpr int odd_width = 37;  // not a multiple of a tile
constexpr int odd_height = 21;
constexpr std::size_t odd_pixels = std::size_t(odd_width) * odd_height;

std::shared_ptr<const TraceScene> box() {
  static const auto scene =
      std::make_shared<const TraceScene>(load_scene(find_scene("cornell-box")));
  return scene;
}

RenderSettings settings() {
  RenderSettings settings = default_settings(box()->scene());
  settings.width = odd_width;
  settings.height = odd_height;
  settings.max_depth = 3;
  settings.seed = reference_seed;
  return settings;
}

/// Exponential numbers of mean 1, a function of seed, pixel, index and channel (SplitMix64). Their
/// sums need all of a double's digits.
float exponential(std::uint64_t seed, int x, int y, std::uint64_t index, std::uint64_t channel) {
  std::uint64_t z = 0;
  for (const std::uint64_t part :
       {seed, std::uint64_t(y) * odd_width + std::uint64_t(x), index, channel}) {
    z = (z ^ part) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
  }
  return float(-std::log1p(-double(z >> 11) * 0x1p-53));
}

SampleSource noise(std::uint64_t seed) {
  return [seed](int x, int y, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        radiance[i][c] = exponential(seed, x, y, first + i, std::uint64_t(c));
      }
    }
  };
}

void expect_same(const ReferenceSums& a, const ReferenceSums& b) {
  EXPECT_EQ(a.spp, b.spp);
  EXPECT_EQ(a.scene_hash, b.scene_hash);
  EXPECT_EQ(a.settings, b.settings);
  for (std::size_t half = 0; half < 2; ++half) {
    EXPECT_TRUE(a.halves[half] == b.halves[half]) << "half " << half;
  }
}

ReferenceSums read(const std::filesystem::path& path) {
  const std::optional<ReferenceSums> sums = sums_of(read_exr(path), path);
  EXPECT_TRUE(sums.has_value());
  return sums.value_or(ReferenceSums{});
}

/// A picture of another program.
void write_foreign(const std::filesystem::path& path, glm::vec3 last) {
  RadianceImage image(odd_width, odd_height, glm::vec3(0.25f));
  image.at(odd_width - 1, odd_height - 1) = last;
  ExrImage exr(odd_width, odd_height);
  exr.add_radiance(image);
  write_exr(path, exr);
}

TEST(Reference, IsTheMeanOfAllSamplesOfBothSources) {
  ReferenceRender render({noise(1), noise(2)}, settings());
  render.add(5);
  const auto reference = render.reference();
  EXPECT_EQ(reference->spp, 5u);
  EXPECT_EQ(reference->rejected, 0u);
  for (const auto& [x, y] : {std::pair{0, 0}, {odd_width - 1, odd_height - 1}, {16, 15}}) {
    std::array<glm::vec3, 3> first;
    std::array<glm::vec3, 2> second;
    noise(1)(x, y, 0, first);
    noise(2)(x, y, 0, second);
    const glm::dvec3 a = glm::dvec3(first[0]) + glm::dvec3(first[1]) + glm::dvec3(first[2]);
    const glm::dvec3 b = glm::dvec3(second[0]) + glm::dvec3(second[1]);
    EXPECT_EQ(reference->image.at(x, y), glm::vec3((a + b) / 5.0));
    EXPECT_EQ(reference->halves[0].at(x, y), glm::vec3(a / 3.0));
    EXPECT_EQ(reference->halves[1].at(x, y), glm::vec3(b / 2.0));
  }
}

TEST(Reference, RejectsCountsAndLeavesOutBadSamples) {
  const SampleSource with_bad = [](int, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      const std::uint32_t index = first + std::uint32_t(i);
      radiance[i] = index == 0   ? glm::vec3(std::numeric_limits<float>::quiet_NaN())
                    : index == 1 ? glm::vec3(1.0f, -1.0f, 1.0f)
                                 : glm::vec3(3.0f);
    }
  };
  ReferenceRender render({with_bad, with_bad}, settings());
  render.add(2);
  EXPECT_EQ(render.reference()->image.at(3, 3), glm::vec3(0.0f)) << "nothing left";
  render.add(8);
  const auto reference = render.reference();
  EXPECT_EQ(reference->image.at(3, 3), glm::vec3(3.0f));
  EXPECT_EQ(reference->rejected, 4 * odd_pixels);
}

TEST(Reference, GoesOnFromAFileToTheBit) {
  const TempFolder folder;
  ReferenceRender at_once(box(), settings());
  at_once.add(200);
  ReferenceRender first(box(), settings());
  first.add(3);
  first.add(64);
  write_exr(folder / "ref.exr", exr_of(first.sums(), "quartet"));
  ReferenceRender second(box(), settings());
  second.resume(read(folder / "ref.exr"), folder / "ref.exr");
  EXPECT_EQ(second.sums().spp, 67u);
  second.add(133);
  expect_same(second.sums(), at_once.sums());
  write_exr(folder / "ref.exr", exr_of(second.sums(), "quartet"));
  expect_same(read(folder / "ref.exr"), at_once.sums());
  EXPECT_EQ(load_reference(folder / "ref.exr")->image, at_once.reference()->image);
  EXPECT_EQ(load_reference(folder / "ref.exr")->halves, at_once.reference()->halves);
}

TEST(Reference, SumsOfTinyAndHugeSamplesSurviveTheFile) {
  const TempFolder folder;
  const SampleSource extreme = [](int x, int, std::uint32_t first, std::span<glm::vec3> radiance) {
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      radiance[i] = {x % 2 == 0 ? 1e-44f : 3e38f, 1.0f / float(first + i + 1), 0.0f};
    }
  };
  ReferenceRender render({extreme, extreme}, settings());
  render.add(7);
  write_exr(folder / "ref.exr", exr_of(render.sums(), "quartet"));
  expect_same(read(folder / "ref.exr"), render.sums());
}

TEST(Reference, DoesNotDependOnTheNumberOfThreads) {
  const auto sums = [](int threads) {
    ReferenceRender render(box(), settings());
    tbb::task_arena(threads).execute([&] { render.add(9); });
    return render.sums();
  };
  const ReferenceSums one = sums(1);
  expect_same(sums(2), one);
  expect_same(sums(8), one);
}

// Half the difference of two halves of n samples each has the variance σ²/2n of the whole. With
// 37 × 21 × 3 values, the estimate of it is off by 3 % (one standard deviation of chi-square); 5 of
// these have a false-alarm rate of 1e-6.
TEST(Reference, NoiseFloorIsTheErrorOfTheReferenceItself) {
  ReferenceRender render({noise(1), noise(2)}, settings());
  render.add(64);
  const double truth = 1.0 / 64.0;  // exponential samples have variance 1
  EXPECT_NEAR(render.reference()->noise_floor(MetricId::mse), truth, 0.15 * truth);
  const auto reference = render.reference();
  double squares = 0.0;
  for (std::size_t i = 0; i < odd_pixels; ++i) {
    const glm::dvec3 d = reference->halves[0].pixels()[i] - reference->halves[1].pixels()[i];
    squares += glm::dot(d, d) / 3.0 / double(odd_pixels);
  }
  EXPECT_NEAR(reference->noise_floor(MetricId::mse), squares / 4.0, 1e-6 * squares);
  EXPECT_NEAR(reference->noise_floor(MetricId::rmse), std::sqrt(squares / 4.0), 1e-6);
  // What a reference of many more samples says of it.
  ReferenceRender better({noise(3), noise(4)}, settings());
  better.add(6400);
  const double measured =
      metric(MetricId::mse).compute(reference->image, better.reference()->image);
  EXPECT_NEAR(measured, 1.01 * truth, 0.15 * truth);
}

TEST(Reference, NoiseFloorIsUnknownWithoutTwoHalves) {
  ReferenceRender render({noise(1), noise(2)}, settings());
  render.add(1);
  EXPECT_TRUE(std::isnan(render.reference()->noise_floor(MetricId::mse)));
  EXPECT_TRUE(std::isnan(Reference{}.noise_floor(MetricId::mse)));
}

TEST(Reference, StaysRightAtTenMillionSamplesAPixel) {
  RenderSettings tiny = settings();
  tiny.width = tiny.height = 1;
  const SampleSource tenth = [](int, int, std::uint32_t, std::span<glm::vec3> radiance) {
    std::ranges::fill(radiance, glm::vec3(0.1f, 1e-3f, 700.0f));
  };
  ReferenceRender render({tenth, tenth}, tiny);
  render.add(10'000'000);
  EXPECT_EQ(render.reference()->image.at(0, 0), glm::vec3(0.1f, 1e-3f, 700.0f));
}

TEST(Reference, SamplesInAnyOrderGiveTheSameSums) {
  RenderSettings tiny = settings();
  tiny.width = tiny.height = 2;
  constexpr std::uint32_t spp = 1u << 15;  // of a half
  // The same samples of a half in another order: an odd factor permutes the indices below 2^15.
  const auto in_order_of = [](std::uint64_t seed, std::uint32_t factor) -> SampleSource {
    return [source = noise(seed), factor](int x, int y, std::uint32_t first,
                                          std::span<glm::vec3> radiance) {
      for (std::uint32_t i = 0; i < radiance.size(); ++i) {
        source(x, y, (first + i) * factor % spp, radiance.subspan(i, 1));
        radiance[i] *= radiance[i] * radiance[i];  // a longer tail: sums round
      }
    };
  };
  const auto sums_of_order = [&](std::uint32_t factor) {
    ReferenceRender render({in_order_of(1, factor), in_order_of(2, factor)}, tiny);
    render.add(2 * spp);
    return render.sums();
  };
  const ReferenceSums once = sums_of_order(1);
  bool differs = false;
  for (const std::uint32_t factor : {5u, 77u, 12345u, 32767u}) {
    const ReferenceSums other = sums_of_order(factor);
    for (std::size_t half = 0; half < 2; ++half) {
      for (std::size_t i = 0; i < 4; ++i) {
        for (int c = 0; c < 3; ++c) {
          const double ratio = other.halves[half].sums[i][c] / once.halves[half].sums[i][c];
          EXPECT_NEAR(ratio, 1.0, 1e-12);
          differs |= ratio != 1.0;
        }
      }
    }
  }
  EXPECT_TRUE(differs) << "not one sum was rounded: the samples are too tame to show anything";
}

TEST(Reference, FitsItsOwnSceneAndSaysWhyItFitsNoOther) {
  const TempFolder folder;
  ReferenceRender render(box(), settings());
  render.add(2);
  write_exr(folder / "ref.exr", exr_of(render.sums(), "quartet"));
  const auto reference = load_reference(folder / "ref.exr");
  EXPECT_TRUE(reference->ours());
  EXPECT_EQ(reference->scene_name, "cornell-box");
  RenderSettings run = settings();
  run.seed = 0;
  const auto reason = [&](const Scene& scene, const RenderSettings& of) {
    return error_of([&] { check_reference(*reference, scene, of); });
  };
  EXPECT_EQ(reason(box()->scene(), run), "");
  RenderSettings other = run;
  other.integrator = IntegratorId::kajiya;
  EXPECT_EQ(reason(box()->scene(), other), "") << "all integrators have the same mean";
  other = run;
  other.sampler = SamplerId::replicated;
  EXPECT_EQ(reason(box()->scene(), other), "") << "so have all samplers";
  const auto expect_reason = [&](const RenderSettings& of, const std::string& part) {
    const std::string text = reason(box()->scene(), of);
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("ref.exr"), std::string::npos) << text;
  };
  other = run;
  other.width = 38;
  expect_reason(other, "37x21 pixels, the run has 38x21");
  other = run;
  other.camera.origin.x += 1e-4f;
  expect_reason(other, "camera");
  other = run;
  other.max_depth = std::numeric_limits<int>::max();
  expect_reason(other, "depth 3, the run has unlimited depth");
  for (const std::uint64_t seed : half_seeds(reference_seed)) {
    other = run;
    other.seed = seed;
    expect_reason(other, "same random numbers");
    other.sampler = SamplerId::independent;
    EXPECT_EQ(reason(box()->scene(), other), "") << "of another sampler they are others";
  }
  Scene redder = box()->scene();
  std::get<Diffuse>(redder.materials[0].kind).reflectance.value.r += 1e-6f;
  EXPECT_NE(reason(redder, run).find("hash"), std::string::npos);
}

TEST(Reference, ResumesOnlyWhatItIs) {
  const std::filesystem::path path = "ref.exr";
  ReferenceRender render(box(), settings());
  render.add(2);
  const auto refused = [&](const RenderSettings& of) {
    return error_of([&] { ReferenceRender(box(), of).resume(render.sums(), path); });
  };
  EXPECT_EQ(refused(settings()), "");
  RenderSettings other = settings();
  other.height = 22;
  EXPECT_NE(refused(other).find("37x21"), std::string::npos);
  other = settings();
  other.integrator = IntegratorId::kajiya;
  EXPECT_NE(refused(other).find("made with mis, not kajiya"), std::string::npos);
  other = settings();
  other.sampler = SamplerId::replicated;
  EXPECT_NE(refused(other).find("made with the sampler sobol, not replicated"), std::string::npos);
  other = settings();
  other.seed = 5;
  EXPECT_NE(refused(other).find("seed"), std::string::npos);
  other = settings();
  other.max_depth = 4;
  EXPECT_NE(refused(other).find("depth"), std::string::npos);
  other = settings();
  other.camera.fov += 1.0f;
  EXPECT_NE(refused(other).find("camera"), std::string::npos);
  const auto furnace = std::make_shared<const TraceScene>(load_scene(find_scene("furnace")));
  EXPECT_NE(error_of([&] {
              ReferenceRender(furnace, settings()).resume(render.sums(), path);
            }).find("'cornell-box'"),
            std::string::npos);
}

TEST(Reference, OfAnIntegratorThatMissesLightIsRefused) {
  Scene scene = box()->scene();
  Reference reference;
  reference.settings = settings();
  reference.settings.integrator = IntegratorId::kajiya;
  RenderSettings run = settings();
  run.seed = 1;
  reference.scene_hash = scene_hash(scene);
  EXPECT_EQ(error_of([&] { check_reference(reference, scene, run); }), "");
  scene.delta_lights.emplace_back();
  reference.scene_hash = scene_hash(scene);
  EXPECT_NE(error_of([&] {
              check_reference(reference, scene, run);
            }).find("kajiya cannot find point lights"),
            std::string::npos);
  // Nor is one made, whoever asks.
  run.integrator = IntegratorId::kajiya;
  const auto lit = std::make_shared<const TraceScene>(scene);
  EXPECT_THROW(ReferenceRender(lit, run), std::invalid_argument);
  EXPECT_THROW(sample_source(lit, run), std::invalid_argument);
}

TEST(Reference, OfAnotherProgramIsKnownByItsSizeAlone) {
  const TempFolder folder;
  write_foreign(folder / "foreign.exr", glm::vec3(0.25f));
  const auto reference = load_reference(folder / "foreign.exr");
  EXPECT_FALSE(reference->ours());
  EXPECT_EQ(reference->image.at(0, 0), glm::vec3(0.25f));
  EXPECT_TRUE(std::isnan(reference->noise_floor(MetricId::mse)));
  RenderSettings run = settings();
  EXPECT_EQ(error_of([&] { check_reference(*reference, box()->scene(), run); }), "");
  run.width = 64;
  EXPECT_NE(error_of([&] { check_reference(*reference, box()->scene(), run); }).find("37x21"),
            std::string::npos);
}

TEST(Reference, WithAPixelThatIsNotFiniteIsRefused) {
  const TempFolder folder;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    write_foreign(folder / "bad.exr", {0.0f, bad, 0.0f});
    const std::string message = error_of([&] { load_reference(folder / "bad.exr"); });
    EXPECT_NE(message.find("bad.exr"), std::string::npos) << message;
    EXPECT_NE(message.find("(36, 20)"), std::string::npos) << message;
  }
  EXPECT_NE(error_of([&] { load_reference(folder / "none.exr"); }).find("none.exr"),
            std::string::npos);
}

TEST(Reference, DamageInItsHeaderIsFound) {
  const TempFolder folder;
  ReferenceRender render(box(), settings());
  render.add(2);
  const ExrImage good = exr_of(render.sums(), "quartet");
  for (const auto& [name, text] :
       std::initializer_list<std::pair<std::string, std::string>>{{"spp", "many"},
                                                                  {"camera", "origin 1 2"},
                                                                  {"integrator", "magic"},
                                                                  {"sampler", "halton"},
                                                                  {"maxDepth", ""},
                                                                  {"maxDepth", "-7"},
                                                                  {"spp", "1"},
                                                                  {"spp", "0"},
                                                                  {"spp", "99999999999"},
                                                                  {"seconds", "nan"},
                                                                  {"seconds", "inf"},
                                                                  {"seconds", "1e300"},
                                                                  {"seconds", "-1"},
                                                                  {"seed", "-1"}}) {
    ExrImage bad = good;
    bad.attributes[name] = text;
    const std::string message = error_of([&] { sums_of(bad, "x.exr"); });
    EXPECT_NE(message.find("x.exr is a damaged reference"), std::string::npos) << name << message;
    bad.attributes.erase(name);
    const std::string missing = error_of([&] { sums_of(bad, "x.exr"); });
    // Of before there was a choice of samplers: they say nothing of it.
    EXPECT_EQ(missing.find(name) != std::string::npos, name != "sampler") << name << missing;
  }
  ExrImage bad = good;
  std::erase_if(bad.channels, [](const ExrChannel& c) { return c.name == "Half1.G.low"; });
  EXPECT_NE(error_of([&] { sums_of(bad, "x.exr"); }).find("Half1.G.low"), std::string::npos);
}

TEST(Reference, PixelsMustBeThoseOfTheirSumsAndCounts) {
  ReferenceRender render(box(), settings());
  render.add(3);
  const ExrImage good = exr_of(render.sums(), "quartet");
  EXPECT_EQ(error_of([&] { sums_of(good, "x.exr"); }), "");
  const auto word = [](ExrImage& exr, const char* name) -> std::uint32_t& {
    return std::get<std::vector<std::uint32_t>>(
        const_cast<ExrChannel*>(exr.find(name))->pixels)[37];
  };
  const auto number = [](ExrImage& exr, const char* name) -> float& {
    return std::get<std::vector<float>>(const_cast<ExrChannel*>(exr.find(name))->pixels)[37];
  };
  const std::vector<std::function<void(ExrImage&)>> damages{
      [&](ExrImage& e) { ++number(e, "SampleCount"); },
      [&](ExrImage& e) { --number(e, "SampleCount"), ++number(e, "Rejected"); },
      [&](ExrImage& e) { number(e, "SampleCount") = std::numeric_limits<float>::quiet_NaN(); },
      [&](ExrImage& e) { ++word(e, "Half0.Rejected"); },
      [&](ExrImage& e) {
        // More than the half has samples.
        word(e, "Half1.Rejected") = 2;
        number(e, "Rejected") = 2;
        number(e, "SampleCount") = 1;
      },
      [&](ExrImage& e) { word(e, "Half0.R.high") += 1u << 20; },    // twice the sum
      [&](ExrImage& e) { word(e, "Half1.G.high") = 0xbff00000u; },  // negative
      [&](ExrImage& e) { word(e, "Half0.B.high") = 0x7ff00000u; },  // infinite
      [&](ExrImage& e) { word(e, "Half0.B.high") = 0x7ff80000u; },  // no number
      [&](ExrImage& e) {
        std::get<std::vector<float>>(const_cast<ExrChannel*>(e.find("G"))->pixels)[37] += 0.5f;
      },
      [&](ExrImage& e) { e.display.width -= 1; }};
  for (std::size_t i = 0; i < damages.size(); ++i) {
    ExrImage bad = good;
    damages[i](bad);
    EXPECT_NE(error_of([&] { sums_of(bad, "x.exr"); }).find("x.exr is a damaged reference"),
              std::string::npos)
        << i;
  }
}

TEST(Reference, OfTwoWritersTheOneWithMoreSamplesStays) {
  const TempFolder folder;
  const std::filesystem::path path = folder / "ref.exr";
  ReferenceRender few(box(), settings());
  few.add(2);
  EXPECT_EQ(samples_in(path, few.sums()), 0u);
  write_exr(path, exr_of(few.sums(), "quartet"));
  EXPECT_EQ(samples_in(path, few.sums()), 2u);
  ReferenceRender more(box(), settings());
  more.add(5);
  EXPECT_EQ(samples_in(path, more.sums()), 2u);
  ReferenceSums other = more.sums();
  other.settings.seed += 1;
  EXPECT_EQ(samples_in(path, other), 0u);
  other = more.sums();
  other.scene_hash = "another";
  EXPECT_EQ(samples_in(path, other), 0u);
  ExrImage damaged = exr_of(more.sums(), "quartet");
  damaged.attributes["spp"] = "1000";
  write_exr(path, damaged);
  EXPECT_EQ(samples_in(path, few.sums()), 0u);
  write_bytes_to(path, "no picture");
  EXPECT_EQ(samples_in(path, few.sums()), 0u);
}

TEST(SceneHash, IsOfWhatIsRendered) {
  const Scene& scene = box()->scene();
  const std::string hash = scene_hash(scene);
  EXPECT_EQ(hash.size(), 16u);
  Scene renamed = scene;
  renamed.name = "other";
  renamed.path = "/elsewhere.xml";
  renamed.shapes[0].id = "floor";
  renamed.shapes[0].line += 5;
  renamed.materials[0].id = "white";
  renamed.camera.fov = 10.0f;
  renamed.width = 7;
  renamed.max_depth = 3;
  renamed.warnings.emplace_back("something");
  EXPECT_EQ(scene_hash(renamed), hash);

  std::vector<Scene> changed(8, scene);
  std::get<Diffuse>(changed[0].materials[0].kind).reflectance.value.b += 1e-7f;
  changed[1].materials[0].two_sided = !scene.materials[0].two_sided;
  changed[2].environment = ConstantEnvironment{{0.0f, 0.1f, 0.0f}};
  changed[3].textures.emplace_back();
  std::get<Mesh>(changed[4].shapes[0].geometry).positions[0].y += 1e-3f;
  changed[5].shapes.pop_back();
  changed[6].shapes[0].material += 1;
  changed[7].shapes[0].emits = !scene.shapes[0].emits;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    EXPECT_NE(scene_hash(changed[i]), hash) << "change " << i;
  }
}

}  // namespace
}  // namespace quartet
