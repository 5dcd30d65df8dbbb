#pragma once

#include <memory>
#include <string>

#include "ui/window/keys.h"
#include "ui/window/lab_frame.h"
#include "ui/window/pictures/picture_cache.h"

namespace quartet {

/// What a frame of the window is drawn from.
struct LabInput {
  std::shared_ptr<const Snapshot> snapshot;  ///< null before the first one
  SessionStatus status;
  bool loading = false;            ///< a scene is being loaded
  bool saving = false;             ///< an export is being written
  ReferenceStatus reference;       ///< of what is asked for now
  bool reference_pending = false;  ///< whether there is one will be known soon
  Evaluation evaluation;           ///< the newest; of any snapshot, also an older one
  EqualiseProgress equalising;
  std::optional<RejectedSample> rejected;  ///< of the pixel that is read out, once it is found
  double seconds = 0.0;                    ///< on any clock
};

/// The lab window: what it looks like and what it does with mouse and keys. It knows no thread and
/// no graphics library: the application feeds it snapshots, uploads its pictures, and passes on
/// what it asks for.
class LabWindow {
 public:
  /// An ImGui context must be current, before its first frame.
  LabWindow(LabState state, UploadTexture upload);

  /// Takes the scale of text and controls that the user chose, else `natural`, which suits the
  /// display. Between two frames. Returns whether fonts were made anew: textures of the old ones
  /// mean nothing now.
  bool rescale(float natural);

  /// Draws all of it, between ImGui's NewFrame and Render.
  LabOrders draw(const LabInput& input);
  void key(const KeyEvent& event) { handle_key(state_, event); }

  void scene_loaded(std::shared_ptr<const TraceScene> scene, const std::string& asked);
  /// The old scene stays.
  void scene_failed(const std::string& reason);
  void say(Message::Kind kind, std::string text) { message_ = {kind, std::move(text)}; }

  LabState& state() { return state_; }
  const LabState& state() const { return state_; }
  const Message& message() const { return message_; }
  const Ui& ui() const { return ui_; }

 private:
  void draw_lanes(LabFrame& frame, const ScreenRect& area);
  void normalize_exposure();
  void keep_request_consistent(bool reference_pending);

  Ui ui_;
  LabState state_;
  PictureCache pictures_;
  Message message_;
  std::shared_ptr<const Snapshot> snapshot_;
  StoreRequest last_store_;  ///< of the frame before
};

}  // namespace quartet
