#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

namespace quartet {

/// Arguments that cannot be meant. what() is one line that says what would be right; exit code 2.
struct UsageError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What every command gets to know of the program it runs in.
struct Program {
  std::string command_line;  ///< quoted for a shell
};

/// Adds a command to the program: its options, its help, and a callback that does the work. The
/// callback throws UsageError or any other std::exception. `program` must outlive the parsing.
void add_figure_command(CLI::App& app, const Program& program);
void add_render_command(CLI::App& app, const Program& program);
void add_screenshot_command(CLI::App& app, const Program& program);
void add_list_command(CLI::App& app, const Program& program);

/// What the program does without a command: the figure of the default scene into out/.
void run_default_figure(const Program& program);

}  // namespace quartet
