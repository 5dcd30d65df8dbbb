#include "renderer/files/exr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

std::vector<float> noise(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> values(size);
  for (float& value : values) {
    value = std::exp(std::normal_distribution<float>(0.0f, 5.0f)(random));
  }
  return values;
}

const std::vector<float>& floats(const ExrImage& image, std::string_view name) {
  return std::get<std::vector<float>>(image.find(name)->pixels);
}

TEST(Exr, FloatsCountsAndTextSurviveARoundTrip) {
  const TempFolder folder;
  ExrImage image(33, 21);
  const std::size_t size = 33UL * 21;
  // Not in alphabetical order, which is the file's.
  for (const char* name : {"Variance.R", "R", "Error.kl", "B", "G"}) {
    image.add(name, noise(size, unsigned(name[0])));
  }
  std::get<std::vector<float>>(image.channels[0].pixels)[5] =
      std::numeric_limits<float>::infinity();
  std::vector<std::uint32_t> counts(size, 71);
  counts[3] = (1u << 24) + 1;  // what no float holds
  counts[4] = std::numeric_limits<std::uint32_t>::max();
  image.add("SampleCount", counts);
  image.attributes = {{"scene", "scenes/cornell-checker.xml"}, {"commandLine", "σ ≤ 1\ntwo lines"}};

  write_exr(folder / "a.exr", image);
  const ExrImage read = read_exr(folder / "a.exr");
  EXPECT_EQ(read.data, image.data);
  EXPECT_EQ(read.display, image.display);
  EXPECT_EQ(read.attributes, image.attributes);
  ASSERT_EQ(read.channels.size(), image.channels.size());
  for (const ExrChannel& channel : image.channels) {
    ASSERT_NE(read.find(channel.name), nullptr) << channel.name;
    EXPECT_EQ(read.find(channel.name)->pixels, channel.pixels) << channel.name;
    EXPECT_FALSE(read.find(channel.name)->half);
  }
  EXPECT_EQ(read.find("Variance.G"), nullptr);
}

TEST(Exr, HalfsAreReadAsFloats) {
  const TempFolder folder;
  ExrImage image(4, 1);
  image.add("Y", std::vector<float>{0.5f, -2.0f, 65504.0f, 0.1f});
  image.channels[0].half = true;
  write_exr(folder / "a.exr", image);
  const ExrImage read = read_exr(folder / "a.exr");
  EXPECT_TRUE(read.find("Y")->half);
  // 0.1 rounded to 11 significant bits.
  EXPECT_EQ(floats(read, "Y"), (std::vector<float>{0.5f, -2.0f, 65504.0f, 0.0999755859375f}));
}

TEST(Exr, ChannelsThatAreNotAskedForAreNotRead) {
  const TempFolder folder;
  ExrImage image(4, 2);
  for (const char* name : {"A", "Depth.Z", "R"}) {
    image.add(name, noise(8, unsigned(name[0])));
  }
  image.attributes["scene"] = "a";
  write_exr(folder / "a.exr", image);
  const std::vector<ExrPartHeader> headers = read_exr_headers(folder / "a.exr");
  ASSERT_EQ(headers.size(), 1u);
  EXPECT_EQ(headers[0].name, "");
  EXPECT_EQ(headers[0].channels, (std::vector<std::string>{"A", "Depth.Z", "R"}));
  EXPECT_EQ(headers[0].attributes, image.attributes);
  const ExrImage read = read_exr_channels(folder / "a.exr", 0, {"Depth.Z"});
  ASSERT_EQ(read.channels.size(), 1u);
  EXPECT_EQ(floats(read, "Depth.Z"), floats(image, "Depth.Z"));
  EXPECT_TRUE(read.rec709);
  EXPECT_NE(error_of([&] { read_exr_channels(folder / "a.exr", 0, {"B"}); }).find("a.exr"),
            std::string::npos);
}

TEST(Exr, RadianceIsRgbInThisOrder) {
  const TempFolder folder;
  RadianceImage radiance(3, 2);
  for (int i = 0; i < 6; ++i) {
    radiance.pixels()[std::size_t(i)] = glm::vec3(i, 10 + i, 20 + i);
  }
  ExrImage image(3, 2);
  image.add_radiance(radiance);
  write_exr(folder / "a.exr", image);
  EXPECT_EQ(radiance_of(read_exr(folder / "a.exr"), "a.exr"), radiance);
}

TEST(Exr, RadianceNeedsItsChannels) {
  ExrImage image(1, 1);
  image.add("R", std::vector<float>{1.0f});
  image.add("B", std::vector<float>{1.0f});
  EXPECT_EQ(error_of([&] { radiance_of(image, "dir/a.exr"); }),
            "dir/a.exr: no channel G of float or half; R, G and B are needed, there are: R, B");
}

TEST(Exr, ACroppedImageKeepsItsPlaceAndIsRefusedAsRadiance) {
  const TempFolder folder;
  ExrImage image(3, 2);
  image.add_radiance(RadianceImage(3, 2, glm::vec3(0.25f, 0.5f, 1.0f)));
  std::get<std::vector<float>>(image.channels[0].pixels) = {1, 2, 3, 4, 5, 6};
  image.data = {-5, 7, 3, 2};
  image.display = {0, 0, 100, 50};
  write_exr(folder / "a.exr", image);
  const ExrImage read = read_exr(folder / "a.exr");
  EXPECT_EQ(read.data, image.data);
  EXPECT_EQ(read.display, image.display);
  EXPECT_EQ(floats(read, "R"), (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(error_of([&] { radiance_of(read, "a.exr"); }),
            "a.exr: its pixels cover 3x2 at (-5, 7) but the picture is 100x50 at (0, 0); an EXR "
            "with pixels for the whole picture would be right");
}

TEST(Exr, PixelsBeyondThePictureAreLeftOutOfItsRadiance) {
  ExrImage image(5, 3);
  image.display = {0, 0, 2, 1};
  image.data = {-2, -1, 5, 3};
  for (const auto& [name, first] : {std::pair{"B", 200.0f}, {"G", 100.0f}, {"R", 0.0f}}) {
    std::vector<float> pixels(15);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] = first + float(i);
    }
    image.add(name, std::move(pixels));
  }
  const RadianceImage radiance = radiance_of(image, "a.exr");
  ASSERT_EQ(radiance.width(), 2);
  ASSERT_EQ(radiance.height(), 1);
  EXPECT_EQ(radiance.at(0, 0), glm::vec3(7.0f, 107.0f, 207.0f));
  EXPECT_EQ(radiance.at(1, 0), glm::vec3(8.0f, 108.0f, 208.0f));
  // One column short on the right.
  image.display = {0, 0, 4, 1};
  EXPECT_NE(error_of([&] { radiance_of(image, "a.exr"); }).find("5x3 at (-2, -1)"),
            std::string::npos);
}

TEST(Exr, SubsampledChannelsAreRefused) {
  const TempFolder folder;
  ExrImage image(4, 4);
  image.add_radiance(RadianceImage(4, 4));
  write_exr(folder / "a.exr", image);
  std::string bytes = bytes_of(folder / "a.exr");
  // The channel list: name, pixel type 2 (float), 4 bytes, then x and y sampling.
  const std::string channel("B\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 18);
  const std::size_t at = bytes.find(channel);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 10] = 2;
  bytes[at + 14] = 2;
  write_bytes_to(folder / "b.exr", bytes);
  EXPECT_NE(error_of([&] { read_exr(folder / "b.exr"); }).find("channel B is subsampled"),
            std::string::npos);
}

/// A small file whose header claims this width.
std::string error_with_width(std::uint32_t width, int height) {
  const TempFolder folder;
  ExrImage image(4, height);
  image.add_radiance(RadianceImage(4, height));
  write_exr(folder / "a.exr", image);
  std::string bytes = bytes_of(folder / "a.exr");
  // The attribute: name, type, size 16, then min x, min y, max x, max y.
  const std::string window("dataWindow\0box2i\0\20\0\0\0", 21);
  const std::size_t at = bytes.find(window);
  EXPECT_NE(at, std::string::npos);
  for (std::size_t i = 0; i < 4; ++i) {
    bytes.at(at + window.size() + 8 + i) = char((width - 1) >> (8 * i));
  }
  write_bytes_to(folder / "a.exr", bytes);
  return error_of([&] { read_exr(folder / "a.exr"); });
}

TEST(Exr, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
  const std::string wide = error_with_width(1u << 27, 4);
  EXPECT_NE(wide.find("a.exr"), std::string::npos) << wide;
  EXPECT_NE(wide.find("maximum width of 65536"), std::string::npos) << wide;
  const std::string large = error_with_width(65535, 4000);
  EXPECT_NE(large.find("65535x4000 at (0, 0) pixels with 3 channels would take 2999 MB"),
            std::string::npos)
      << large;
}

TEST(Exr, DamagedFilesAreOneLineWithThePath) {
  const TempFolder folder;
  EXPECT_EQ(error_of([&] { read_exr(folder / "none.exr"); }),
            "cannot read " + (folder / "none.exr").string() + ": no such file");

  write_bytes_to(folder / "text.exr", "this is no picture, and long enough for a header");
  ExrImage image(64, 64);
  image.add("Y", noise(64UL * 64, 1));
  write_exr(folder / "cut.exr", image);
  std::filesystem::resize_file(folder / "cut.exr", 5000);
  for (const char* name : {"text.exr", "cut.exr"}) {
    const std::string error = error_of([&] { read_exr(folder / name); });
    EXPECT_TRUE(error.starts_with("cannot read " + (folder / name).string() + " as EXR: "))
        << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Exr, AFullDiskIsAnErrorForSmallAndLargeImages) {
  for (const int size : {2, 500}) {
    ExrImage image(size, size);
    image.add("Y", noise(std::size_t(size) * std::size_t(size), 1));
    EXPECT_EQ(error_of([&] { write_exr("/dev/full", image); }),
              "cannot write /dev/full: No space left on device");
  }
}

TEST(Exr, WritesTheSameBytesTwice) {
  const TempFolder folder;
  ExrImage image(50, 50);
  image.add("Y", noise(2500, 1));
  image.attributes["scene"] = "a";
  write_exr(folder / "a.exr", image);
  write_exr(folder / "b.exr", image);
  EXPECT_EQ(bytes_of(folder / "a.exr"), bytes_of(folder / "b.exr"));
}

}  // namespace
}  // namespace quartet
