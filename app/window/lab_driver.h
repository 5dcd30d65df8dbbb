#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/window/errand.h"
#include "app/window/gl_textures.h"
#include "app/window/imgui_screen.h"
#include "app/window/lab_export.h"
#include "app/window/scene_loader.h"
#include "renderer/session/equalise_task.h"
#include "renderer/session/evaluation.h"
#include "renderer/session/find_rejected.h"
#include "renderer/session/reference_task.h"
#include "renderer/session/session.h"
#include "ui/window/lab_window.h"

namespace quartet {

/// The window and what answers it: a session, a loader of scenes, textures, files. What draws and
/// where input comes from is the caller's affair, so that the window on a display, the screenshot
/// and the tests are one program.
class LabDriver {
 public:
  /// ImGui's and OpenGL's contexts are current. `wake` is called on other threads when there is
  /// something new to draw.
  /// References are cached in the folder `reference_cache`, or not at all if it is empty.
  LabDriver(LabState state, const GlFunctions& gl, std::function<void()> wake,
            const std::filesystem::path& reference_cache = {});
  /// Asks all that is under way to end at the same time, and waits for it.
  ~LabDriver();
  LabDriver(const LabDriver&) = delete;
  LabDriver& operator=(const LabDriver&) = delete;

  /// A file that was dropped: a reference if it is a picture, else a scene.
  void drop(const std::filesystem::path& file);
  void load_reference(const std::filesystem::path& file, const std::string& layer = {});
  void load(const std::string& scene, const SceneParameters& parameters = {}) {
    loader_.load(scene, parameters);
  }

  /// Begins a frame of the screen; `natural_scale` is that of text and controls on its display.
  void begin_frame(ImguiScreen& screen, float natural_scale);

  /// Draws the window, between ImGui's NewFrame and Render, and passes on what it asks for.
  /// Returns whether it wants to be drawn again soon though nothing happens.
  bool draw(double seconds);

  /// Whether what was drawn last is the answer to all that was asked.
  bool settled() const;

  LabWindow& window() { return window_; }
  /// Why something that was asked for cannot be had; empty if all is well.
  std::string error() const;
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }
  /// Whether samples were forgotten for want of memory.
  bool partial() const { return session_.status().partial; }
  /// A rejected sample of the pixel that is read out, if there is one and it was found.
  std::optional<RejectedSample> rejected() const;

 private:
  void ask_for_reference(ReferenceRequest request);
  void keep_reference_current();
  void evaluate();
  void look_for_rejected();
  void equalise(const EqualiseOrder& order);
  EqualiseProgress keep_equalising();
  void take_scene();
  void take_export();
  void obey(const LabOrders& orders);
  void load_typed(const std::string& scene);
  void load_typed_reference(const ReferenceOrder& order);
  void save(const ExportForm& form);
  void cancel();
  bool keep_size_within_memory();
  void submit();

  GlTextures textures_;
  LabWindow window_;
  Session session_;
  SceneLoader loader_;
  std::shared_ptr<const Snapshot> snapshot_;
  LabRequest submitted_;
  std::uint64_t request_ = 0;
  glm::ivec2 fitting_size_{0};  // of pictures, the last that was not too large

  ReferenceTask references_;
  ReferenceRequest asked_reference_;
  std::uint64_t reference_request_ = 0;
  std::string said_error_;                    // of the reference, so that it is said once
  std::shared_ptr<const Reference> said_of_;  // whose notes were said
  std::shared_ptr<const ReferenceTask::Answer> reference_;
  EvaluationTask evaluations_;
  EvaluationInput evaluated_;
  std::uint64_t evaluation_request_ = 0;

  RejectedTask rejected_samples_;
  RejectedQuery rejected_query_;
  std::uint64_t rejected_request_ = 0;

  EqualiseTask equaliser_;
  EqualiseRequest equalised_;
  std::uint64_t equalise_request_ = 0;  // 0: nothing is under way

  Errand<ExportRequest, ExportStatus> exports_;  // a large picture takes seconds
};

}  // namespace quartet
