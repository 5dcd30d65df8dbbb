#pragma once

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderer/adaptive/estimators/pixel_window.h"

namespace quartet {

/// A window of tests/data/estimator-windows.json, planar, with its expected errors.
struct GoldenWindow {
  std::string name;
  std::array<std::vector<double>, 3> channels;
  std::array<double, 3> contrast{};
  double kl = 0.0;
  double chi2 = 0.0;
  double hellinger = 0.0;

  PixelWindow<double> window() const { return {channels[0], channels[1], channels[2]}; }
  double divergence(Divergence which) const {
    return which == Divergence::kl ? kl : which == Divergence::chi2 ? chi2 : hellinger;
  }
};

inline std::vector<GoldenWindow> golden_windows() {
  std::ifstream file(QUARTET_TEST_DATA "/estimator-windows.json");
  std::vector<GoldenWindow> windows;
  const auto document = nlohmann::json::parse(file);
  for (const auto& entry : document.at("cases")) {
    GoldenWindow golden{.name = entry.at("name"),
                        .channels = {},
                        .contrast = entry.at("contrast"),
                        .kl = entry.at("kl"),
                        .chi2 = entry.at("chi2"),
                        .hellinger = entry.at("hellinger")};
    for (const auto& value : entry.at("window")) {
      for (std::size_t c = 0; c < 3; ++c) {
        golden.channels[c].push_back(value.at(c));
      }
    }
    windows.push_back(std::move(golden));
  }
  return windows;
}

inline constexpr std::array all_divergences{Divergence::kl, Divergence::chi2,
                                            Divergence::hellinger};

}  // namespace quartet
