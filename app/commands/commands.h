#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "app/options/number_option.h"

namespace quartet {

/// What every command gets to know of the program it runs in.
struct Program {
  std::string command_line;  ///< quoted for a shell
};

/// Adds a command to the program: its options, its help, and a callback that does the work. The
/// callback throws UsageError or any other std::exception. `program` must outlive the parsing.
void add_figure_command(CLI::App& app, const Program& program);
void add_render_command(CLI::App& app, const Program& program);
void add_screenshot_command(CLI::App& app, const Program& program);
void add_reference_command(CLI::App& app, const Program& program);
void add_compare_command(CLI::App& app, const Program& program);
void add_sweep_command(CLI::App& app, const Program& program);
void add_calibrate_command(CLI::App& app, const Program& program);
void add_claims_command(CLI::App& app, const Program& program);
void add_list_command(CLI::App& app, const Program& program);
void add_info_command(CLI::App& app, const Program& program);
void add_trace_command(CLI::App& app, const Program& program);
void add_bias_command(CLI::App& app, const Program& program);
void add_stability_command(CLI::App& app, const Program& program);
void add_versus_command(CLI::App& app, const Program& program);
void add_needs_command(CLI::App& app, const Program& program);

/// Of text and controls, 1 as they are drawn.
inline constexpr NumberRange<float> ui_scale_range{0.5f, 8.0f};

/// The options of the window, which is what the program opens without a command.
struct WindowOptions {
  std::string scene;              ///< one that can be found; empty: the last one
  std::optional<float> ui_scale;  ///< none: as last time, or as the monitor says
  bool reset_settings = false;
};

/// Opens the lab window until it is closed. Without a display it says so and makes the report's
/// figures instead, into a folder that was not there: out, or out-2 and so on.
void run_lab_window(const WindowOptions& options, const Program& program);

/// The report's figures of a scene, the default one if none is named.
void run_default_figure(const Program& program, const std::string& scene, const std::string& out);

}  // namespace quartet
