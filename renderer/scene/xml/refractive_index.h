#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace quartet {

/// Index of refraction of a transparent material at about 589 nm.
struct NamedDielectric {
  std::string_view name;
  float ior;
};

/// Complex index of refraction eta + i k, as linear RGB with Rec. 709 primaries.
struct NamedConductor {
  std::string_view name;
  glm::vec3 eta;
  glm::vec3 k;
};

/// The names that Mitsuba knows (conductors: the metals among them).
std::span<const NamedDielectric> named_dielectrics();
std::span<const NamedConductor> named_conductors();

/// Names of a table, for messages.
std::string names(std::span<const NamedDielectric> table);
std::string names(std::span<const NamedConductor> table);

}  // namespace quartet
