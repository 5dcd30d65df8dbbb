#include "ui/window/pictures/picture_cache.h"

#include <cassert>

#include "renderer/view/reduce.h"

namespace quartet {

const View* PictureCache::get(std::size_t texture_slot, const LabFrame& frame, std::size_t lane,
                              const SlotChoice& choice) {
  if (!frame.lane(lane) || frame.snapshot->pass == 0) {
    return nullptr;
  }
  if (texture_slot >= entries_.size()) {
    entries_.resize(texture_slot + 1);
  }
  Entry& entry = entries_[texture_slot];
  ViewSettings settings = frame.state.view;
  settings.other = choice.other;
  if (entry.drawn && entry.snapshot == frame.snapshot->number && entry.lane == lane &&
      entry.choice == choice && entry.settings == settings) {
    return &entry.view;
  }
  entry.snapshot = frame.snapshot->number;
  entry.lane = lane;
  entry.choice = choice;
  entry.settings = settings;
  entry.drawn = true;
  entry.view = draw_view(*frame.snapshot, lane, choice.kind, settings);
  entry.uploaded = glm::ivec2(0);
  return &entry.view;
}

std::uintptr_t PictureCache::texture(std::size_t texture_slot, glm::ivec2 size) {
  Entry& entry = entries_[texture_slot];
  const DisplayImage& image = entry.view.image;
  assert(!image.empty());
  const glm::ivec2 whole(image.width(), image.height());
  const glm::ivec2 wanted = glm::clamp(size, glm::ivec2(1), whole);
  if (entry.uploaded != wanted) {
    entry.texture =
        upload_(texture_slot, wanted == whole ? image : reduce(image, wanted.x, wanted.y));
    entry.uploaded = wanted;
  }
  return entry.texture;
}

}  // namespace quartet
