#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "renderer/scene/load_scene.h"
#include "renderer/trace/trace_scene.h"

namespace quartet {

/// Loads scenes beside the window, which goes on meanwhile: a large file and its hierarchy take
/// seconds. One at a time; of several that wait, the newest.
class SceneLoader {
 public:
  /// `wake` is called, on another thread, when there is a result.
  explicit SceneLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

  struct Result {
    std::string asked;
    std::shared_ptr<const TraceScene> scene;  ///< null if it failed
    std::string error;                        ///< one line: file, line, reason
  };

  void load(const std::string& scene, const SceneParameters& parameters = {});
  bool busy() const { return running_.valid(); }
  /// A result, once.
  std::optional<Result> poll();

 private:
  struct Order {
    std::string scene;
    SceneParameters parameters;
  };

  void start(Order order);

  std::function<void()> wake_;
  std::future<Result> running_;
  std::optional<Order> next_;
};

}  // namespace quartet
