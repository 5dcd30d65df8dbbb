#include "app/lab_driver.h"

#include <fmt/format.h>

#include "app/lab_export.h"

namespace quartet {

LabDriver::LabDriver(LabState state, float scale, const GlFunctions& gl, std::function<void()> wake)
    : textures_(gl),
      window_(std::move(state), scale,
              [this](std::size_t slot, const DisplayImage& image) {
                return textures_.upload(slot, image);
              }),
      session_(wake),
      loader_(wake) {
}

bool LabDriver::draw(double seconds) {
  if (const auto loaded = loader_.poll()) {
    if (loaded->scene) {
      window_.scene_loaded(loaded->scene, loaded->asked);
    } else {
      window_.scene_failed(loaded->error);
    }
  }
  snapshot_ = session_.latest();
  const LabOrders orders = window_.draw({snapshot_, session_.status(), loader_.busy(), seconds});
  if (orders.load_scene) {
    loader_.load(*orders.load_scene);
  }
  if (orders.save && snapshot_) {
    save(*orders.save);
  }
  const LabRequest& wanted = window_.state().request;
  if (wanted.scene && !same_request(wanted, submitted_)) {
    submitted_ = wanted;
    request_ = session_.submit(wanted);
  }
  return orders.animate || orders.load_scene || orders.save;
}

bool LabDriver::settled() const {
  return !loader_.busy() && same_request(window_.state().request, submitted_) && snapshot_ &&
         snapshot_->request == request_ && snapshot_->frame >= submitted_.frame;
}

void LabDriver::save(const ExportForm& form) {
  try {
    const std::filesystem::path folder =
        export_lab(*snapshot_, window_.state().view, form, window_.state().scene);
    window_.say(Message::Kind::notice, fmt::format("saved into {}", folder.string()));
  } catch (const std::exception& error) {
    window_.say(Message::Kind::error, error.what());
  }
}

}  // namespace quartet
