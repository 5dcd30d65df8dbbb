#include "app/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "app/commands.h"
#include "app/messages.h"
#include "app/number_check.h"
#include "app/shell_words.h"
#include "renderer/version.h"

namespace quartet {
namespace {

constexpr int failed = 1;
constexpr int wrong_usage = 2;

std::string joined_command_line(int argc, const char* const* argv) {
  std::string text = "quartet";
  for (int i = 1; i < argc; ++i) {
    text += ' ';
    text += shell_word(argv[i]);
  }
  return text;
}

int complain(int code, std::string_view message) {
  tell("{}", message);
  return code;
}

/// CLI11's message as one line, with a hint at the help of the command that it is about.
std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto chosen = app.get_subcommands();
  const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
  return fmt::format("{} (see quartet{} --help)", text, command);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  const Program program{joined_command_line(argc, argv)};
  CLI::App app("Quartet: a lab bench for adaptive sampling in path tracing", "quartet");
  app.set_version_flag("--version", fmt::format("quartet {}", version()));
  app.require_subcommand(0, 1);
  app.footer(
      "Without a command: the lab window; without a display, the report's figures into out/.\n"
      "Examples:\n"
      "  quartet veach-plates\n"
      "  quartet figure cornell-checker --out out\n"
      "  quartet render veach-plates --estimator uniform --spp 64 -o plates.exr\n"
      "  quartet list");
  WindowOptions window;
  app.add_option("scene", window.scene,
                 "For the window: a Mitsuba 3 XML file, or the name of a built-in scene");
  app.add_option("--ui-scale", window.ui_scale,
                 "For the window: size of text and controls; the monitor's if not given")
      ->check(number_between(0.5, 8.0));
  app.add_flag("--reset-settings", window.reset_settings,
               "For the window: forget layout, views and last scene");
  add_figure_command(app, program);
  add_render_command(app, program);
  add_screenshot_command(app, program);
  add_reference_command(app, program);
  add_compare_command(app, program);
  add_sweep_command(app, program);
  add_calibrate_command(app, program);
  add_claims_command(app, program);
  add_list_command(app, program);
  add_info_command(app, program);
  add_trace_command(app, program);
  add_bias_command(app, program);
  add_stability_command(app, program);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      run_lab_window(window, program);
    }
    // What fits the buffer would be lost without a word after the return.
    if (std::fflush(stdout) != 0) {
      throw std::runtime_error(
          fmt::format("cannot write to the standard output: {}", std::strerror(errno)));
    }
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // help or version, on stdout
    }
    return complain(wrong_usage, usage_message(app, error));
  } catch (const std::invalid_argument& error) {
    return complain(wrong_usage, error.what());
  } catch (const std::bad_alloc&) {
    return complain(failed, "out of memory; a smaller --size or --memory would help");
  } catch (const std::exception& error) {
    return complain(failed, error.what());
  }
}

}  // namespace quartet
