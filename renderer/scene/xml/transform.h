#pragma once

#include <glm/glm.hpp>
#include <pugixml.hpp>

#include "renderer/scene/xml/xml_document.h"

namespace quartet {

/// A point, vector or operand of a transform: attributes x, y, z (`missing` for those absent), or
/// `value` with one number for all three, or with three. Throws SceneError.
glm::dvec3 read_vector(const XmlDocument& xml, pugi::xml_node node, const glm::dvec3& missing);

/// A <transform>: its operations in file order, the first applied first. The matrix is affine and
/// invertible. Throws SceneError.
glm::dmat4 read_transform(const XmlDocument& xml, pugi::xml_node node);

}  // namespace quartet
