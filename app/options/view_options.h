#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "renderer/view/views.h"

namespace quartet {

/// How pictures are shown, as options; what is not given is as ViewSettings has it.
struct ViewOptions {
  std::string heat;
  std::string tone_map;
  std::optional<float> exposure;
};

void add_view_options(CLI::App& command, ViewOptions& options);
/// Throws UsageError, or std::invalid_argument for an unknown tone map.
ViewSettings view_settings(const ViewOptions& options);
std::string heat_id(HeatRange range);

}  // namespace quartet
