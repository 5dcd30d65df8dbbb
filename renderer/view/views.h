#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/base/image.h"
#include "renderer/session/snapshot.h"
#include "renderer/view/color_bar.h"
#include "renderer/view/tone_map.h"

namespace quartet {

/// How samples per pixel become colours.
enum class HeatRange {
  linked,  ///< 0 to the highest count of all lanes, so that colours compare
  report,  ///< lowest to highest count of each lane, blue-green-red: the 2021 report
};

/// How lanes are shown; changes nothing that is computed.
struct ViewSettings {
  float exposure = 0.0f;  ///< stops
  ToneMap tone_map = ToneMap::clamp;
  HeatRange heat = HeatRange::linked;
  std::size_t other = 0;  ///< difference: the lane that is subtracted
  bool operator==(const ViewSettings&) const = default;
};

/// What a colour means where colours are not numbers.
struct ColorMeaning {
  Rgba8 color;
  std::string label;
  std::uint64_t pixels = 0;  ///< that have it
};

/// A lane's pixels as one looks at them, with the key to their colours.
struct View {
  DisplayImage image;
  std::optional<ColorBar> bar;
  std::vector<ColorMeaning> legend;
  std::string note;  ///< why there is nothing to see; else empty
};

enum class ViewKind {
  image,
  heatmap,
  error,
  variance,
  stop_state,
  rejected,
  difference,
  true_error,
  reference
};

/// What a view depends on beside the samples of its lane.
struct ViewNeeds {
  /// LaneSnapshot::variance, which a snapshot carries only if it was asked for.
  bool variance = false;
  bool reference = false;   ///< without one there is nothing to see
  bool other_lane = false;  ///< ViewSettings::other
  bool tone_map = false;    ///< ViewSettings::tone_map and exposure: it shows radiance
  bool heat_range = false;  ///< ViewSettings::heat
};

/// One row of the table of views.
struct ViewRow {
  ViewKind key;
  std::string_view id;        ///< on the command line and in files
  std::string_view label;     ///< for people
  std::string_view quantity;  ///< what its numbers are, with their unit; empty if it has none
  bool has_bar = false;       ///< a colour bar belongs to it
  bool has_legend = false;    ///< colours that are not numbers, with their meanings
  ViewNeeds needs = {};
  /// The snapshot has what the view needs; so for `lines`.
  View (*draw)(const Snapshot& snapshot, std::size_t lane, const ViewSettings& settings);
  /// What it says of a pixel, counted in rows from the top left: lines of a number each.
  std::vector<std::string> (*lines)(const Snapshot& snapshot, std::size_t lane,
                                    const ViewSettings& settings, std::size_t pixel);
};

std::span<const ViewRow> views();
const ViewRow& view_row(ViewKind key);
/// Throws std::invalid_argument that lists the legal ids.
const ViewRow& find_view(std::string_view id);

/// A lane of a snapshot as the row says. Scales depend on all lanes of the snapshot where the same
/// colour is to mean the same number in each.
View draw_view(const Snapshot& snapshot, std::size_t lane, ViewKind kind,
               const ViewSettings& settings);

/// What a view says of a pixel, counted in rows from the top left: lines of a number each; none if
/// there is nothing to see.
std::vector<std::string> pixel_lines(const Snapshot& snapshot, std::size_t lane, ViewKind kind,
                                     const ViewSettings& settings, std::size_t pixel);

/// The scale of samples per pixel of one lane.
ColorScale heat_scale(const Snapshot& snapshot, std::size_t lane, HeatRange range);

}  // namespace quartet
