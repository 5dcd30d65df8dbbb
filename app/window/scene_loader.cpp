#include "app/window/scene_loader.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "renderer/base/cancel.h"

namespace quartet {
namespace {

SceneLoader::Result load_result(const SceneLoader::Open& open, const SceneLoader::Order& order,
                                const std::stop_token& stop) {
  SceneLoader::Result result;
  result.asked = order.scene;
  try {
    result.scene = open(order, stop);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::bad_alloc&) {
    result.error = fmt::format("{}: there is not enough memory for it", order.scene);
  } catch (const std::exception& error) {
    result.error = error.what();
  }
  return result;
}

}  // namespace

SceneLoader::SceneLoader(std::function<void()> wake, Open open)
    : errand_(
          [open = std::move(open)](const Order& order, const std::stop_token& stop) {
            return load_result(open, order, stop);
          },
          std::move(wake)) {
}

std::shared_ptr<const TraceScene> SceneLoader::open_for_tracing(const Order& order,
                                                                const std::stop_token& stop) {
  return std::make_shared<const TraceScene>(open_scene(order.scene, order.parameters, stop), stop);
}

}  // namespace quartet
