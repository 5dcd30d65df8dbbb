// A reduced picture against averages taken point by point.

#include "renderer/view/reduce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace quartet {
namespace {

DisplayImage noise(int width, int height) {
  std::mt19937 random(1);
  DisplayImage image(width, height);
  for (Rgba8& pixel : image.pixels()) {
    const auto byte = [&] { return std::uint8_t(random() >> 24); };
    pixel = {byte(), byte(), byte(), byte()};
  }
  return image;
}

glm::dvec4 values(const Rgba8& pixel) {
  return {pixel.r, pixel.g, pixel.b, pixel.a};
}

/// With each pixel cut into parts so small that no edge of a reduced pixel cuts one.
glm::dvec4 average(const DisplayImage& image, int width, int height, int x, int y) {
  glm::dvec4 sum(0.0);
  for (int v = y * image.height(); v < (y + 1) * image.height(); ++v) {
    for (int u = x * image.width(); u < (x + 1) * image.width(); ++u) {
      sum += values(image.at(u / width, v / height));
    }
  }
  return sum / (double(image.width()) * double(image.height()));
}

TEST(Reduce, EachPixelIsTheAverageOfWhatItCovers) {
  const DisplayImage image = noise(23, 17);
  for (const glm::ivec2 size : {glm::ivec2(23, 17), glm::ivec2(22, 16), glm::ivec2(12, 9),
                                glm::ivec2(7, 17), glm::ivec2(23, 1), glm::ivec2(1, 1)}) {
    const DisplayImage small = reduce(image, size.x, size.y);
    ASSERT_EQ(small.width(), size.x);
    ASSERT_EQ(small.height(), size.y);
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const glm::dvec4 off = values(small.at(x, y)) - average(image, size.x, size.y, x, y);
        // Half a step of a display value, and single precision.
        for (int c = 0; c < 4; ++c) {
          ASSERT_LE(std::abs(off[c]), 0.501) << size.x << "x" << size.y << " at " << x << "," << y;
        }
      }
    }
  }
}

TEST(Reduce, WhatIsEvenStaysSo) {
  for (const Rgba8 color : {Rgba8{0, 0, 0}, Rgba8{255, 255, 255}, Rgba8{1, 127, 254}}) {
    const DisplayImage image(97, 61, color);
    EXPECT_EQ(reduce(image, 41, 13), DisplayImage(41, 13, color));
  }
}

TEST(Reduce, AllPixelsKeptAreTheSame) {
  const DisplayImage image = noise(31, 19);
  EXPECT_EQ(reduce(image, 31, 19), image);
}

}  // namespace
}  // namespace quartet
