#include "ui/picture_cache.h"

namespace quartet {

const PictureCache::Picture* PictureCache::get(std::size_t texture_slot, const LabFrame& frame,
                                               std::size_t lane, const SlotChoice& choice) {
  if (!frame.lane(lane) || frame.snapshot->frame == 0) {
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
    return &entry.picture;
  }
  entry.snapshot = frame.snapshot->number;
  entry.lane = lane;
  entry.choice = choice;
  entry.settings = settings;
  entry.drawn = true;
  entry.picture.view = draw_view(*frame.snapshot, lane, choice.kind, settings);
  entry.picture.texture =
      entry.picture.view.image.empty() ? 0 : upload_(texture_slot, entry.picture.view.image);
  return &entry.picture;
}

}  // namespace quartet
