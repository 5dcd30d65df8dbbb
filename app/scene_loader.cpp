#include "app/scene_loader.h"

#include <fmt/format.h>

#include <new>
#include <utility>

#include "renderer/cancel.h"

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
    : task_(
          [open = std::move(open)](const std::optional<Order>& order, const std::stop_token& stop,
                                   const Task::Publish& publish) {
            if (!order) {
              return;
            }
            try {
              publish(load_result(open, *order, stop));
            } catch (const Cancelled&) {
              // Another is wanted, or none.
            }
          },
          std::move(wake)) {
}

std::shared_ptr<const TraceScene> SceneLoader::open_for_tracing(const Order& order,
                                                                const std::stop_token& stop) {
  return std::make_shared<const TraceScene>(open_scene(order.scene, order.parameters, stop), stop);
}

void SceneLoader::load(const std::string& scene, const SceneParameters& parameters) {
  asked_ = task_.submit(Order{scene, parameters});
}

void SceneLoader::cancel() {
  task_.submit(std::nullopt);
  asked_ = 0;
}

std::optional<SceneLoader::Result> SceneLoader::poll() {
  if (!busy()) {
    return std::nullopt;
  }
  const auto latest = task_.latest();
  if (latest->input != asked_) {
    return std::nullopt;
  }
  asked_ = 0;
  return latest->output;
}

}  // namespace quartet
