#include "renderer/files/exr_header.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "renderer/base/cancel.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

template <class T>
std::string bytes_of_word(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

std::string word(int value) {
  return bytes_of_word(std::int32_t(value));
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + word(int(value.size())) + value;
}

/// The attributes of a header, without its end: one channel of floats.
std::string header(int width, int height, int compression, const std::string& more = "") {
  using namespace std::string_literals;
  const std::string window = word(0) + word(0) + word(width - 1) + word(height - 1);
  return attribute("channels", "chlist", "Y\0"s + word(2) + word(0) + word(1) + word(1) + '\0') +
         attribute("compression", "compression", std::string(1, char(compression))) +
         attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
         attribute("lineOrder", "lineOrder", "\0"s) +
         attribute("pixelAspectRatio", "float", bytes_of_word(1.0f)) +
         attribute("screenWindowCenter", "v2f", word(0) + word(0)) +
         attribute("screenWindowWidth", "float", bytes_of_word(1.0f)) + more;
}

constexpr int plain = 2;
constexpr int tiled = 0x202;
constexpr int multi_part = 0x1002;

std::string file_of(int version, const std::string& headers, std::size_t body) {
  return word(20000630) + word(version) + headers + std::string(body, '\0');
}

/// What reading the file throws; no more than the file's bytes may have been asked for by then.
std::string error_of_file(const std::string& bytes) {
  const TempFolder folder;
  write_bytes_to(folder / "a.exr", bytes);
  return error_of([&] { read_exr(folder / "a.exr"); });
}

void expect_refused(const std::string& bytes, const std::string& reason) {
  const std::string error = error_of_file(bytes);
  EXPECT_TRUE(error.starts_with("cannot read ")) << error;
  EXPECT_NE(error.find(reason), std::string::npos) << error;
}

std::string tiles(std::uint32_t width, std::uint32_t height) {
  return attribute("tiles", "tiledesc",
                   bytes_of_word(width) + bytes_of_word(height) + std::string(1, '\0'));
}

TEST(ExrHeader, AttributesMayNotClaimMoreThanFollows) {
  using namespace std::string_literals;
  const std::string big = std::string("comment") + '\0' + "string" + '\0' + word(0x7fffffff);
  expect_refused(file_of(plain, header(4, 4, 3, big), 16),
                 "attribute 'comment' in its header claims 2147483647 bytes, and 16 follow");
  const std::string negative = std::string("comment") + '\0' + "opaque" + '\0' + word(-5);
  expect_refused(file_of(plain, header(4, 4, 3, negative), 16), "claims -5 bytes");
  // OpenEXR would read 4 bytes and take what follows for more of the header.
  const std::string hidden = attribute("zoom", "float", std::string(40, '\0'));
  expect_refused(file_of(plain, header(4, 4, 3, hidden), 16),
                 "'zoom' in its header has 40 bytes; 4 would be right for a float");
  const std::string texts = attribute("views", "stringvector", word(3) + "abc" + word(1 << 30));
  expect_refused(file_of(plain, header(4, 4, 3, texts), 16), "holds a text of 1073741824 bytes");
  const std::string channels = attribute("channels", "chlist", std::string("Y\0", 2) + word(2));
  expect_refused(file_of(plain, header(4, 4, 3, channels), 16), "does not end where it should");
  // Without its last byte OpenEXR would take the next one for the end of the list, and this walk
  // for the end of the header.
  const std::string unended =
      attribute("channels", "chlist", "Y\0"s + word(2) + word(0) + word(1) + word(1));
  expect_refused(file_of(plain, header(4, 4, 3, unended + '\0' + big), 16),
                 "does not end where it should");
  const std::string others = attribute("others", "chlist", "Y\0"s + word(2));
  expect_refused(file_of(plain, header(4, 4, 3, others + big), 16), "does not end where it should");
  const std::string deep = attribute("type", "string", "deepscanline");
  expect_refused(file_of(plain, header(4, 4, 3, deep) + '\0', 16), "its pixels are deep");
  expect_refused(file_of(plain, header(4, 4, 3, std::string(300, 'n')), 16), "more than 255 bytes");
  expect_refused(file_of(plain, header(4, 4, 3), 0), "it ends too early");
}

TEST(ExrHeader, PixelsMustFitTheFileHoweverTheyAreCompressed) {
  const char end = '\0';
  expect_refused(file_of(plain, header(16000, 16000, 3) + end, 50'000), "which do not fit the");
  expect_refused(file_of(plain, header(100, 100, 0) + end, 20'000), "which do not fit the");
  expect_refused(file_of(plain, header(65536, 65536, 3) + end, 50'000),
                 "65536x65536 at (0, 0) pixels with 1 channels would take 16384 MB");
  expect_refused(file_of(multi_part, header(16000, 16000, 4) + end + end, 50'000),
                 "which do not fit the");
}

TEST(ExrHeader, TilesAndTablesMustFit) {
  const char end = '\0';
  expect_refused(file_of(tiled, header(2000, 2000, 8, tiles(1, 1)) + end, 1000),
                 "claims 4000000 blocks or tiles");
  expect_refused(file_of(tiled, header(64, 64, 3, tiles(60'000, 60'000)) + end, 1000),
                 "tiles of 60000x60000 pixels are too large");
  expect_refused(file_of(tiled, header(64, 64, 3, tiles(4'000'000'000u, 2)) + end, 1000),
                 "are too large");
  // Many parts, each with a table of its own.
  std::string parts;
  for (int i = 0; i < 20; ++i) {
    parts += header(60'000, 60'000, 8, tiles(64, 64)) + end;
  }
  expect_refused(file_of(multi_part, header(8, 8, 3) + end + parts + end, 1000),
                 "claims 17596881 blocks or tiles");
  const std::string count = attribute("chunkCount", "int", word(0x7fffffff));
  expect_refused(file_of(multi_part, header(8, 8, 3, count) + end + end, 1000),
                 "claims 2147483647 blocks or tiles");
}

TEST(ExrHeader, WhatCannotBeReadAgainIsNotWritten) {
  const TempFolder folder;
  ExrImage wide(max_exr_side + 1, 1);
  wide.add("Y", std::vector<float>(std::size_t(max_exr_side) + 1));
  const std::string error = error_of([&] { write_exr(folder / "a.exr", wide); });
  EXPECT_TRUE(error.starts_with("cannot write ")) << error;
  EXPECT_NE(error.find("an EXR of 65537x1 pixels with 1 channels could not be read again; sides of "
                       "at most 65536"),
            std::string::npos)
      << error;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
  EXPECT_EQ(error_of([] { check_exr_size(16384, 16384, 1); }), "");
  EXPECT_NE(error_of([] { check_exr_size(16384, 16384, 2); }), "");

  ExrImage widest(max_exr_side, 1);
  widest.add("Y", std::vector<float>(std::size_t(max_exr_side), 0.5f));
  write_exr(folder / "b.exr", widest);
  EXPECT_EQ(read_exr(folder / "b.exr").width(), max_exr_side);
}

TEST(ExrReader, ReadsAllChannelsOfAllBands) {
  const TempFolder folder;
  constexpr int width = 8192;  // several bands, and a last one that is not whole
  constexpr int height = 300;
  ExrImage image(width, height);
  image.data.y = image.display.y = -7;
  std::vector<float> rows;
  std::vector<std::uint32_t> columns;
  for (int y = 0; y < height; ++y) {
    rows.insert(rows.end(), width, float(y));
    for (int x = 0; x < width; ++x) {
      columns.push_back(std::uint32_t(x));
    }
  }
  image.add("Rows", rows);
  image.add("Columns", columns);
  write_exr(folder / "a.exr", image);
  const ExrImage read = read_exr(folder / "a.exr");
  EXPECT_TRUE(std::get<std::vector<float>>(read.find("Rows")->pixels) == rows);
  EXPECT_TRUE(std::get<std::vector<std::uint32_t>>(read.find("Columns")->pixels) == columns);
}

TEST(ExrReader, EndsWhenAskedAndWaitsForNoPipe) {
  const TempFolder folder;
  ExrImage image(4, 4);
  image.add("Y", std::vector<float>(16));
  write_exr(folder / "a.exr", image);
  std::stop_source stop;
  EXPECT_EQ(read_exr(folder / "a.exr", stop.get_token()).width(), 4);
  stop.request_stop();
  EXPECT_THROW(read_exr(folder / "a.exr", stop.get_token()), Cancelled);

  ASSERT_EQ(mkfifo((folder / "b.exr").c_str(), 0600), 0);
  EXPECT_NE(error_of([&] { read_exr(folder / "b.exr"); }).find("it is a pipe"), std::string::npos);
  EXPECT_NE(error_of([&] { read_exr(folder.path()); }).find("it is a folder"), std::string::npos);
}

}  // namespace
}  // namespace quartet
