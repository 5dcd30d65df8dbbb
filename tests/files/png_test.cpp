#include "renderer/files/png.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

DisplayImage noise(int width, int height, bool opaque) {
  std::mt19937 random(7);
  DisplayImage image(width, height);
  for (Rgba8& pixel : image.pixels()) {
    const auto byte = [&] { return std::uint8_t(random()); };
    pixel = {byte(), byte(), byte(), opaque ? std::uint8_t(255) : byte()};
  }
  return image;
}

TEST(Png, OpaqueAndTransparentImagesSurviveARoundTrip) {
  const TempFolder folder;
  for (const bool opaque : {true, false}) {
    const DisplayImage image = noise(37, 19, opaque);
    write_png(folder / "a.png", image);
    EXPECT_EQ(read_png(folder / "a.png"), image);
    // The colour type in the header chunk: 2 is RGB, 6 is RGBA (PNG specification, 11.2.2).
    EXPECT_EQ(bytes_of(folder / "a.png").at(25), opaque ? 2 : 6);
  }
}

TEST(Png, SaysThatItIsSrgbAndWritesTheSameBytesTwice) {
  const TempFolder folder;
  write_png(folder / "a.png", noise(64, 64, true));
  write_png(folder / "b.png", noise(64, 64, true));
  const std::string bytes = bytes_of(folder / "a.png");
  EXPECT_EQ(bytes, bytes_of(folder / "b.png"));
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
}

TEST(Png, AFullDiskIsAnErrorForSmallAndLargeImages) {
  for (const int size : {4, 600}) {
    EXPECT_EQ(error_of([&] { write_png("/dev/full", noise(size, size, true)); }),
              "cannot write /dev/full: No space left on device");
  }
}

TEST(Png, NamesThePathOfWhatCannotBeWrittenOrRead) {
  const TempFolder folder;
  const std::string missing = (folder / "missing/a.png").string();
  EXPECT_EQ(error_of([&] { write_png(missing, noise(2, 2, true)); }),
            "cannot write " + missing + ": No such file or directory");
  EXPECT_NE(error_of([&] { read_png(missing); }).find(missing), std::string::npos);
  EXPECT_NE(error_of([&] { write_png(folder / "a.png", DisplayImage()); }).find("no pixels"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));

  write_bytes_to(folder / "text.png", "this is no picture");
  EXPECT_NE(error_of([&] { read_png(folder / "text.png"); }).find("text.png"), std::string::npos);
  write_png(folder / "cut.png", noise(64, 64, true));
  std::filesystem::resize_file(folder / "cut.png", 2000);
  EXPECT_NE(error_of([&] { read_png(folder / "cut.png"); }).find("cut.png"), std::string::npos);
}

}  // namespace
}  // namespace quartet
