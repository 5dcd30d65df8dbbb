#pragma once

#include <filesystem>
#include <optional>

#include "ui/window/lab_state.h"

namespace quartet {

/// What the window remembers from one time to the next: layout, views, scene, sizes. Thresholds are
/// not among it: an experiment begins with what the papers and the report say.
struct WindowMemory {
  int width = 1600;
  int height = 1000;
};

/// settings.json in the folder "quartet" under $XDG_CONFIG_HOME, or under ~/.config. Empty if there
/// is neither.
std::filesystem::path config_path();

/// What the file says replaces what the state says; a missing file changes nothing. Returns what of
/// the file was not used and why, in one line, else an empty text: all of one that is no regular
/// file, larger than a mebibyte, no JSON, or has words that mean nothing here; else single numbers
/// that are out of range.
std::string load_config(const std::filesystem::path& path, LabState& state, WindowMemory& memory);

/// Throws std::runtime_error.
void save_config(const std::filesystem::path& path, const LabState& state,
                 const WindowMemory& memory);

}  // namespace quartet
