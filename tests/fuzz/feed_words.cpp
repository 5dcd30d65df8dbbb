#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/commands/commands.h"
#include "app/options/lane_option.h"
#include "app/options/run_options.h"
#include "app/options/stop_options.h"
#include "app/options/view_options.h"
#include "tests/fuzz/feed.h"

namespace quartet {
namespace {

/// All commands of the program, which do nothing but read their options.
class Commands {
 public:
  Commands() {
    for (const auto add :
         {add_figure_command, add_render_command, add_screenshot_command, add_reference_command,
          add_compare_command, add_sweep_command, add_calibrate_command, add_claims_command,
          add_list_command, add_info_command, add_trace_command, add_bias_command,
          add_stability_command, add_versus_command, add_needs_command}) {
      add(app_, program_);
    }
    // Called once the options are read and checked, ahead of what does the work.
    for (CLI::App* command : app_.get_subcommands({})) {
      command->parse_complete_callback([] { throw OptionsRead(); });
    }
  }

  void parse(const std::vector<std::string>& words) {
    std::vector<const char*> arguments{"quartet"};
    for (const std::string& word : words) {
      arguments.push_back(word.c_str());
    }
    try {
      app_.parse(int(arguments.size()), arguments.data());
    } catch (const OptionsRead&) {
    } catch (const CLI::ParseError& error) {
      promise(error.get_exit_code() == 0 || *error.what() != '\0', "a refusal says nothing");
    }
  }

 private:
  struct OptionsRead {};

  Program program_;
  CLI::App app_;
};

void read_lane(const std::string& word) {
  LaneSettings settings;
  if (!succeeds<std::invalid_argument>("", [&] { settings = parse_lane(word, {}); })) {
    return;
  }
  for (const float threshold : settings.thresholds) {
    promise(std::isfinite(threshold) && threshold >= 0.0f, "a threshold is none: " + word);
  }
  const float multiplier = settings.policy.multiplier;
  promise(std::isfinite(multiplier) && multiplier >= 0.0f, "a multiplier is none: " + word);
  promise(settings.max_spp > 0, "no samples are allowed: " + word);
  const std::string text = lane_text(settings);
  promise(lane_text(parse_lane(text, {})) == text, "a lane's text is of another: " + word);
}

/// A word as each kind of value that the commands read by themselves, once the options are read.
void read_value(const std::string& word) {
  read_lane(word);
  succeeds<std::invalid_argument>("--size", [&] {
    const PictureSize size = parse_size("--size", word);
    promise(size.width > 0 && size.height > 0, "a size is none: " + word);
  });
  succeeds<std::invalid_argument>("-D", [&] {
    for (const auto& [name, value] : parse_defines({word})) {
      promise(word == fmt::format("{}={}", name, value) && !name.empty(),
              "a parameter is another: " + word);
    }
  });
  StopOptions stop;
  stop.error = word;
  succeeds<std::invalid_argument>("", [&] {
    const StopConditions conditions = stop_conditions(stop, true);
    promise(!conditions.error || std::isfinite(conditions.error->value), "no target: " + word);
  });
  ViewOptions heat;
  heat.heat = word;
  succeeds<std::invalid_argument>("", [&] { view_settings(heat); });
  ViewOptions tone_map;
  tone_map.tone_map = word;
  succeeds<std::invalid_argument>("", [&] { view_settings(tone_map); });
  succeeds<SceneError>("", [&] { find_scene(word); });
}

}  // namespace

/// Each line of the input is a word of the command line.
void feed_words(std::string_view input) {
  static Commands commands;
  std::vector<std::string> words;
  while (!input.empty()) {
    const std::string_view line = input.substr(0, input.find('\n'));
    input.remove_prefix(std::min(line.size() + 1, input.size()));
    words.emplace_back(line.substr(0, line.find('\0')));
  }
  commands.parse(words);
  for (const std::string& word : words) {
    read_value(word);
  }
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_words)
