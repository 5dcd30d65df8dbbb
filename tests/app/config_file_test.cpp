#include "app/config_file.h"

#include <gtest/gtest.h>

#include "tests/image/temp_folder.h"

namespace quartet {
namespace {

TEST(ConfigFile, KeepsWhatTheWindowRemembers) {
  const TempFolder folder;
  const std::filesystem::path path = folder / "quartet/settings.json";
  LabState state = initial_state();
  state.scene = "veach-plates";
  state.layout = LabLayout::large;
  state.view.exposure = -1.5f;
  state.view.heat = HeatRange::report;
  state.view.tone_map = ToneMap::filmic;
  state.ui_scale = 1.25f;
  state.request.metric = MetricId::flip;
  state.dock.open = false;
  state.dock.height = 240.0f;
  state.dock.effort = Effort::mean_spp;
  state.slots[2][1] = {ViewKind::difference, 3};
  save_config(path, state, {1920, 1080});

  LabState read = initial_state();
  WindowMemory memory;
  EXPECT_EQ(load_config(path, read, memory), "");
  EXPECT_EQ(memory.width, 1920);
  EXPECT_EQ(memory.height, 1080);
  EXPECT_EQ(read.scene, state.scene);
  EXPECT_EQ(read.layout, state.layout);
  EXPECT_EQ(read.view, state.view);
  EXPECT_EQ(read.ui_scale, state.ui_scale);
  EXPECT_EQ(read.slots, state.slots);
  EXPECT_EQ(read.request.metric, state.request.metric);
  EXPECT_EQ(read.dock.open, state.dock.open);
  EXPECT_EQ(read.dock.height, state.dock.height);
  EXPECT_EQ(read.dock.effort, state.dock.effort);
}

TEST(ConfigFile, ABrokenOneIsNamedAndNotUsed) {
  const TempFolder folder;
  const std::filesystem::path path = folder / "settings.json";
  for (const char* text : {"{", "[]", R"({"scene": "x", "tone_map": "no such"})",
                           R"({"scene": "x", "slots": [[{"view": 7}]]})"}) {
    write_bytes_to(path, text);
    LabState state = initial_state();
    WindowMemory memory;
    load_config(path, state, memory);
    EXPECT_EQ(state.scene, LabState().scene) << text;
  }
  LabState state = initial_state();
  WindowMemory memory;
  write_bytes_to(path, "{");
  EXPECT_NE(load_config(path, state, memory).find("settings.json"), std::string::npos);
  EXPECT_EQ(load_config(folder / "missing.json", state, memory), "");
}

}  // namespace
}  // namespace quartet
