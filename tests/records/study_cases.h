#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "app/options/run_options.h"
#include "renderer/scene/load_scene.h"

// For files of studies, of data made by hand in which every number is another.

namespace quartet::test {

/// Of 2 × 1 pixels.
inline Run tiny_run() {
  Run run;
  run.scene = std::make_shared<const TraceScene>(open_scene("synthetic:bernoulli"));
  run.settings = default_settings(run.scene->scene());
  run.settings.width = 2;
  run.settings.height = 1;
  run.settings.seed = 40;
  return run;
}

inline std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

inline void expect_lines(const std::string& text, const std::vector<std::string>& expected) {
  const std::vector<std::string> lines = lines_in(text);
  for (std::size_t i = 0; i < std::max(lines.size(), expected.size()); ++i) {
    EXPECT_EQ(i < lines.size() ? lines[i] : "nothing",
              i < expected.size() ? expected[i] : "nothing")
        << "line " << i + 1;
  }
}

inline LaneSettings kl_settings(float threshold, SampleMode mode = SampleMode::reuse) {
  LaneSettings settings = default_settings(EstimatorId::kl);
  settings.thresholds[0] = threshold;
  settings.policy.kind = PolicyId::converge;
  settings.mode = mode;
  return settings;
}

}  // namespace quartet::test
