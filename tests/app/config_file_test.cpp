#include "app/window/config_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/files/temp_folder.h"

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
  state.request.lanes.metric = MetricId::flip;
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
  EXPECT_EQ(read.request.lanes.metric, state.request.lanes.metric);
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
  const std::string deep = R"({"scene": "x", "slots": )" + std::string(100'000, '[');
  for (const std::string& text :
       {deep, std::string(2 << 20, ' '), std::string("{\"scene\": \"\x1b\"}")}) {
    write_bytes_to(path, text);
    LabState state = initial_state();
    WindowMemory memory;
    const std::string complaint = load_config(path, state, memory);
    EXPECT_NE(complaint.find("settings.json"), std::string::npos);
    EXPECT_EQ(complaint.find('\x1b'), std::string::npos) << complaint;
    EXPECT_EQ(state.scene, LabState().scene);
  }
  LabState state = initial_state();
  WindowMemory memory;
  std::filesystem::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_NE(load_config(path, state, memory).find("pipe"), std::string::npos);
  std::filesystem::remove(path);
  write_bytes_to(path, "{");
  EXPECT_NE(load_config(path, state, memory).find("settings.json"), std::string::npos);
  EXPECT_EQ(load_config(folder / "missing.json", state, memory), "");
}

TEST(ConfigFile, NumbersOutOfRangeAreNamedAndTheRestIsUsed) {
  const TempFolder folder;
  const std::filesystem::path path = folder / "settings.json";
  const std::vector<std::pair<std::string, std::string>> cases{
      {R"("width": 99999999999999999999)", "'width'"},
      {R"("width": 3000000000)", "'width' is 3000000000; a whole number from 960 to 16384"},
      {R"("width": -1)", "'width' is -1"},
      {R"("width": 1000.5)", "'width' is 1000.5"},
      {R"("height": "tall")", "'height' is no number; a whole number from 600 to 16384"},
      {R"("ui_scale": 1e30)", "'ui_scale' is 1e+30; a number from 0.5 to 8"},
      {R"("ui_scale": -1)", "'ui_scale' is -1"},
      {R"("exposure": 1e39)", "'exposure'"},
      {R"("exposure": null)", "'exposure' is no number"},
      {R"("dock": {"height": -3})", "'height' is -3; a number from 0 to 4096"},
      {R"("slots": [[{"view": "image", "other": -1}]])", "'other' is -1"},
      {R"("slots": [[{"view": "image", "other": 18446744073709551615}]])", "'other'"}};
  for (const auto& [text, complaint] : cases) {
    write_bytes_to(path, "{" + text + R"(, "scene": "veach-plates"})");
    LabState state = initial_state();
    const LabState before = state;
    WindowMemory memory;
    const std::string said = load_config(path, state, memory);
    EXPECT_NE(said.find(complaint), std::string::npos) << text << ": " << said;
    EXPECT_EQ(state.scene, "veach-plates") << text;
    EXPECT_EQ(memory.width, WindowMemory().width);
    EXPECT_EQ(memory.height, WindowMemory().height);
    EXPECT_EQ(state.ui_scale, before.ui_scale);
    EXPECT_EQ(state.view, before.view);
    EXPECT_EQ(state.dock.height, before.dock.height);
    EXPECT_EQ(state.slots[0][0].other, 0u);
  }
}

TEST(ConfigFile, PathsOfAnyBytesCanBeSaved) {
  const TempFolder folder;
  LabState state = initial_state();
  state.scene = "caf\xe9.xml";
  save_config(folder / "settings.json", state, {});
  LabState read = initial_state();
  WindowMemory memory;
  EXPECT_EQ(load_config(folder / "settings.json", read, memory), "");
  EXPECT_EQ(read.scene, "caf\uFFFD.xml");
}

}  // namespace
}  // namespace quartet
