#include "renderer/study/stability/failure_case.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/base/table.h"

namespace quartet {
namespace {

constexpr PicturePart everywhere{};

constexpr std::array table{
    FailureCase{"black-background",
                "failures/black-background",
                "black background",
                "The rim of the ball against black, where contrast is 1 whatever is known; the "
                "black itself (0/0) must stay at few samples.",
                {0.28, 0.13, 0.72, 0.87},
                "heatmap",
                1.0f},
    FailureCase{"black-channel", "failures/black-channel", "one black channel",
                "The wall, whose blue is black but for a rare sample: contrast never leaves it.",
                everywhere, "heatmap", 1.0f},
    FailureCase{"dim-noise",
                "failures/dim-noise",
                "dim noise",
                "The wall under the sill: relative criteria sample its dim noise on and on, "
                "absolute ones leave it as it is.",
                {0.05, 0.55, 0.95, 1.0},
                "heatmap",
                2.0f},
    FailureCase{"bright-half",
                "failures/bright-half",
                "bright regions",
                "The border between the halves in the samples: the same relative noise, but the "
                "error of a divergence grows with luminance.",
                {0.5, 0.0, 1.0, 1.0},
                "heatmap",
                1.0f},
    FailureCase{"checker-sharp", "failures/checker-sharp", "texture edges",
                "The edges of the squares: windows of neighbours never agree there, however many "
                "samples they have.",
                everywhere, "stop", 2.0f},
    FailureCase{"checker-blurred", "failures/checker-blurred", "defocus",
                "The blurred board: samples of a pixel differ, means of neighbours hardly do.",
                everywhere, "heatmap", 2.0f},
    FailureCase{"hdr-edge",
                "failures/hdr-edge",
                "HDR edges",
                "The outline of the light: known after a few samples, sampled to the maximum.",
                {0.1, 0.1, 0.9, 0.9},
                "stop",
                2.0f},
    FailureCase{"rare-light",
                "failures/rare-light",
                "pilot misses a light",
                "Pixels that stopped dark because none of their first samples found the lamp.",
                {0.25, 0.25, 0.75, 0.75},
                "stop",
                2.0f},
    FailureCase{
        "wires",
        "failures/wires",
        "pilot misses geometry",
        "The bright pixels: all their first samples passed beside the wires, a third of a pixel "
        "wide, so that they look finished.",
        {0.4167, 0.375, 0.5833, 0.625},
        "stop",
        4.0f},
    FailureCase{"caustic",
                "failures/caustic",
                "fireflies",
                "The bright spot under the ball: windows chase its fireflies, and pixels without "
                "one stop too dark.",
                {0.2, 0.45, 0.65, 0.85},
                "heatmap",
                2.0f},
    FailureCase{"glossy-plates",
                "failures/glossy-plates",
                "glossy highlights",
                "The reflections of the two lights: bright, narrow and noisy at once.",
                {0.1, 0.25, 0.9, 0.8},
                "heatmap",
                1.0f},
    FailureCase{"door-ajar", "failures/door-ajar", "indirect light only",
                "The whole room: many dark samples and a few bright ones everywhere.", everywhere,
                "stop", 1.0f},
    FailureCase{"grey-furnace", "failures/grey-furnace", "nothing to refine",
                "The samples per pixel, which should be flat and low: there is nothing to find.",
                everywhere, "heatmap", 1.0f},
    FailureCase{"two-valued", "failures/two-valued", "two-valued pixels",
                "The mean of the picture, which is 0.5 in truth.", everywhere, "heatmap", 1.0f},
    FailureCase{"bernoulli", "synthetic:bernoulli", "lucky agreement",
                "Pixels whose first samples were all 0: they agree, look finished and stay black.",
                everywhere, "stop", 1.0f},
    FailureCase{"pareto", "synthetic:pareto", "heavy tail",
                "Single bright pixels and what their neighbourhood gets for it.", everywhere,
                "heatmap", 1.0f},
    FailureCase{"border",
                "synthetic:log-normal",
                "image border",
                "The outermost row in the samples: its windows hold 6 pixels, not 9, and the "
                "divergences divide by that.",
                {0.0, 0.0, 1.0, 0.001},
                "heatmap",
                1.0f},
    FailureCase{"non-finite", "synthetic:non-finite", "non-finite samples",
                "The rejected samples: none may enter a mean, each is counted.", everywhere,
                "rejected", 1.0f},
};

}  // namespace

std::span<const FailureCase> failure_cases() {
  return table;
}

const FailureCase& find_failure_case(std::string_view id) {
  return find_row(failure_cases(), id, "failure case");
}

PixelRegion pixels_of(const PicturePart& region, int width, int height) {
  const auto place = [](double share, int size) {
    return std::clamp(int(std::lround(share * size)), 0, size);
  };
  const int left = std::min(place(region.left, width), width - 1);
  const int top = std::min(place(region.top, height), height - 1);
  return {left, top, std::max(left + 1, place(region.right, width)),
          std::max(top + 1, place(region.bottom, height))};
}

}  // namespace quartet
