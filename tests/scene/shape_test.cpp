#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

std::string shape(std::string_view type, std::string_view content) {
  return std::string("<shape type=\"")
      .append(type)
      .append("\">")
      .append(content)
      .append("</shape>");
}

std::string placed(std::string_view type, std::string_view operations,
                   std::string_view content = "") {
  return shape(type, std::string("<transform name=\"to_world\">")
                         .append(operations)
                         .append("</transform>")
                         .append(content));
}

constexpr std::string_view flipped = R"(<boolean name="flip_normals" value="true"/>)";
constexpr std::string_view light =
    R"(<emitter type="area"><rgb name="radiance" value="2"/></emitter>)";

TEST(Rectangle, IsTheSquareWithNormalZAndUvFromItsCorner) {
  const Scene scene = load_body(shape("rectangle", ""));
  const Mesh& mesh = mesh_of(scene);
  ASSERT_TRUE(mesh.parallelogram);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  expect_near(front(mesh, 0), {0, 0, 1});
  expect_near(front(mesh, 1), {0, 0, 1});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.uvs[i].x, 0.5f * (mesh.positions[i].x + 1.0f));
    EXPECT_EQ(mesh.uvs[i].y, 0.5f * (mesh.positions[i].y + 1.0f));
    EXPECT_EQ(mesh.positions[i].z, 0.0f);
  }
}

/// What Mesh::parallelogram promises, whatever the transform.
void expect_parallelogram(const Mesh& mesh) {
  ASSERT_TRUE(mesh.parallelogram);
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  expect_near(mesh.positions[1] + mesh.positions[3], mesh.positions[0] + mesh.positions[2]);
}

TEST(Rectangle, NormalFollowsTheInverseTranspose) {
  const auto normal = [](std::string_view operations, std::string_view content = "") {
    const Scene scene = load_body(placed("rectangle", operations, content));
    expect_parallelogram(mesh_of(scene));
    return front(mesh_of(scene));
  };
  expect_near(normal(R"(<rotate x="1" angle="-90"/>)"), {0, 1, 0});
  expect_near(normal(R"(<rotate y="1" angle="90"/>)"), {1, 0, 0});
  // Mirroring within the plane leaves the normal, mirroring across it turns it.
  expect_near(normal(R"(<scale x="-2"/>)"), {0, 0, 1});
  expect_near(normal(R"(<scale y="-2" x="3"/>)"), {0, 0, 1});
  expect_near(normal(R"(<scale z="-1"/>)"), {0, 0, -1});
  expect_near(normal(R"(<scale z="-1" x="-1"/>)"), {0, 0, -1});
  expect_near(normal("", flipped), {0, 0, -1});
  expect_near(normal(R"(<scale x="-1"/>)", flipped), {0, 0, -1});
}

TEST(Rectangle, MirroringKeepsUvOnItsCorners) {
  const Scene scene = load_body(placed("rectangle", R"(<scale x="-3"/>)"));
  const Mesh& mesh = mesh_of(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.uvs[i].x, 0.5f * (mesh.positions[i].x / -3.0f + 1.0f));
  }
}

TEST(Cube, FacesOutwardAlsoMirroredAndInwardFlipped) {
  const auto outward = [](std::string_view operations, std::string_view content = "") {
    const Scene scene = load_body(placed("cube", operations, content));
    const Mesh& mesh = mesh_of(scene);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    int sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      sum += glm::dot(front(mesh, i), mesh.positions[mesh.triangles[i].x]) > 0.0f ? 1 : -1;
    }
    return sum;
  };
  EXPECT_EQ(outward(""), 12);
  EXPECT_EQ(outward(R"(<scale x="-1"/>)"), 12);
  EXPECT_EQ(outward(R"(<scale value="-2"/>)"), 12);
  EXPECT_EQ(outward("", flipped), -12);
  EXPECT_EQ(outward(R"(<rotate x="1" y="2" angle="33"/>)"), 12);
}

TEST(Cube, EachFaceHasTheWholeUvSquare) {
  const Scene scene = load_body(shape("cube", ""));
  const Mesh& mesh = mesh_of(scene);
  ASSERT_EQ(mesh.uvs.size(), 24u);
  for (std::size_t i = 0; i < 24; i += 4) {
    glm::vec2 sum(0.0f);
    for (std::size_t j = i; j < i + 4; ++j) sum += mesh.uvs[j];
    EXPECT_EQ(sum, glm::vec2(2.0f, 2.0f));
    EXPECT_EQ(mesh.uvs[i], glm::vec2(0.0f, 0.0f));
  }
  // From Mitsuba's table: on the face z = 1, u runs along y and v along x.
  for (std::size_t i = 0; i < 24; ++i) {
    const glm::uvec3 face = mesh.triangles[i / 4 * 2];
    if (front(mesh, i / 4 * 2).z < 0.9f) continue;
    EXPECT_EQ(mesh.uvs[i].x, 0.5f * (mesh.positions[i].y + 1.0f)) << face.x;
    EXPECT_EQ(mesh.uvs[i].y, 0.5f * (mesh.positions[i].x + 1.0f));
  }
}

/// Mitsuba's sphere uv of a unit direction.
glm::vec2 sphere_uv(const Sphere& sphere, const glm::vec3& direction) {
  const glm::vec3 local = sphere.to_local * direction;
  EXPECT_NEAR(glm::length(local), 1.0f, 1e-5f);
  const float phi = std::atan2(local.y, local.x);
  return {(phi < 0.0f ? phi + glm::two_pi<float>() : phi) / glm::two_pi<float>(),
          std::acos(glm::clamp(local.z, -1.0f, 1.0f)) / glm::pi<float>()};
}

TEST(Sphere, CenterRadiusAndTransform) {
  const Scene scene = load_body(
      placed("sphere", R"(<scale value="2"/><translate x="10"/>)",
             R"(<point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>)"));
  const auto& sphere = std::get<Sphere>(scene.shapes[0].geometry);
  expect_near(sphere.center, {12, 4, 6});
  EXPECT_FLOAT_EQ(sphere.radius, 1.0f);
  EXPECT_FALSE(sphere.flip_normals);
}

TEST(Sphere, UvTurnsWithTheSphere) {
  const Scene scene =
      load_body(placed("sphere", R"(<scale value="3"/><rotate x="1" angle="-90"/>)"));
  const auto& sphere = std::get<Sphere>(scene.shapes[0].geometry);
  // The rotation takes the pole +z to +y and the quarter +y to -z.
  EXPECT_NEAR(sphere_uv(sphere, {0, 1, 0}).y, 0.0f, 1e-3f);
  EXPECT_NEAR(sphere_uv(sphere, {1, 0, 0}).x, 0.0f, 1e-5f);
  EXPECT_NEAR(sphere_uv(sphere, {0, 0, -1}).x, 0.25f, 1e-5f);
  EXPECT_NEAR(sphere_uv(sphere, {0, 0, 1}).x, 0.75f, 1e-5f);
}

TEST(Sphere, MirroringExchangesInsideAndOutsideAsInMitsuba) {
  const auto inside = [](std::string_view operations, std::string_view content = "") {
    const Scene scene = load_body(placed("sphere", operations, content));
    return std::get<Sphere>(scene.shapes[0].geometry).flip_normals;
  };
  EXPECT_FALSE(inside(""));
  EXPECT_TRUE(inside("", flipped));
  EXPECT_TRUE(inside(R"(<scale x="-1"/>)"));
  EXPECT_FALSE(inside(R"(<scale x="-1"/>)", flipped));
  EXPECT_FALSE(inside(R"(<scale x="-1" y="-1"/>)"));
  // The negative radius takes the sign, which leaves a rotation: half a turn about x.
  const Scene scene = load_body(placed("sphere", R"(<scale x="-1"/>)"));
  const auto& sphere = std::get<Sphere>(scene.shapes[0].geometry);
  expect_near(sphere.to_local * glm::vec3(1, 2, 3), {1, -2, -3});
}

TEST(Disk, AxesNormalAndRadius) {
  const auto disk = [](std::string_view operations, std::string_view content = "") {
    const Scene scene = load_body(placed("disk", operations, content));
    return std::get<Disk>(scene.shapes[0].geometry);
  };
  const Disk plain = disk("");
  expect_near(plain.normal, {0, 0, 1});
  expect_near(plain.axis_u, {1, 0, 0});
  expect_near(plain.axis_v, {0, 1, 0});
  const Disk moved = disk(R"(<scale value="3"/><rotate x="1" angle="-90"/><translate y="5"/>)");
  expect_near(moved.center, {0, 5, 0});
  expect_near(moved.normal, {0, 1, 0});
  expect_near(moved.axis_v, {0, 0, -1});
  EXPECT_FLOAT_EQ(moved.radius, 3.0f);
  // The texture stays on the disk when only its front changes.
  const Disk turned = disk("", flipped);
  expect_near(turned.normal, {0, 0, -1});
  expect_near(turned.axis_u, {1, 0, 0});
  expect_near(turned.axis_v, {0, 1, 0});
  const Disk mirrored = disk(R"(<scale x="-1"/>)");
  expect_near(mirrored.normal, {0, 0, 1});
  expect_near(mirrored.axis_u, {-1, 0, 0});
  expect_near(disk(R"(<scale z="9"/>)").normal, {0, 0, 1});
}

TEST(Shape, SphereAndDiskMustStayRound) {
  for (const std::string_view type : {"sphere", "disk"}) {
    expect_message(error_of(placed(type, R"(<scale x="2"/>)")), 2, "scales unevenly or shears");
    expect_message(error_of(placed(type, R"(<matrix value="1 0.5 0 0 1 0 0 0 1"/>)")), 2,
                   "scales unevenly or shears");
  }
  expect_message(error_of(shape("sphere", R"(<float name="radius" value="0"/>)")), 2,
                 "radius of shape 'sphere' is 0, must be above 0");
  expect_message(error_of(shape("sphere", R"(<float name="radius" value="-1"/>)")), 2,
                 "must be above 0");
}

TEST(Shape, KeepsIdLineMaterialAndLight) {
  const Scene scene = load_body(
      "<bsdf type=\"diffuse\" id=\"paint\"/>\n"
      "<shape type=\"cube\" id=\"lamp\"><ref id=\"paint\"/>" +
      std::string(light) + "</shape>\n<shape type=\"cube\"/>");
  ASSERT_EQ(scene.shapes.size(), 2u);
  const Shape& lamp = scene.shapes[0];
  EXPECT_EQ(lamp.id, "lamp");
  EXPECT_EQ(lamp.line, 3);
  EXPECT_TRUE(lamp.emits);
  EXPECT_EQ(lamp.radiance.value, glm::vec3(2.0f));
  EXPECT_EQ(scene.materials[std::size_t(lamp.material)].id, "paint");
  EXPECT_FALSE(scene.shapes[1].emits);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Shape, UnknownTypeIsLeftOutWithOneWarning) {
  const Scene scene =
      load_body("<shape type=\"teapot\"/>\n<shape type=\"teapot\"/><shape type=\"cube\"/>");
  EXPECT_EQ(scene.shapes.size(), 1u);
  expect_one_warning(scene, 2, "shape 'teapot' is not known and left out");
}

TEST(Shape, UnknownPropertyIsWarnedAboutOnceByKind) {
  const Scene scene = load_body(R"(<shape type="cube">
<float name="bevel" value="1"/>
</shape>
<shape type="cube"><float name="bevel" value="2"/><medium name="interior" type="air"/></shape>)");
  EXPECT_EQ(scene.shapes.size(), 2u);
  ASSERT_EQ(scene.warnings.size(), 2u);
  expect_message(scene.warnings[0], 3, "property 'bevel' of shape 'cube'");
  expect_message(scene.warnings[1], 5, "property 'interior' of shape 'cube'");
}

TEST(Light, UnknownKindsAreLeftOut) {
  const Scene scene = load_body(R"(<emitter type="sun"/>
<shape type="cube"><emitter type="spotty"/></shape>)");
  EXPECT_FALSE(scene.shapes[0].emits);
  ASSERT_EQ(scene.warnings.size(), 2u);
  expect_message(scene.warnings[0], 2, "emitter 'sun' is not known outside a shape");
  expect_message(scene.warnings[1], 3, "emitter 'spotty' is not known in a shape");
}

TEST(Light, ConstantFillsTheEnvironment) {
  const Scene scene = load_text("<scene version=\"3.0.0\">" + std::string(sensor) +
                                R"(<emitter type="constant"><rgb name="radiance" value="1 2 3"/>
                                <float name="sampling_weight" value="2"/></emitter></scene>)");
  EXPECT_EQ(std::get<ConstantEnvironment>(scene.environment).radiance, glm::vec3(1, 2, 3));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Light, PointByPositionOrTransform) {
  const Scene scene = load_body(R"(<emitter type="point"><point name="position" x="1" y="2" z="3"/>
<rgb name="intensity" value="4, 5, 6"/></emitter>
<emitter type="point"><transform name="to_world"><translate x="7"/></transform></emitter>)");
  ASSERT_EQ(scene.delta_lights.size(), 2u);
  const auto& by_position = std::get<PointLight>(scene.delta_lights[0]);
  EXPECT_EQ(by_position.position, glm::vec3(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(by_position.intensity, glm::vec3(4.0f, 5.0f, 6.0f));
  const auto& by_transform = std::get<PointLight>(scene.delta_lights[1]);
  EXPECT_EQ(by_transform.position, glm::vec3(7.0f, 0.0f, 0.0f));
  EXPECT_EQ(by_transform.intensity, glm::vec3(1.0f));
  const Scene dark =
      load_body(R"(<emitter type="point"><rgb name="intensity" value="0"/></emitter>)");
  expect_one_warning(dark, 2, "intensity 0 is left out");
  EXPECT_TRUE(dark.delta_lights.empty());
}

TEST(Light, ReferencedEmitterAndTexturedRadiance) {
  const Scene scene = load_body(R"(<shape type="rectangle"><ref id="lamp"/></shape>
<emitter type="area" id="lamp"><texture name="radiance" type="checkerboard">
<rgb name="color0" value="5"/><rgb name="color1" value="0"/></texture></emitter>)");
  const Shape& lamp = scene.shapes[0];
  EXPECT_TRUE(lamp.emits);
  ASSERT_EQ(lamp.radiance.texture, 0);
  EXPECT_EQ(std::get<Checkerboard>(scene.textures[0]).color0, glm::vec3(5.0f));
}

TEST(Light, Errors) {
  expect_message(error_of(shape("cube", std::string(light) + std::string(light))), 2,
                 "two emitters");
  expect_message(error_of("<emitter type=\"constant\"/>"), 3, "at most one");
  expect_message(error_of("<emitter type=\"point\"><point name=\"position\" x=\"1\"/>"
                          "<transform name=\"to_world\"/></emitter>"),
                 2, "expected one of them");
  expect_message(error_of(shape("cube", R"(<emitter type="area">
<rgb name="radiance" value="1 -1 1"/></emitter>)")),
                 3, "radiance of emitter 'area' is negative");
  expect_message(error_of(placed("rectangle", R"(<scale x="0"/>)", light)), 2,
                 "cannot be inverted");
}

}  // namespace
}  // namespace quartet::test
