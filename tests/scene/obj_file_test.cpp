#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

constexpr std::string_view quad = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";
constexpr std::string_view mesh_light = R"(<emitter type="area"/>)";

struct Loaded {
  TemporaryFolder folder;
  std::string body(std::string_view mesh_text, std::string_view content) const {
    folder.write("mesh.obj", mesh_text);
    return scene_text(std::string("<shape type=\"obj\">\n<string name=\"filename\" "
                                  "value=\"mesh.obj\"/>")
                          .append(content)
                          .append("</shape>"));
  }
  Scene load(std::string_view mesh_text, std::string_view content = "") const {
    return load_scene(folder.write("scene.xml", body(mesh_text, content)));
  }
  std::string error(std::string_view mesh_text, std::string_view content = "") const {
    try {
      load(mesh_text, content);
    } catch (const SceneError& error) {
      return error.what();
    }
    ADD_FAILURE() << "no SceneError";
    return {};
  }
};

constexpr std::string_view flat = R"(<boolean name="face_normals" value="true"/>)";

TEST(Obj, PolygonsBecomeTrianglesRelativeToTheSceneFile) {
  const Scene scene = Loaded().load(std::string(quad) + "f 1 2 3 4\n", flat);
  const Mesh& mesh = mesh_of(scene);
  EXPECT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_FALSE(mesh.parallelogram);
  expect_near(front(mesh, 0), {0, 0, 1});
  expect_near(front(mesh, 1), {0, 0, 1});
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Obj, NegativeIndicesAndMaterialsAreUnderstood) {
  const Scene scene = Loaded().load("mtllib none.mtl\no one\n" + std::string(quad) +
                                        "usemtl x\ng a\nf -4 -3 -2\no two\nf -4 -2 -1\n",
                                    flat);
  EXPECT_EQ(mesh_of(scene).triangles.size(), 2u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Obj, UvIsTurnedUpsideDownAsInMitsubaUnlessTold) {
  const std::string text = std::string(quad) + "vt 0 0.25\nvt 1 0.25\nvt 1 1\nf 1/1 2/2 3/3\n";
  const Loaded loaded;
  EXPECT_EQ(mesh_of(loaded.load(text)).uvs[0], glm::vec2(0.0f, 0.75f));
  EXPECT_EQ(mesh_of(loaded.load(text, R"(<boolean name="flip_tex_coords" value="false"/>)")).uvs[0],
            glm::vec2(0.0f, 0.25f));
}

TEST(Obj, VerticesWithDifferentUvAreSplit) {
  const Scene scene =
      Loaded().load(std::string(quad) + "vt 0 0\nvt 1 0\nf 1/1 2/1 3/1\nf 1/2 3/1 4/1\n");
  EXPECT_EQ(mesh_of(scene).positions.size(), 5u);
}

TEST(Obj, NormalsOfTheFileDecideTheFront) {
  // The face is clockwise seen from its normals.
  const Scene scene = Loaded().load(std::string(quad) + "vn 0 0 -1\nf 1//1 2//1 3//1\n");
  const Mesh& mesh = mesh_of(scene);
  expect_near(mesh.normals[0], {0, 0, -1});
  expect_near(front(mesh), {0, 0, -1});
}

TEST(Obj, MirroringKeepsFrontAndNormalsTogether) {
  const std::string text = std::string(quad) + "vn 0 0 2\nf 1//1 2//1 3//1\n";
  const Loaded loaded;
  const Scene scene =
      loaded.load(text, R"(<transform name="to_world"><scale x="-1"/></transform>)");
  expect_near(mesh_of(scene).normals[0], {0, 0, 1});
  expect_near(front(mesh_of(scene)), {0, 0, 1});
  const Scene flipped = loaded.load(text, R"(<boolean name="flip_normals" value="true"/>)");
  expect_near(mesh_of(flipped).normals[0], {0, 0, -1});
  expect_near(front(mesh_of(flipped)), {0, 0, -1});
}

TEST(Obj, NormalsMoveByTheInverseTranspose) {
  // The plane x + y = 0 squeezed to half its width in x becomes 2x + y = 0.
  const Scene scene = Loaded().load("v 1 -1 0\nv -1 1 0\nv 0 0 1\nvn 1 1 0\nf 1//1 2//1 3//1\n",
                                    R"(<transform name="to_world"><scale x="0.5"/></transform>)");
  expect_near(mesh_of(scene).normals[0], glm::normalize(glm::vec3(2, 1, 0)));
  EXPECT_NEAR(glm::dot(front(mesh_of(scene)), mesh_of(scene).normals[0]), 1.0f, 1e-5f);
}

TEST(Obj, MissingNormalsAreComputedSmooth) {
  // A right angle along the edge from 1 to 2: both faces have the same angles at it.
  const std::string roof = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 1 4\n";
  const Loaded loaded;
  const Scene scene = loaded.load(roof);
  const Mesh& mesh = mesh_of(scene);
  expect_near(front(mesh, 0), {0, 1, 0});
  expect_near(front(mesh, 1), {1, 0, 0});
  ASSERT_EQ(mesh.normals.size(), 4u);
  // At vertex 1 the angles are 90 and 90 degrees, at vertex 2 they are 45 and 45.
  expect_near(mesh.normals[0], glm::normalize(glm::vec3(1, 1, 0)));
  expect_near(mesh.normals[1], glm::normalize(glm::vec3(1, 1, 0)));
  expect_near(mesh.normals[2], {0, 1, 0});
  expect_near(mesh.normals[3], {1, 0, 0});
  EXPECT_TRUE(mesh_of(loaded.load(roof, flat)).normals.empty());
}

TEST(Obj, ComputedNormalsAreWeightedByAngle) {
  // At vertex 1 the two lower triangles share one right angle, as a cut square does; the upright
  // one has a right angle too. Weighted by angle, both sides count the same.
  const Scene scene =
      Loaded().load("v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\nf 2 1 5\n");
  expect_near(mesh_of(scene).normals[0], glm::normalize(glm::vec3(1, 1, 0)));
}

TEST(Obj, TextureWithoutUvShowsBarycentricOnes) {
  const Scene scene = Loaded().load(std::string(quad) + "f 1 2 3 4\n", R"(<bsdf type="diffuse">
    <texture name="reflectance" type="checkerboard"/></bsdf>)");
  const Mesh& mesh = mesh_of(scene);
  ASSERT_EQ(mesh.positions.size(), 6u);
  ASSERT_EQ(mesh.normals.size(), 6u);
  for (const glm::uvec3& triangle : mesh.triangles) {
    EXPECT_EQ(mesh.uvs[triangle.x], glm::vec2(0, 0));
    EXPECT_EQ(mesh.uvs[triangle.y], glm::vec2(1, 0));
    EXPECT_EQ(mesh.uvs[triangle.z], glm::vec2(0, 1));
  }
}

TEST(Obj, DegenerateTrianglesAreDroppedAndCounted) {
  const Scene scene =
      Loaded().load(std::string(quad) + "v 1 0 0\nf 1 2 3\nf 1 1 2\nf 1 5 2\n", flat);
  EXPECT_EQ(mesh_of(scene).triangles.size(), 1u);
  expect_one_warning(scene, 2, "2 triangles without area in mesh.obj are left out");
}

TEST(Obj, Errors) {
  const Loaded loaded;
  expect_message(loaded.error("v 0 0 0\nv nan 0 0\nv 1 1 0\nf 1 2 3\n"), 3,
                 "mesh.obj:2: 'nan' is not a finite number");
  EXPECT_NE(loaded.error("v 0 0 0\nv 1 inf 0\nv 1 1 0\nf 1 2 3\n").find("mesh.obj:2: 'inf'"),
            std::string::npos);
  EXPECT_NE(loaded.error("v 0 0\n").find("mesh.obj:1: 'v' has 2 numbers, expected 3"),
            std::string::npos);
  EXPECT_NE(loaded.error("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 x\nf 1 2 3\n").find("mesh.obj:4: 'x'"),
            std::string::npos);
  expect_message(loaded.error("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n"), 3,
                 "a face uses vertex 9, the file has 3");
  expect_message(loaded.error("v 0 0 0\nv 1 0 0\nv 1 1 0\n"), 2,
                 "mesh mesh.obj has no triangles with an area");
  expect_message(loaded.error("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", mesh_light), 2,
                 "no triangles with an area");
  expect_message(loaded.error("v 0 0 0\nv 1e20 0 0\nv 1 1 0\nf 1 2 3\n",
                              R"(<transform name="to_world"><scale x="1e20"/></transform>)"),
                 2, "too far out");
  expect_message(error_of("<shape type=\"obj\">\n<string name=\"filename\" value=\"no.obj\"/>"
                          "</shape>"),
                 3, "cannot read the mesh file no.obj");
  expect_message(error_of("<shape type=\"obj\"/>"), 2, "has no filename");
}

}  // namespace
}  // namespace quartet::test
