#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "renderer/files/exr.h"
#include "renderer/files/png.h"
#include "renderer/measure/left_out.h"
#include "renderer/measure/reference/reference_sums.h"
#include "tests/app/program.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

class PicturesOfOthers : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static std::string given(const std::string& name) {
    return (std::filesystem::path(QUARTET_TEST_DATA) / "pictures" / name).string();
  }

  void write(const std::string& name, const RadianceImage& image,
             const std::string& layer = "") const {
    ExrImage exr(image.width(), image.height());
    exr.add_radiance(image);
    for (ExrChannel& channel : exr.channels) {
      channel.name = layer + channel.name;
    }
    write_exr(path(name), exr);
  }

  static nlohmann::json compare(std::vector<std::string> words) {
    words.insert(words.begin(), "compare");
    words.emplace_back("--json");
    const Result result = run(words);
    EXPECT_EQ(result.code, 0) << result.error;
    return result.code == 0 ? nlohmann::json::parse(result.out) : nlohmann::json();
  }

  TempFolder folder_;
};

TEST_F(PicturesOfOthers, PixelsThatAreNotFiniteAreLeftOutCountedAndTold) {
  RadianceImage test(20, 15, glm::vec3(0.5f));
  RadianceImage truth(20, 15, glm::vec3(0.25f));
  test.at(3, 4).g = std::numeric_limits<float>::quiet_NaN();
  test.at(5, 4) = glm::vec3(std::numeric_limits<float>::infinity());
  truth.at(5, 4).r = std::numeric_limits<float>::quiet_NaN();
  write("test.exr", test);
  write("truth.exr", truth);
  const std::vector<std::string> words{"compare", path("test.exr"), path("truth.exr")};
  const Result result = run(words);
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.error,
            fmt::format("quartet: warning: 2 of 300 pixels are left out of every number: 2 NaN or "
                        "infinite in {}, 1 NaN or infinite in {}\n",
                        path("test.exr"), path("truth.exr")));
  const auto json = compare({path("test.exr"), path("truth.exr")});
  EXPECT_EQ(json.at("left_out"), nlohmann::json({{"pixels", 2},
                                                 {"test_not_finite", 2},
                                                 {"reference_not_finite", 1},
                                                 {"not_covered", 0}}));
  EXPECT_DOUBLE_EQ(json.at("metrics").at("mse").get<double>(), 0.0625);
  EXPECT_DOUBLE_EQ(json.at("test_mean").at(1).get<double>(), 0.5);
  for (const Metric& row : metrics()) {
    EXPECT_DOUBLE_EQ(json.at("metrics").at(row.id).get<double>(),
                     compute_over_finite(row, test, truth))
        << row.id;
  }

  // The numbers come all the same.
  std::vector<std::string> strict = words;
  strict.emplace_back("--strict");
  const Result failed = run(strict);
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(failed.out, result.out);
  EXPECT_NE(failed.error.find("--strict: 2 of 300 pixels"), std::string::npos) << failed.error;
  EXPECT_EQ(std::ranges::count(failed.error, '\n'), 1) << failed.error;
  EXPECT_EQ(run({"compare", path("truth.exr"), path("truth.exr"), "--strict"}).code, 1);

  // Where the error is, they are gray.
  std::vector<std::string> drawn = words;
  drawn.insert(drawn.end(), {"--picture", path("error.png"), "--metric", "flip"});
  EXPECT_EQ(run(drawn).code, 0);
  const DisplayImage picture = read_png(path("error.png"));
  EXPECT_NE(std::ranges::find(picture.pixels(), Rgba8{128, 128, 128, 255}), picture.pixels().end());

  write("none.exr", RadianceImage(20, 15, glm::vec3(std::numeric_limits<float>::quiet_NaN())));
  const Result none = run({"compare", path("none.exr"), path("truth.exr")});
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.error.find("no pixel is finite in both"), std::string::npos) << none.error;
}

TEST_F(PicturesOfOthers, EveryFormatComparesWithEveryOther) {
  const auto mse = [](const std::string& test, const std::string& truth) {
    return compare({given(test), given(truth)}).at("metrics").at("mse").get<double>();
  };
  EXPECT_EQ(mse("oiio-runs.hdr", "oiio-parts.exr"), 0.0);
  EXPECT_LT(mse("magick.pfm", "oiio-runs.hdr"), 1e-10);
  EXPECT_LT(mse("oiio-linear-16.png", "magick.pfm"), 1e-10);
  EXPECT_EQ(mse("oiio-srgb-8.png", "magick-interlaced.png"), 0.0);

  const auto json = compare({given("oiio-srgb-8.png"), given("oiio-parts.exr")});
  EXPECT_NE(json.at("test_notes").at(0).get<std::string>().find("display-referred"),
            std::string::npos);
  EXPECT_EQ(json.at("reference_notes").at(0), "of its layers 'beauty' is taken");
  const Result told = run({"compare", given("oiio-srgb-8.png"), given("oiio-parts.exr")});
  EXPECT_NE(told.error.find("oiio-srgb-8.png: it is display-referred"), std::string::npos);
}

TEST_F(PicturesOfOthers, CroppedPicturesCompareWhereBothHavePixels) {
  const auto json = compare({given("oiio-cropped.exr"), given("oiio-runs.hdr")});
  EXPECT_EQ(json.at("metrics").at("mse"), 0.0);
  EXPECT_EQ(json.at("width"), 9);
  EXPECT_EQ(json.at("left_out").at("pixels"), 33);
  EXPECT_EQ(json.at("left_out").at("not_covered"), 33);
  EXPECT_DOUBLE_EQ(json.at("test_mean").at(1).get<double>(), 3.0 / 8.0);
  EXPECT_EQ(run({"compare", given("oiio-runs.hdr"), given("oiio-cropped.exr"), "--strict"}).code,
            1);
  // Of a reference of ours the noise is that of these pixels.
  ASSERT_EQ(
      run({"reference", "cornell-box", "--size", "9x5", "--spp", "8", "-o", path("ref.exr")}).code,
      0);
  const Reference ours = reference_of(*sums_of(read_exr(path("ref.exr")), "ref.exr"));
  double noise = 0.0;
  for (int y = 1; y < 4; ++y) {
    for (int x = 2; x < 6; ++x) {
      const glm::dvec3 off = 0.5f * (ours.halves[0].at(x, y) - ours.halves[1].at(x, y));
      noise += glm::dot(off, off) / 36.0;
    }
  }
  const auto known = compare({given("oiio-cropped.exr"), path("ref.exr")});
  EXPECT_NEAR(known.at("noise_floor").at("mse").get<double>(), noise, 1e-5 * noise);
}

TEST_F(PicturesOfOthers, TheNoiseOfAReferenceIsThatOfThePixelsThatAreCompared) {
  ASSERT_EQ(
      run({"reference", "cornell-box", "--size", "9x5", "--spp", "8", "-o", path("ref.exr")}).code,
      0);
  const Reference ours = reference_of(*sums_of(read_exr(path("ref.exr")), "ref.exr"));
  RadianceImage test = ours.image;
  test.at(4, 2).b = std::numeric_limits<float>::quiet_NaN();
  write("test.exr", test);
  double noise = 0.0;
  for (std::size_t i = 0; i < test.size(); ++i) {
    const glm::dvec3 off = 0.5f * (ours.halves[0].pixels()[i] - ours.halves[1].pixels()[i]);
    noise += i == 2 * 9 + 4 ? 0.0 : glm::dot(off, off) / (3.0 * 44.0);
  }
  const auto json = compare({path("test.exr"), path("ref.exr")});
  EXPECT_NEAR(json.at("noise_floor").at("mse").get<double>(), noise, 1e-5 * noise);
}

TEST_F(PicturesOfOthers, LayersAreChosenForEachPicture) {
  const std::string layers = given("oiio-layers.exr");
  const auto json = compare(
      {layers, layers, "--layer", "ViewLayer.DiffCol", "--reference-layer", "ViewLayer.Combined"});
  EXPECT_DOUBLE_EQ(json.at("test_mean").at(0).get<double>(),
                   2.0 * json.at("reference_mean").at(0).get<double>());
  const Result open = run({"compare", given("oiio-runs.hdr"), layers});
  EXPECT_EQ(open.code, 1);
  EXPECT_NE(open.error.find("choose with --reference-layer: ViewLayer.Combined (R G B), "
                            "ViewLayer.DiffCol (R G B)"),
            std::string::npos)
      << open.error;
}

TEST_F(PicturesOfOthers, AReferenceOfAnotherProgramHasEveryPixel) {
  const auto render = [&](const std::string& reference, std::vector<std::string> more) {
    std::vector<std::string> words{"render", "cornell-box", "--size",  "9x5", "--spp",
                                   "2",      "--reference", reference, "-o",  path("a.exr")};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Result hdr = render(given("oiio-runs.hdr"), {});
  EXPECT_EQ(hdr.code, 0) << hdr.error;
  EXPECT_NE(read_exr(path("a.exr")).find("SquaredError"), nullptr);
  const Result png = render(given("oiio-srgb-8.png"), {});
  EXPECT_EQ(png.code, 0) << png.error;
  EXPECT_NE(png.error.find("oiio-srgb-8.png: it is display-referred"), std::string::npos);
  EXPECT_EQ(render(given("oiio-layers.exr"), {"--reference-layer", "Combined"}).code, 0);
  const Result layers = render(given("oiio-layers.exr"), {});
  EXPECT_EQ(layers.code, 1);
  EXPECT_NE(layers.error.find("--reference-layer"), std::string::npos) << layers.error;
  const Result cropped = render(given("oiio-cropped.exr"), {});
  EXPECT_EQ(cropped.code, 1);
  EXPECT_NE(cropped.error.find("33 of its 9x5 pixels"), std::string::npos) << cropped.error;
  RadianceImage bad(9, 5, glm::vec3(0.5f));
  bad.at(4, 2).r = bad.at(5, 2).r = std::numeric_limits<float>::infinity();
  write("bad.exr", bad);
  const Result infinite = render(path("bad.exr"), {});
  EXPECT_EQ(infinite.code, 1);
  EXPECT_NE(infinite.error.find("(4, 2)"), std::string::npos) << infinite.error;
  EXPECT_NE(infinite.error.find("so are 2 pixels in all"), std::string::npos) << infinite.error;
  expect_usage_error({"render", "cornell-box", "--reference-layer", "a", "-o", path("b.exr")},
                     "--reference");
}

/// What a program prints; nothing if there is no such program.
std::optional<std::string> printed_by(const std::string& command) {
  std::FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    text += char(c);
  }
  return ::pclose(pipe) == 0 ? std::optional(text) : std::nullopt;
}

TEST_F(PicturesOfOthers, OpenImageIoReadsTheCountsOfOurs) {
  if (!printed_by("oiiotool --help")) {
    GTEST_SKIP() << "no oiiotool, of Debian's openimageio-tools";
  }
  ASSERT_EQ(run({"render", "cornell-box", "--size", "8x6", "--spp", "3", "--estimator", "kl", "-o",
                 path("a.exr")})
                .code,
            0);
  ASSERT_EQ(
      run({"reference", "cornell-box", "--size", "8x6", "--spp", "5", "-o", path("ref.exr")}).code,
      0);
  for (const auto& [name, spp] : {std::pair{"a.exr", 0.0f}, {"ref.exr", 5.0f}}) {
    const ExrImage ours = read_exr(path(name));
    const auto& counts = std::get<std::vector<float>>(ours.find("SampleCount")->pixels);
    EXPECT_TRUE(spp == 0.0f || std::ranges::count(counts, spp) == 48);
    const auto text =
        printed_by(fmt::format("oiiotool {} --ch SampleCount -o {} && oiiotool --dumpdata {}",
                               path(name), path("counts.exr"), path("counts.exr")));
    ASSERT_TRUE(text);
    std::size_t at = 0;
    ASSERT_EQ(std::ranges::count(*text, ')'), 48) << *text;
    for (const float count : counts) {
      at = text->find("): ", at) + 3;
      ASSERT_EQ(std::stof(text->substr(at)), count) << *text;
    }
  }
}

}  // namespace
}  // namespace quartet
