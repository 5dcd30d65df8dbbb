#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "renderer/scene/mesh/mesh.h"
#include "renderer/scene/xml/element_writer.h"
#include "renderer/scene/xml/number.h"
#include "renderer/scene/xml/rounded.h"

namespace quartet {
namespace {

/// How the reader of rectangles numbers the corners of one: as it stands in its own plane, or the
/// other way round if its front is to be on the other side.
struct RectangleForm {
  std::array<glm::vec2, 4> uvs;
  int along_u;  ///< the corner at the end of u
  int along_v;
  bool flipped;
};

constexpr std::array rectangle_forms{
    RectangleForm{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, 1, 3, false},
    RectangleForm{{{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}, 3, 1, true},
};

const RectangleForm* form_of(const Mesh& mesh) {
  for (const RectangleForm& form : rectangle_forms) {
    if (mesh.parallelogram && mesh.normals.empty() && std::ranges::equal(mesh.uvs, form.uvs)) {
      return &form;
    }
  }
  return nullptr;
}

using Corners12 = std::array<double, 12>;

glm::dvec3 corner_of(const Corners12& values, int i) {
  const std::size_t at = 3 * std::size_t(i);
  return {values[at], values[at + 1], values[at + 2]};
}

/// The nearest parallelogram: each corner takes a quarter of what is missing.
void make_parallelogram(Corners12& values) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double off = 0.25 * (values[c] - values[3 + c] + values[6 + c] - values[9 + c]);
    for (std::size_t i = 0; i < 4; ++i) values[3 * i + c] -= i % 2 == 0 ? off : -off;
  }
}

void write_rectangle(ElementWriter& element, const Mesh& mesh, const RectangleForm& form) {
  std::array<float, 12> floats{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) floats[3 * i + c] = mesh.positions[i][int(c)];
  }
  const Corners12 corners = rounded_to(floats, make_parallelogram);
  const glm::dvec3 origin = corner_of(corners, 0);
  const glm::dvec3 u = 0.5 * (corner_of(corners, form.along_u) - origin);
  const glm::dvec3 v = 0.5 * (corner_of(corners, form.along_v) - origin);
  const glm::dvec3 middle = 0.5 * (origin + corner_of(corners, 2));
  element.set_type("rectangle");
  element.transform("to_world",
                    {glm::dvec4(u, 0.0), glm::dvec4(v, 0.0),
                     glm::dvec4(glm::normalize(glm::cross(u, v)), 0.0), glm::dvec4(middle, 1.0)});
  if (form.flipped) element.boolean("flip_normals", true);
}

/// Floats along a normal that become it when the reader makes them of unit length: it is itself
/// only nearly that. Of several lengths one will do.
glm::vec3 normal_to_write(const glm::vec3& normal) {
  constexpr int lengths = 64;
  for (int i = 0; i < lengths; ++i) {
    const glm::vec3 scaled = normal * (1.0f + float(i) / float(lengths));
    if (glm::vec3(glm::normalize(glm::dvec3(scaled))) == normal) return scaled;
  }
  return normal;
}

void append_row(std::string& text, std::string_view what, const glm::vec3& row, int columns) {
  text += what;
  for (int i = 0; i < columns; ++i) {
    text += ' ';
    text += exact_text(row[i]);
  }
  text += '\n';
}

std::string obj_text(const Mesh& mesh) {
  std::string text;
  for (const glm::vec3& position : mesh.positions) append_row(text, "v", position, 3);
  for (const glm::vec2& uv : mesh.uvs) append_row(text, "vt", {uv, 0.0f}, 2);
  for (const glm::vec3& normal : mesh.normals) append_row(text, "vn", normal_to_write(normal), 3);
  const bool uvs = !mesh.uvs.empty();
  const bool normals = !mesh.normals.empty();
  for (const glm::uvec3& triangle : mesh.triangles) {
    text += 'f';
    for (int i = 0; i < 3; ++i) {
      const unsigned n = triangle[i] + 1;
      text += fmt::format(" {}", n);
      if (uvs || normals) text += uvs ? fmt::format("/{}", n) : "/";
      if (normals) text += fmt::format("/{}", n);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void Mesh::write(ElementWriter& element) const {
  if (const RectangleForm* form = form_of(*this)) {
    write_rectangle(element, *this, *form);
    return;
  }
  SceneWriting& writing = element.writing();
  const std::string file = fmt::format("{}-mesh-{}.obj", writing.stem, writing.meshes.size() + 1);
  writing.meshes.push_back({file, obj_text(*this)});
  element.set_type("obj");
  element.text("filename", file);
  element.boolean("flip_tex_coords", false);
  if (normals.empty()) element.boolean("face_normals", true);
}

}  // namespace quartet
