#pragma once

#include <functional>
#include <memory>

#include "app/gl_textures.h"
#include "app/scene_loader.h"
#include "renderer/adaptive/session.h"
#include "ui/lab_window.h"

namespace quartet {

/// The window and what answers it: a session, a loader of scenes, textures, files. What draws and
/// where input comes from is the caller's affair, so that the window on a display, the screenshot
/// and the tests are one program.
class LabDriver {
 public:
  /// ImGui's and OpenGL's contexts are current. `wake` is called on other threads when there is
  /// something new to draw.
  LabDriver(LabState state, float scale, const GlFunctions& gl, std::function<void()> wake);

  void load(const std::string& scene, const SceneParameters& parameters = {}) {
    loader_.load(scene, parameters);
  }

  /// Draws the window, between ImGui's NewFrame and Render, and passes on what it asks for.
  /// Returns whether it wants to be drawn again soon though nothing happens.
  bool draw(double seconds);

  /// Whether what was drawn last is the answer to all that was asked.
  bool settled() const;

  LabWindow& window() { return window_; }
  SessionStatus status() const { return session_.status(); }
  const std::shared_ptr<const Snapshot>& snapshot() const { return snapshot_; }

 private:
  void save(const ExportForm& form);

  GlTextures textures_;
  LabWindow window_;
  Session session_;
  SceneLoader loader_;
  std::shared_ptr<const Snapshot> snapshot_;
  LabRequest submitted_;
  std::uint64_t request_ = 0;
};

}  // namespace quartet
