#include "renderer/files/picture.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "renderer/files/png.h"
#include "renderer/files/srgb.h"
#include "tests/files/temp_folder.h"

namespace quartet {
namespace {

// tests/data/pictures/ holds one picture, written by oiiotool 2.4 and ImageMagick 6.9 in the
// formats that their names say.
const std::filesystem::path written_elsewhere =
    std::filesystem::path(QUARTET_TEST_DATA) / "pictures";

glm::dvec3 number_at(int x, int y) {
  return {double(x + 1) / 16.0, double(y + 1) / 8.0, double(x * y) / 64.0};
}

using PixelNumbers = std::function<glm::dvec3(int x, int y)>;

void expect_picture(const Picture& picture, const PixelNumbers& expected, double tolerance) {
  ASSERT_EQ(picture.width, 9);
  ASSERT_EQ(picture.height, 5);
  for (int y = 0; y < picture.image.height(); ++y) {
    for (int x = 0; x < picture.image.width(); ++x) {
      const glm::dvec3 right = expected(picture.left + x, picture.top + y);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(picture.image.at(x, y)[c], right[c], tolerance) << x << "," << y << " " << c;
      }
    }
  }
}

std::string notes_of(const Picture& picture) {
  std::string text;
  for (const std::string& note : picture.notes) {
    text += note + "\n";
  }
  return text;
}

/// What a channel of so many bits keeps, as linear light.
double decoded(double number, int bits) {
  const double most = double((1 << bits) - 1);
  return srgb_decode(std::round(number * most) / most);
}

glm::dvec3 decoded_at(int x, int y, int bits) {
  const glm::dvec3 c = number_at(x, y);
  return {decoded(c.r, bits), decoded(c.g, bits), decoded(c.b, bits)};
}

TEST(Picture, OfOtherProgramsAreRead) {
  const auto read = [](const char* name) { return read_picture(written_elsewhere / name); };
  // Three mantissas of 8 bits hold these numbers, which share a power of two.
  expect_picture(read("oiio-runs.hdr"), number_at, 0.0);
  EXPECT_EQ(notes_of(read("oiio-runs.hdr")), "");
  // Its author keeps 16 bits of each number.
  expect_picture(read("magick.pfm"), number_at, 1e-5);
  EXPECT_EQ(notes_of(read("magick.pfm")), "");

  const auto eight_bits = [](int x, int y) { return decoded_at(x, y, 8); };
  expect_picture(read("oiio-srgb-8.png"), eight_bits, 1e-7);
  EXPECT_NE(notes_of(read("oiio-srgb-8.png")).find("8 bits from black to white: decoded from sRGB"),
            std::string::npos);
  expect_picture(read("magick-interlaced.png"), eight_bits, 1e-7);  // and with a palette
  const auto half_covered = [](int x, int y) { return decoded_at(x, y, 8) * (128.0 / 255.0); };
  expect_picture(read("magick-alpha.png"), half_covered, 1e-7);
  EXPECT_NE(notes_of(read("magick-alpha.png")).find("multiplied by its alpha"), std::string::npos);
  const auto gray = [](int, int y) { return glm::dvec3(decoded(double(y + 1) / 8.0, 16)); };
  expect_picture(read("oiio-gray-16.png"), gray, 1e-7);
  const auto linear = [](int x, int y) { return glm::round(number_at(x, y) * 65535.0) / 65535.0; };
  expect_picture(read("oiio-linear-16.png"), linear, 1e-7);
  EXPECT_NE(notes_of(read("oiio-linear-16.png")).find("linear by its gamma"), std::string::npos);
}

TEST(Picture, ALuminanceMapIsGrayAndMayBeginWithTheHighByte) {
  const Picture gray = read_picture(written_elsewhere / "magick-gray.pfm");
  EXPECT_EQ(gray.width, 9);
  EXPECT_NE(notes_of(gray).find("luminance alone"), std::string::npos);
  float largest = 0.0f;
  for (const glm::vec3 c : gray.image.pixels()) {
    EXPECT_EQ(c.r, c.g);
    EXPECT_EQ(c.r, c.b);
    largest = std::max(largest, c.r);
  }
  EXPECT_GT(largest, 0.4f);
  EXPECT_LE(largest, 1.0f);
}

TEST(Picture, LayersPartsAndWindowsOfAnExr) {
  expect_picture(read_picture(written_elsewhere / "oiio-layers.exr", {"ViewLayer.Combined"}),
                 number_at, 0.0);
  expect_picture(
      read_picture(written_elsewhere / "oiio-layers.exr", {"DiffCol"}),
      [](int x, int y) { return 2.0 * number_at(x, y); }, 0.0);
  const std::string choice = error_of([] {
    read_picture(written_elsewhere / "oiio-layers.exr", {"", "--reference-layer"});
  });
  for (const char* part : {"oiio-layers.exr", "--reference-layer", "ViewLayer.Combined (R G B)",
                           "ViewLayer.DiffCol (R G B)"}) {
    EXPECT_NE(choice.find(part), std::string::npos) << choice;
  }
  const std::string none =
      error_of([] { read_picture(written_elsewhere / "oiio-layers.exr", {"Mist"}); });
  EXPECT_NE(none.find("'Mist' names none of its layers"), std::string::npos) << none;

  // The second part is the only one of colour.
  const Picture beauty = read_picture(written_elsewhere / "oiio-parts.exr");
  expect_picture(beauty, number_at, 0.0);
  EXPECT_EQ(beauty.layer, "beauty");
  EXPECT_EQ(notes_of(beauty), "of its layers 'beauty' is taken\n");
  const Picture depth = read_picture(written_elsewhere / "oiio-parts.exr", {"depth"});
  expect_picture(
      depth, [](int x, int y) { return glm::dvec3(number_at(x, y).b); }, 0.0);

  // Tiles of halfs.
  const Picture cropped = read_picture(written_elsewhere / "oiio-cropped.exr");
  expect_picture(cropped, number_at, 0.0);
  EXPECT_EQ(cropped.left, 2);
  EXPECT_EQ(cropped.top, 1);
  EXPECT_EQ(cropped.image.width(), 4);
  EXPECT_EQ(cropped.image.height(), 3);
  EXPECT_EQ(cropped.uncovered(), 45u - 12u);
  EXPECT_NE(notes_of(cropped).find("4x3 at (2, 1)"), std::string::npos);
}

/// The layer that an EXR of one pixel with these channels gives, or why it gives none. The n-th
/// channel holds n.
struct TakenLayer {
  std::string layer, error;
  glm::vec3 pixel{};
};

TakenLayer taken(const std::vector<std::string>& channels, const std::string& wanted = "") {
  const TempFolder folder;
  ExrImage exr(1, 1);
  for (const std::string& name : channels) {
    exr.add(name, std::vector<float>{float(exr.channels.size())});
  }
  write_exr(folder / "a.exr", exr);
  TakenLayer result;
  result.error = error_of([&] {
    const Picture picture = read_picture(folder / "a.exr", {wanted});
    result.layer = picture.layer;
    result.pixel = picture.image.at(0, 0);
  });
  return result;
}

TEST(Picture, TheLayerThatIsMeantIsTaken) {
  const auto expect = [](const TakenLayer& found, const std::string& layer, glm::vec3 pixel) {
    EXPECT_EQ(found.error, "");
    EXPECT_EQ(found.layer, layer);
    EXPECT_EQ(found.pixel, pixel) << layer;
  };
  expect(taken({".R", ".G", ".B"}), "", {0, 1, 2});
  expect(taken({"R", "G", "B", "A", "Variance.R", "Variance.G", "Variance.B"}), "", {0, 1, 2});
  expect(taken({"R", "G", "B", "Albedo.R", "Albedo.G", "Albedo.B"}, "Albedo"), "Albedo", {3, 4, 5});
  expect(taken({"rgba.red", "rgba.green", "rgba.blue", "N.X", "N.Y", "N.Z"}), "rgba", {0, 1, 2});
  expect(taken({"a.b.R", "a.b.G", "a.b.B", "a.Depth.Z"}), "a.b", {0, 1, 2});
  expect(taken({"Y"}), "", {0, 0, 0});
  expect(taken({"Z", "L.Y"}), "L", {1, 1, 1});

  const auto expect_error = [](const TakenLayer& found, const std::string& part) {
    EXPECT_NE(found.error.find(part), std::string::npos) << found.error;
  };
  expect_error(taken({"N.X", "N.Y", "N.Z"}), "nor with luminance Y alone; its layers: N (X Y Z)");
  expect_error(taken({"R", "G"}), "its layers: unnamed (R G)");
  expect_error(taken({"Y", "RY", "BY"}), "its layers: unnamed (");
  expect_error(taken({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}), "choose with --layer");
  expect_error(taken({"a.c.R", "a.c.G", "a.c.B", "b.c.R", "b.c.G", "b.c.B"}, "c"),
               "'c' names several");
  expect_error(taken({"R", "G", "B", "Depth.Z"}, "Depth"), "without R, G and B");
}

std::string error_of_bytes(const std::string& bytes) {
  const TempFolder folder;
  write_bytes_to(folder / "a.pic", bytes);
  return error_of([&] { read_picture(folder / "a.pic"); });
}

Picture picture_of_bytes(const std::string& bytes) {
  const TempFolder folder;
  write_bytes_to(folder / "a.pic", bytes);
  return read_picture(folder / "a.pic");
}

std::string floats_of_pfm(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) {
      bytes += char(bits >> (8 * i));
    }
  }
  return bytes;
}

TEST(Picture, PfmBeginsBelowAndKeepsNumbersThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Picture picture =
      picture_of_bytes("Pf\n#a comment\n1 3\n-2.5\n" + floats_of_pfm({1.0f, nan, 1e30f}) + "\n");
  EXPECT_EQ(picture.image.at(0, 0).x, 1e30f);
  EXPECT_TRUE(std::isnan(picture.image.at(0, 1).y));
  EXPECT_EQ(picture.image.at(0, 2).z, 1.0f);
  EXPECT_NE(notes_of(picture).find("scale 2.5 is not applied"), std::string::npos);
  EXPECT_NE(notes_of(picture).find("1 bytes behind its last pixel"), std::string::npos);
}

TEST(Picture, PfmWithLineEndsOfTwoBytes) {
  const Picture picture = picture_of_bytes("Pf\r\n1 2\r\n-1\r\n" + floats_of_pfm({1.0f, 2.0f}));
  EXPECT_EQ(picture.image.at(0, 0).x, 2.0f);
  EXPECT_EQ(picture.image.at(0, 1).x, 1.0f);
  EXPECT_EQ(notes_of(picture).find("behind its last pixel"), std::string::npos);
}

TEST(Picture, RadianceFilesOfEveryKind) {
  const auto gray = [](int value) { return std::string(3, char(value)) + char(128 + 8); };
  // Pixels one by one, a run of two in the old way, from the right below to the left above.
  const Picture flat =
      picture_of_bytes("#?RADIANCE\n# by hand\nEXPOSURE=4\nEXPOSURE= 0.5\n\n+Y 2 -X 3\n" + gray(2) +
                       std::string("\1\1\1\2", 4) + gray(4) + gray(6) + gray(8));
  EXPECT_EQ(flat.image.at(2, 1), glm::vec3(1.0f));
  EXPECT_EQ(flat.image.at(0, 1), glm::vec3(1.0f));
  EXPECT_EQ(flat.image.at(2, 0), glm::vec3(2.0f));
  EXPECT_EQ(flat.image.at(0, 0), glm::vec3(4.0f));
  EXPECT_NE(notes_of(flat).find("exposure and colour correction"), std::string::npos);
  // Columns first.
  const Picture turned =
      picture_of_bytes("#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n+X 2 -Y 1\n" + gray(3) + gray(5));
  EXPECT_EQ(turned.width, 2);
  EXPECT_EQ(turned.image.at(1, 0), glm::vec3(5.0f));
  // An exponent of 0 is black, whatever the mantissas.
  EXPECT_EQ(picture_of_bytes("#?RGBE\n\n-Y 1 +X 1\n" + std::string("\7\7\7\0", 4)).image.at(0, 0),
            glm::vec3(0.0f));
}

TEST(Picture, WhatIsDamagedIsOneLineWithThePath) {
  const std::string png = bytes_of(written_elsewhere / "oiio-srgb-8.png");
  const std::string hdr = bytes_of(written_elsewhere / "oiio-runs.hdr");
  const std::string parts = bytes_of(written_elsewhere / "oiio-parts.exr");
  std::string flipped = png;
  flipped[flipped.size() - 30] = char(flipped[flipped.size() - 30] ^ 1);
  const std::string head = "#?RADIANCE\n\n";
  for (const auto& [bytes, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "EXR, PNG, PFM or Radiance HDR would be right"},
           {"GIF89a", "EXR, PNG, PFM or Radiance HDR would be right"},
           {"PF\n2 2\n-1\n1234", "do not fit the 4 bytes that follow"},
           {"PF\n60000 60000\n-1\n1234", "at most 89 million pixels"},
           {"PF\n0 2\n-1\n", "sides of 1 to 65536"},
           {"PF\n-3 2\n-1\n", "'-3' in its header is no width"},
           {"PF\n99999999999 2\n-1\n", "is no width"},
           {"PF\n1 1\nnan\n1234", "its scale is nan"},
           {"PF\n1 1\n0\n1234", "its scale is 0"},
           {"PF4\n1 1\n-1\n1234", "'PF4'"},
           {"PF" + std::string(100, 'x'), "more than 64 bytes"},
           {"PF\n3", "ends too early"},
           {head + "-Y 1 +X", "ends too early"},
           {head + "-Y 1 +Y 1\n", "-Y HEIGHT +X WIDTH"},
           {head + "1 1\n", "-Y HEIGHT +X WIDTH"},
           {head + "-Y 60000 +X 60000\n1234", "at most 89 million pixels"},
           {head + "-Y 60000 +X 1000\n1234", "do not fit the 4 bytes"},
           {head + "-Y 1 +X 2\n" + std::string("\1\1\1\1", 4) + "1234", "a run of 1 pixels"},
           {head + "-Y 1 +X 9\n" + std::string("\2\2\0\x8", 4) + "1234", "claims 8 pixels; 9"},
           {head + "-Y 1 +X 9\n" + std::string("\2\2\0\x9\xff", 5) + "1234", "a run of 127 bytes"},
           {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234", "32-bit_rle_rgbe would be"},
           {"#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n1234", "above 0"},
           {"#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\n1234", "is not 3 numbers"},
           {"#?" + std::string(5000, 'x'), "more than 4096 bytes"},
           {hdr.substr(0, hdr.size() - 5), "ends too early"},
           {png.substr(0, 200), "ends too early"},
           {png.substr(0, 20), "ends too early"},
           {flipped, "as PNG"},
           {parts.substr(0, parts.size() / 2), "as EXR"},
       }) {
    const std::string error = error_of_bytes(bytes);
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_NE(error.find("a.pic"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  EXPECT_NE(error_of([] { read_picture("none.pfm"); }).find("none.pfm"), std::string::npos);
  EXPECT_NE(error_of([] {
              read_picture(written_elsewhere / "magick.pfm", {"Combined"});
            }).find("is a PFM, which has no layers"),
            std::string::npos);
}

TEST(Picture, APngThatClaimsMoreThanItCouldHoldTakesNoMemory) {
  // 60000 x 1400 pixels of 16 bits in the header, with the right checksum for them.
  std::string bytes = bytes_of(written_elsewhere / "oiio-linear-16.png");
  const std::string header("IHDR\0\0\xea\x60\0\0\x05\x78\x10\2\0\0\0", 17);
  std::uint32_t crc = 0xffffffffu;
  for (const char c : header) {
    crc ^= std::uint8_t(c);
    for (int bit = 0; bit < 8; ++bit) {
      crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
  }
  crc = ~crc;
  bytes.replace(12, header.size(), header);
  for (int i = 0; i < 4; ++i) {
    bytes[12 + header.size() + std::size_t(i)] = char(crc >> (24 - 8 * i));
  }
  const std::string error = error_of_bytes(bytes);
  EXPECT_NE(error.find("60000x1400 pixels, which do not fit"), std::string::npos) << error;
}

TEST(Picture, AChunkOfAPngThatClaimsMoreThanTheFileTakesNoMemory) {
  std::string bytes = bytes_of(written_elsewhere / "oiio-linear-16.png");
  const std::size_t text = bytes.find("tEXt");
  ASSERT_NE(text, std::string::npos);
  bytes[text - 4] = 0x50;  // 1.3 GB
  EXPECT_NE(error_of_bytes(bytes).find("claims 134217"), std::string::npos)
      << error_of_bytes(bytes);
}

TEST(Picture, IsToldByItsNameOrItsContent) {
  const TempFolder folder;
  write_bytes_to(folder / "a.EXR", "no picture");
  write_bytes_to(folder / "b.xml", "<scene version=\"3.0.0\"/>");
  write_png(folder / "c", DisplayImage(1, 1));
  EXPECT_TRUE(is_picture(folder / "a.EXR")) << "which read_picture then says is none";
  EXPECT_FALSE(is_picture(folder / "b.xml"));
  EXPECT_TRUE(is_picture(folder / "c"));
  EXPECT_FALSE(is_picture(folder / "none"));
  EXPECT_FALSE(is_picture(folder.path()));
}

}  // namespace
}  // namespace quartet
