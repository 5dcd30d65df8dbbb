#include "app/scene_loader.h"

#include <chrono>
#include <utility>

namespace quartet {

void SceneLoader::start(Order order) {
  running_ = std::async(std::launch::async, [order = std::move(order), wake = wake_] {
    Result result;
    result.asked = order.scene;
    try {
      result.scene = std::make_shared<const TraceScene>(open_scene(order.scene, order.parameters));
    } catch (const std::exception& error) {
      result.error = error.what();
    }
    wake();
    return result;
  });
}

void SceneLoader::load(const std::string& scene, const SceneParameters& parameters) {
  if (busy()) {
    next_ = Order{scene, parameters};
  } else {
    start({scene, parameters});
  }
}

std::optional<SceneLoader::Result> SceneLoader::poll() {
  if (!busy() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  Result result = running_.get();
  if (next_) {
    start(*std::exchange(next_, std::nullopt));
    return std::nullopt;  // nobody wants this one any more
  }
  return result;
}

}  // namespace quartet
