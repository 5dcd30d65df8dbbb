#include "app/window/config_file.h"
#include "tests/fuzz/feed.h"
#include "tests/fuzz/mesh_promises.h"

namespace quartet {
namespace {

constexpr const char* settings_name = "settings.json";

struct Remembered {
  LabState state = initial_state();
  WindowMemory memory;
};

void promise_settings(const Remembered& read) {
  const LabState& state = read.state;
  promise(read.memory.width > 0 && read.memory.width <= 16384, "a window's width has no limit");
  promise(read.memory.height > 0 && read.memory.height <= 16384, "a window's height has no limit");
  promise_finite({state.ui_scale, state.view.exposure, state.dock.height}, "the settings");
  promise(state.ui_scale >= 0.0f && state.ui_scale <= 8.0f, "the scale of the text has no limit");
  for (const LaneSlots& slots : state.slots) {
    for (const SlotChoice& slot : slots) {
      promise(slot.other < lane_count, "a picture is compared with a lane that is not there");
    }
  }
}

}  // namespace

/// The input is a file of settings.
void feed_settings(std::string_view input) {
  Remembered read;
  const std::string complaint =
      load_config(scratch_file(settings_name, input), read.state, read.memory);
  promise_settings(read);
  if (!complaint.empty()) {
    promise_message(complaint, settings_name);
    return;
  }
  const std::filesystem::path again = scratch_file("again.json", "");
  save_config(again, read.state, read.memory);
  Remembered kept;
  const std::string trouble = load_config(again, kept.state, kept.memory);
  promise(trouble.empty(), "what was saved cannot be read: " + trouble);
  promise(kept.state.scene == read.state.scene && kept.state.slots == read.state.slots &&
              kept.state.view == read.state.view && kept.memory.width == read.memory.width &&
              kept.memory.height == read.memory.height,
          "settings change when they are saved");
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_settings)
