#include "ui/window/keys.h"

#include <algorithm>
#include <array>
#include <utility>

#include "renderer/view/tone_map.h"
#include "ui/window/lab_state.h"

namespace quartet {
namespace {

constexpr float orbit_step = 0.06f;

template <std::size_t lane>
void choose_lane(LabState& state) {
  state.comparison.choose(lane);
}

void next_layout(LabState& state) {
  state.layout = state.layout == LabLayout::columns ? LabLayout::grid
                 : state.layout == LabLayout::grid  ? LabLayout::large
                                                    : LabLayout::columns;
}

void next_tone_map(LabState& state) {
  const auto table = tone_maps();
  std::size_t at = 0;
  while (table[at].key != state.view.tone_map) {
    ++at;
  }
  state.view.tone_map = table[(at + 1) % table.size()].key;
}

void orbit_by(LabState& state, float right, float up) {
  Camera& camera = state.request.store.settings.camera;
  camera = orbit(state.camera, camera, right, up);
}

void dolly_by(LabState& state, float steps) {
  Camera& camera = state.request.store.settings.camera;
  camera = dolly(state.camera, camera, steps);
}

void change_exposure(LabState& state, float stops) {
  float& exposure = state.view.exposure;
  exposure = std::clamp(exposure + stops, -largest_exposure, largest_exposure);
}

void close(LabState& state) {
  if (state.export_form.open || state.help_open) {
    state.export_form.open = false;
    state.help_open = false;
  } else if (state.can_cancel) {
    state.cancel = true;
  } else if (state.pinned) {
    state.pinned.reset();
  } else if (state.layout == LabLayout::large) {
    state.layout = LabLayout::columns;
  }
}

// Where tev (github.com/Tom94/tev) has a key for the same, it is that key.
constexpr std::array table{
    KeyRow{' ', false, "Space", "pause, go on; from the end: play again",
           [](LabState& s) { s.playback.toggle(); }, nullptr},
    KeyRow{',', false, "Comma, dot", "one pass back, one forward",
           [](LabState& s) { s.playback.step(-1); }, nullptr},
    KeyRow{'.', false, "", "", [](LabState& s) { s.playback.step(1); }, nullptr},
    KeyRow{'p', false, "P", "play again from the first pass",
           [](LabState& s) { s.playback.restart(); }, nullptr},

    KeyRow{'l', false, "L", "layout: four columns, 2 × 2, one large", next_layout, nullptr},
    KeyRow{'1', false, "1 – 4", "the lane in the large view", choose_lane<0>, nullptr},
    KeyRow{'2', false, "", "", choose_lane<1>, nullptr},
    KeyRow{'3', false, "", "", choose_lane<2>, nullptr},
    KeyRow{'4', false, "", "", choose_lane<3>, nullptr},
    KeyRow{'a', false, "A", "large view: flip lanes A and B",
           [](LabState& s) { std::swap(s.comparison.lane, s.comparison.other); }, nullptr},
    KeyRow{'w', false, "W", "large view: a wipe between A and B",
           [](LabState& s) { s.comparison.wipe = !s.comparison.wipe; }, nullptr},
    KeyRow{'c', false, "C, held", "lane 1 in the place of all",
           [](LabState& s) { s.hold_first = true; }, [](LabState& s) { s.hold_first = false; }},

    KeyRow{'x', false, "X, held", "the reference in the place of all images",
           [](LabState& s) { s.hold_reference = true; },
           [](LabState& s) { s.hold_reference = false; }},
    KeyRow{'d', false, "D", "unfold, fold the dock of errors",
           [](LabState& s) { s.dock.toggle = true; }, nullptr},

    KeyRow{'f', false, "F", "fit the picture into its slot", [](LabState& s) { s.pan_zoom = {}; },
           nullptr},
    KeyRow{'e', false, "E, Shift+E", "exposure up, down by half a stop",
           [](LabState& s) { change_exposure(s, 0.5f); }, nullptr},
    KeyRow{'e', true, "", "", [](LabState& s) { change_exposure(s, -0.5f); }, nullptr},
    KeyRow{'n', false, "N", "normalise: exposure that shows nearly all of the image",
           [](LabState& s) { s.normalize = true; }, nullptr},
    KeyRow{'r', false, "R", "reset exposure, tone map and zoom",
           [](LabState& s) {
             s.view.exposure = 0.0f;
             s.view.tone_map = ToneMap::clamp;
             s.pan_zoom = {};
           },
           nullptr},
    KeyRow{'t', false, "T", "next tone map", next_tone_map, nullptr},
    KeyRow{'g', false, "G", "heatmap scale: linked, or the report's",
           [](LabState& s) {
             s.view.heat = s.view.heat == HeatRange::linked ? HeatRange::report : HeatRange::linked;
           },
           nullptr},

    KeyRow{key_left, false, "Arrows", "turn the camera",
           [](LabState& s) { orbit_by(s, -orbit_step, 0); }, nullptr},
    KeyRow{key_right, false, "", "", [](LabState& s) { orbit_by(s, orbit_step, 0); }, nullptr},
    KeyRow{key_up, false, "", "", [](LabState& s) { orbit_by(s, 0, orbit_step); }, nullptr},
    KeyRow{key_down, false, "", "", [](LabState& s) { orbit_by(s, 0, -orbit_step); }, nullptr},
    KeyRow{key_page_up, false, "Page up, down", "camera nearer, farther",
           [](LabState& s) { dolly_by(s, 1.0f); }, nullptr},
    KeyRow{key_page_down, false, "", "", [](LabState& s) { dolly_by(s, -1.0f); }, nullptr},
    KeyRow{key_home, false, "Home", "the scene's own camera",
           [](LabState& s) { s.request.store.settings.camera = s.camera.home; }, nullptr},

    KeyRow{'s', false, "S", "save the figure, or one panel",
           [](LabState& s) { s.export_form.open = true; }, nullptr},
    KeyRow{'h', false, "H, ?", "these keys", [](LabState& s) { s.help_open = !s.help_open; },
           nullptr},
    KeyRow{'?', false, "", "", [](LabState& s) { s.help_open = !s.help_open; }, nullptr},
    KeyRow{key_escape, false, "Esc",
           "close what is open, end what is loaded or saved; let go of the pixel", close, nullptr},
    KeyRow{'q', false, "Q", "quit", [](LabState& s) { s.quit = true; }, nullptr},
};

constexpr std::array mice{
    MouseRow{"drag on a picture", "pan all pictures"},
    MouseRow{"wheel", "zoom all pictures at the mouse; far in, the numbers stand in the pixels"},
    MouseRow{"click", "pin the read-out to a pixel; again: let go"},
    MouseRow{"double click", "fit"},
    MouseRow{"right drag", "turn the camera"},
    MouseRow{"Ctrl + wheel", "camera nearer, farther"},
    MouseRow{"drag the line in a plot", "move the threshold"},
    MouseRow{"double click on a number", "type it"},
    MouseRow{"drop a file", "load that scene; a picture is a reference"},
};

}  // namespace

std::span<const KeyRow> key_table() {
  return table;
}

std::span<const MouseRow> mouse_table() {
  return mice;
}

KeyEvent key_event(char32_t character, int place, bool shift) {
  const auto is_letter = [](char32_t c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  const auto is_key = [](const KeyRow& row, char32_t c) { return char32_t(row.key) == c; };
  if (is_letter(character)) {
    return {int(character | 0x20u), true, shift, false};
  }
  if (std::ranges::any_of(table, [&](const KeyRow& row) { return is_key(row, character); })) {
    return {int(character), true, false, false};
  }
  constexpr char32_t first_beyond_latin = 0x370;
  const bool in_digit_row = place >= '0' && place <= '9';
  if (character >= first_beyond_latin || in_digit_row) {
    return {place, true, shift, false};
  }
  return {0, true, shift, false};
}

bool handle_key(LabState& state, const KeyEvent& event) {
  if (event.ctrl) {
    return false;
  }
  for (const KeyRow& row : table) {
    if (row.key != event.key) {
      continue;
    }
    if (!event.down) {
      if (row.release) {
        row.release(state);
      }
      return row.release != nullptr;
    }
    if (row.shift == event.shift) {
      row.press(state);
      return true;
    }
  }
  return false;
}

}  // namespace quartet
