#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <utility>
#include <vector>

#include "renderer/base/cancel.h"

namespace quartet {

/// What a corner of a face in a mesh file refers to, counted from 0; -1: nothing.
struct FaceCorner {
  std::array<std::int32_t, 3> rows{-1, -1, -1};  // position, uv, normal
  bool operator==(const FaceCorner&) const = default;
};

/// Numbers different corners as they come: a hash table in two arrays, which also a hundred million
/// corners leave at once when loading is cancelled.
class CornerTable {
 public:
  explicit CornerTable(const std::stop_token& stop) : tick_(stop), slots_(1024, none) {}

  /// Its number, and whether it is new.
  std::pair<unsigned, bool> number_of(const FaceCorner& corner) {
    if (corners_.size() * 2 >= slots_.size()) {
      grow();
    }
    unsigned& slot = slots_[slot_of(corner)];
    if (slot != none) {
      return {slot, false};
    }
    slot = unsigned(corners_.size());
    corners_.push_back(corner);
    return {slot, true};
  }

 private:
  static constexpr unsigned none = ~0u;

  /// Where it is, or where it belongs.
  std::size_t slot_of(const FaceCorner& corner) const {
    std::uint64_t hash = 0;
    for (const std::int32_t row : corner.rows) {
      hash = (hash ^ std::uint32_t(row)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != none && corners_[slots_[slot]] != corner) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
  }

  void grow() {
    slots_.assign(2 * slots_.size(), none);
    for (unsigned i = 0; i < corners_.size(); ++i) {
      tick_();
      slots_[slot_of(corners_[i])] = i;
    }
  }

  CancelTick tick_;
  std::vector<unsigned> slots_;  // a power of two of them, at least half of them empty
  std::vector<FaceCorner> corners_;
};

}  // namespace quartet
