#include "renderer/scene/xml/element_writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <variant>

#include "renderer/scene/xml/number.h"

namespace quartet {
namespace {

std::string color_numbers(glm::vec3 value) {
  return value.x == value.y && value.y == value.z
             ? exact_text(value.x)
             : fmt::format("{}, {}, {}", exact_text(value.x), exact_text(value.y),
                           exact_text(value.z));
}

}  // namespace

std::string SceneWriting::new_id(const std::string& wanted) {
  std::string id = wanted;
  for (int i = 2; !ids.insert(id).second; ++i) {
    id = fmt::format("{}-{}", wanted, i);
  }
  return id;
}

ElementWriter ElementWriter::object(std::string_view tag, std::string_view type) {
  ElementWriter inner(*writing_, node_.append_child(std::string(tag).c_str()));
  if (!type.empty()) inner.set_type(type);
  return inner;
}

void ElementWriter::refer(const std::string& id, std::string_view name) {
  ElementWriter reference = object("ref");
  if (!name.empty()) reference.attribute("name", name);
  reference.set_id(id);
}

void ElementWriter::attribute(const char* name, std::string_view text) {
  node_.append_attribute(name).set_value(std::string(text).c_str());
}

pugi::xml_node ElementWriter::property(std::string_view tag, std::string_view name,
                                       std::string_view text) {
  ElementWriter child = object(tag);
  child.attribute("name", name);
  if (!text.empty()) child.attribute("value", text);
  return child.node_;
}

void ElementWriter::number(std::string_view name, float value) {
  property("float", name, exact_text(value));
}

void ElementWriter::integer(std::string_view name, int value) {
  property("integer", name, std::to_string(value));
}

void ElementWriter::boolean(std::string_view name, bool value) {
  property("boolean", name, value ? "true" : "false");
}

void ElementWriter::text(std::string_view name, std::string_view value) {
  property("string", name, value);
}

void ElementWriter::point(std::string_view name, glm::vec3 value) {
  ElementWriter point(*writing_, property("point", name, {}));
  point.attribute("x", exact_text(value.x));
  point.attribute("y", exact_text(value.y));
  point.attribute("z", exact_text(value.z));
}

void ElementWriter::color(std::string_view name, glm::vec3 value) {
  property("rgb", name, color_numbers(value));
}

void ElementWriter::color(std::string_view name, const Color& value) {
  if (!value.is_textured()) return color(name, value.value);
  const std::size_t index = std::size_t(value.texture);
  std::string& id = writing_->texture_ids[index];
  if (!id.empty()) return refer(id, name);
  id = writing_->new_id(fmt::format("texture-{}", index + 1));
  ElementWriter texture = object("texture");
  texture.attribute("name", name);
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        texture.set_type(Kind::name);
        texture.set_id(id);
        kind.write(texture);
      },
      writing_->scene.textures[index]);
}

void ElementWriter::transform(std::string_view name, const glm::dmat4& value) {
  std::vector<double> numbers;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) numbers.push_back(value[column][row]);
  }
  ElementWriter matrix = ElementWriter(*writing_, property("transform", name, {})).object("matrix");
  matrix.attribute("value", fmt::format("{}", fmt::join(numbers, " ")));
}

void ElementWriter::transform(std::string_view name, const glm::mat3& value) {
  std::vector<std::string> numbers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) numbers.push_back(exact_text(value[column][row]));
  }
  ElementWriter matrix = ElementWriter(*writing_, property("transform", name, {})).object("matrix");
  matrix.attribute("value", fmt::format("{}", fmt::join(numbers, " ")));
}

}  // namespace quartet
