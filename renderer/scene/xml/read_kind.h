#pragma once

#include <optional>
#include <variant>

#include "renderer/scene/xml/element.h"

namespace quartet {

template <class Family>
struct KindReader;
template <class... Kinds>
struct KindReader<std::variant<Kinds...>> {
  static std::optional<std::variant<Kinds...>> read(SceneBuilder& builder, Element& element) {
    std::optional<std::variant<Kinds...>> result;
    const auto try_kind = [&]<class Kind>(const Kind*) {
      if (element.type() != Kind::name) return false;
      result = Kind::read(builder, element);
      return true;
    };
    static_cast<void>((try_kind(static_cast<const Kinds*>(nullptr)) || ...));
    return result;
  }
};

/// What `element` describes, by the kind of a family (a variant of kinds) that has the name of its
/// type; nothing if none has. Throws SceneError.
template <class Family>
std::optional<Family> read_kind(SceneBuilder& builder, Element& element) {
  return KindReader<Family>::read(builder, element);
}

}  // namespace quartet
