#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/study/needs/model.h"

namespace quartet {

enum class PartId { depth, next_event, roulette, light, texture, gloss, lens, normals };

/// One way to make a model simpler.
struct Simplification {
  PartId part = PartId::depth;
  std::string label;  ///< "depth 3", "'floor' smooth → flat"
  /// Does it to a model, the whole one or one with other parts taken out. What stands in a list
  /// keeps its place there.
  std::function<void(Model&)> apply;
};

/// One row of the table of what can be taken out of a model, and how.
struct Part {
  PartId key;
  std::string_view id;           ///< on the command line and in files
  std::string_view label;        ///< for people
  std::string_view description;  ///< what becomes of it
  /// Pictures have the same mean with and without it: it is a matter of time and noise alone.
  bool same_mean;
  /// Whether the command line or a scene file can ask for a model without it. If not, it is
  /// measured, and stays.
  bool can_be_left;
  /// At most one of its simplifications can be done to a model.
  bool exclusive;
  /// How the parts of this kind in a model can be taken out, one by one; none where it has none.
  std::vector<Simplification> (*of)(const Model& whole);
};

std::span<const Part> parts();
const Part& part(PartId key);
/// Throws std::invalid_argument that lists the legal ids.
const Part& find_part(std::string_view id);

/// The model with several parts taken out of it, one after the other.
Model simplified(const Model& whole, std::span<const Simplification> simplifications);

}  // namespace quartet
