#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/window/errand.h"
#include "renderer/scene/load_scene.h"
#include "renderer/trace/trace_scene.h"

namespace quartet {

/// Loads scenes beside the window, which goes on meanwhile: a large file and its hierarchy take
/// seconds. The newest wins: it ends the loading of the one before.
class SceneLoader {
 public:
  struct Order {
    std::string scene;
    SceneParameters parameters;
  };

  struct Result {
    std::string asked;
    std::shared_ptr<const TraceScene> scene;  ///< null if it failed
    std::string error;                        ///< one line: file, line, reason
  };

  /// Makes a scene ready for tracing. Throws Cancelled soon once a stop is asked for.
  using Open =
      std::function<std::shared_ptr<const TraceScene>(const Order&, const std::stop_token& stop)>;

  /// `wake` is called, on another thread, when there is a result.
  explicit SceneLoader(std::function<void()> wake, Open open = open_for_tracing);

  void load(const std::string& scene, const SceneParameters& parameters = {}) {
    errand_.order({scene, parameters});
  }
  /// Nothing is wanted any more.
  void cancel() { errand_.cancel(); }
  bool busy() const { return errand_.busy(); }
  /// A result, once.
  std::optional<Result> poll() { return errand_.poll(); }
  /// Asks what is under way to end, without waiting.
  void close() { errand_.close(); }

 private:
  static std::shared_ptr<const TraceScene> open_for_tracing(const Order& order,
                                                            const std::stop_token& stop);

  Errand<Order, Result> errand_;
};

}  // namespace quartet
