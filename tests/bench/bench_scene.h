#pragma once

#include <memory>
#include <string_view>

#include "renderer/adaptive/lab.h"
#include "renderer/base/stopwatch.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/integrator.h"

namespace quartet {

/// A built-in scene or a file at a size, ready to render.
struct BenchScene {
  std::shared_ptr<const TraceScene> scene;
  RenderSettings settings;

  BenchScene(std::string_view name, int width, int height)
      : scene(std::make_shared<const TraceScene>(load_scene(find_scene(name)))),
        settings(default_settings(scene->scene())) {
    settings.width = width;
    settings.height = height;
  }

  Lab lab(std::span<const LaneSettings> lane_settings, int threads,
          std::size_t memory = LabOptions().memory) const {
    LabOptions options;
    options.threads = threads;
    options.memory = memory;
    return Lab(sample_source(scene, settings), settings.width, settings.height, lane_settings,
               options);
  }
};

}  // namespace quartet
