#include "app/commands/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/options/number_option.h"
#include "app/options/usage_error.h"
#include "app/terminal/home_folder.h"
#include "app/terminal/messages.h"
#include "app/terminal/shell_words.h"
#include "renderer/base/version.h"
#include "renderer/scene/load_scene.h"

namespace quartet {
namespace {

constexpr int failed = 1;
constexpr int wrong_usage = 2;

std::string joined_command_line(const std::vector<std::string>& words) {
  std::string text = "quartet";
  for (const std::string& word : words) {
    text += ' ';
    text += shell_word(word);
  }
  return text;
}

/// The word with a home folder for the ~ of --out=~/x and -o~/x, which no shell replaces there.
std::string with_home(const std::string& word) {
  // Without an equals sign it is 0, where no ~ stands.
  const std::size_t value = word.starts_with("--") ? word.find('=') + 1 : 2;
  if (!word.starts_with('-') || value >= word.size() || word[value] != '~') {
    return word;
  }
  try {
    return word.substr(0, value) + typed_path(word.substr(value)).string();
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("{}{}", word.substr(0, value), error.what()));
  }
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

std::string command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Why the first word, which is no command, is nothing else either; empty if it is, or is none.
std::string first_word_fault(const CLI::App& app, const WindowOptions& window) {
  if (!app.get_subcommands().empty() || window.scene.empty()) {
    return "";
  }
  try {
    lasting_scene_name(window.scene);
    return "";
  } catch (const std::exception&) {
    return fmt::format(
        "'{}' is neither a command ({}) nor a scene; scenes are Mitsuba 3 XML files and {}",
        window.scene, command_names(app), fmt::join(builtin_scenes(), ", "));
  }
}

/// What fits the buffer would be lost without a word after the return.
int finish_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) {
    return 0;
  }
  const int error = errno != 0 ? errno : EIO;  // of a write before
  std::clearerr(stdout);
  return complain(failed,
                  fmt::format("cannot write to the standard output: {}", std::strerror(error)));
}

/// The help or the version, whichever was asked for.
int print_help(const CLI::App& app, const CLI::ParseError& success) {
  std::ostringstream text;
  app.exit(success, text, text);
  std::fputs(text.str().c_str(), stdout);
  return finish_output();
}

/// Nothing of the program is empty. A word that is comes from a shell's variable that is not set,
/// and would count as an option that is not given.
void check_words(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.empty()) {
      throw UsageError(fmt::format("the word after '{}' is empty; a variable that is not set?",
                                   i > 0 ? words[i - 1] : "quartet"));
    }
    if (word.starts_with("--") && word.find('=') == word.size() - 1) {
      throw UsageError(fmt::format("'{}' has no value; a variable that is not set?", word));
    }
  }
}

/// The window's own options, given beside a command, would do nothing.
void check_window_options(const CLI::App& app, const WindowOptions& window) {
  if (app.get_subcommands().empty()) {
    return;
  }
  const std::string command = app.get_subcommands().front()->get_name();
  const std::string given = window.ui_scale         ? "--ui-scale"
                            : window.reset_settings ? "--reset-settings"
                            : !window.scene.empty() ? fmt::format("'{}'", window.scene)
                                                    : "";
  if (!given.empty()) {
    throw UsageError(fmt::format(
        "{} has no effect before {}: it is for the window, which opens without a command", given,
        command));
  }
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  Program program;
  CLI::App app("Quartet: a lab bench for adaptive sampling in path tracing", "quartet");
  app.set_version_flag("--version", fmt::format("quartet {}", version()));
  app.require_subcommand(0, 1);
  app.footer(
      "Without a command: the lab window; without a display, the report's figures into out/, or\n"
      "out-2/ and so on if there is one already.\n"
      "Exit status: 0 done, 1 failed, 2 wrong usage.\n"
      "Examples:\n"
      "  quartet veach-plates\n"
      "  quartet figure cornell-checker --out out\n"
      "  quartet render veach-plates --estimator uniform --spp 64 -o plates.exr\n"
      "  quartet list");
  WindowOptions window;
  app.add_option("scene", window.scene,
                 "For the window: a Mitsuba 3 XML file, or the name of a built-in scene");
  add_number(app, "--ui-scale", window.ui_scale, ui_scale_range,
             "For the window: size of text and controls; the monitor's if not given");
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
  add_versus_command(app, program);
  add_needs_command(app, program);
  app.parse_complete_callback([&] { check_window_options(app, window); });
  try {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    check_words(words);
    std::ranges::transform(words, words.begin(), with_home);
    program.command_line = joined_command_line(words);
    std::ranges::reverse(words);  // CLI11 takes them from the end
    app.parse(std::move(words));
    if (const std::string fault = first_word_fault(app, window); !fault.empty()) {
      return complain(wrong_usage, fault);
    }
    if (app.get_subcommands().empty()) {
      run_lab_window(window, program);
    }
    return finish_output();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return print_help(app, error);
    }
    // What follows a misspelt command is not expected either, and not what is wrong.
    const std::string fault = first_word_fault(app, window);
    return complain(wrong_usage, fault.empty() ? usage_message(app, error) : fault);
  } catch (const ParameterError& error) {
    return complain(wrong_usage, fmt::format("-D: {}", error.what()));
  } catch (const std::invalid_argument& error) {
    return complain(wrong_usage, error.what());
  } catch (const std::bad_alloc&) {
    return complain(failed, "out of memory; a smaller --size or --memory would help");
  } catch (const std::exception& error) {
    return complain(failed, error.what());
  }
}

}  // namespace quartet
