#pragma once

#include "renderer/adaptive/lane_settings.h"
#include "ui/widgets/screen_rect.h"
#include "ui/widgets/theme.h"

namespace quartet {

/// In pixels at scale 1; where there is less room the number beside a slider stands alone.
inline constexpr float shortest_slider = 20.0f;

// Each returns whether the settings were changed.

/// How errors become sample counts: a combo box at the cursor, with the parameters of the policy in
/// its menu.
bool edit_policy(Ui& ui, std::size_t lane, LaneSettings& settings, float width);

/// The parameter of the policy that has a slider; nothing where it has none.
bool edit_header_parameter(Ui& ui, std::size_t lane, LaneSettings& settings, ScreenRect box);

}  // namespace quartet
