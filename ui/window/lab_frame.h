#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "renderer/session/evaluation.h"
#include "renderer/session/find_rejected.h"
#include "renderer/session/reference_task.h"
#include "renderer/session/session.h"
#include "ui/widgets/theme.h"
#include "ui/window/lab_state.h"

namespace quartet {

/// Makes a picture that of a texture slot and returns a handle that ImGui draws with: all that the
/// window needs of a graphics library.
using UploadTexture = std::function<std::uintptr_t(std::size_t slot, const DisplayImage& image)>;

/// What is to become of the reference.
struct ReferenceOrder {
  std::filesystem::path file;  ///< to load; or, if empty,
  std::uint64_t spp = 0;       ///< to compute, at least; 0: what there is, and no more
};

/// All lanes shall take the same, or come as far, by this pass; exactly one is given.
struct EqualiseOrder {
  std::uint32_t passes = 15;
  std::optional<double> spp;      ///< mean
  std::optional<double> seconds;  ///< as if alone
  std::optional<double> error;    ///< in the metric of the request
};

/// How far that has come.
struct EqualiseProgress {
  std::size_t lanes = 0;  ///< 0: nothing is under way
  std::size_t done = 0;
};

/// What the user asked for, beyond the request, while one frame was drawn.
struct LabOrders {
  std::optional<std::string> load_scene;  ///< a built-in name or a file
  std::optional<ExportForm> save;
  std::optional<ReferenceOrder> reference;
  std::optional<EqualiseOrder> equalise;
  bool stop_equalising = false;
  bool cancel = false;   ///< what is being loaded or saved
  bool animate = false;  ///< time passes: draw again soon, even without input
};

/// The line at the bottom that stays until something better is to be said.
struct Message {
  enum class Kind { none, notice, error };
  Kind kind = Kind::none;
  std::string text;
};

class PictureCache;

/// What the parts of the window share while one frame is drawn.
struct LabFrame {
  Ui& ui;
  LabState& state;
  const Snapshot* snapshot;  ///< null before the first one
  const SessionStatus& status;
  bool loading;  ///< a scene is being loaded
  bool saving;   ///< an export is being written
  const ReferenceStatus& reference;
  const Evaluation& evaluation;
  const EqualiseProgress& equalising;
  const std::optional<RejectedSample>& rejected;  ///< of the pixel that is read out, once known
  PictureCache& pictures;
  Message& message;
  LabOrders& orders;
  /// Pixel under the mouse; LabState::hovered is that of the frame before, so that all slots mark
  /// the same one, whichever is drawn first.
  std::optional<glm::ivec2> hovered = std::nullopt;

  /// That of its estimator: two lanes of one estimator share it, and are told apart by number.
  ImU32 lane_color(std::size_t index) const {
    return estimator_color(state.request.lanes.settings[index].estimator);
  }
  /// The lane's numbers, if there are any yet.
  const LaneSnapshot* lane(std::size_t index) const {
    return snapshot && index < snapshot->lanes.size() ? &snapshot->lanes[index] : nullptr;
  }
};

}  // namespace quartet
