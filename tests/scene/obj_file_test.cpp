#include "renderer/scene/mesh/obj_file.h"

#include <fmt/format.h>

#include "renderer/base/cancel.h"
#include "renderer/scene/mesh/mesh.h"
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

TEST(Obj, AByteOrderMarkAndOddLinesChangeNothing) {
  const Loaded loaded;
  const Mesh right = mesh_of(loaded.load(std::string(quad) + "f 1 2 3 4\n", flat));
  for (const std::string& text :
       {"\xef\xbb\xbf" + std::string(quad) + "f 1 2 3 4\n",
        std::string("v 0 0 0\r\nv 2 0 0\r\nv 2 1 0\r\nv 0 1 0\r\nf 1 2 3 4"),
        std::string("v 0 0 0\rv 2 0 0\rv 2 1 0\rv 0 1 0\rf 1 2 3 4\r"),
        std::string("  v 0 0\\\n0\nv\t2 0 0 # corner\nv +2 1e0 0.\nv 0 1 0 1\n\nf 1 2\\\n 3 4")}) {
    const Scene scene = loaded.load(text, flat);
    EXPECT_EQ(mesh_of(scene).positions, right.positions);
    EXPECT_EQ(mesh_of(scene).triangles, right.triangles);
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(Obj, AFaceThatIsNotConvexKeepsItsOpening) {
  // A wall with a way through it, of which a fan from the first corner would make a wall.
  const Scene scene = Loaded().load(
      "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 2 2 0\nv 2 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nf 1 2 3 4 5 6 7 8\n",
      flat);
  EXPECT_EQ(surface_area(scene.shapes[0]), 7.0);
  EXPECT_EQ(mesh_of(scene).triangles.size(), 6u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Obj, WhatIsLeftOutIsToldWithItsLine) {
  const Loaded loaded;
  expect_one_warning(loaded.load(std::string(quad) + "f 1 2 3\nl 1 2\np 1\n", flat), 2,
                     "mesh.obj: 2 lines that are no faces of flat surfaces are left out (the "
                     "first: 'l' in line 6)");
  expect_one_warning(loaded.load(std::string(quad) + "f 1 2 3\nf 1 2\n", flat), 2,
                     "1 faces of fewer than 3 corners are left out (the first in line 6)");
  expect_one_warning(loaded.load(std::string(quad) + "f 1 3 2 4\n", flat), 2,
                     "1 faces cross themselves or enclose nothing and are cut as their corners "
                     "come (the first in line 5)");
}

TEST(Obj, EveryNumberIsCheckedWhereverItStands) {
  const Loaded loaded;
  const std::string good = std::string(quad) + "f 1 2 3\n";
  for (const std::string line :
       {"v 1,5 0 0", "v 0 0 0x10", "v 0 0 0 1.0.0", "v 0 0 0 1 1 nan", "v 0 0 1e39", "vt 0 0 x",
        "vt 0,5 0,5", "vt inf 0", "vn 0 0 -", "vn 0 0 +-1", "v 0 0 1e400", "v 0 0 \xc2\xbd",
        "vn 0 0 1\x1b[2J"}) {
    const std::string message = loaded.error(good + line + "\n");
    EXPECT_NE(message.find("mesh.obj:6: '"), std::string::npos) << message;
    EXPECT_NE(message.find("' is not a finite number"), std::string::npos) << message;
    EXPECT_EQ(message.find('\x1b'), std::string::npos) << message;
  }
  EXPECT_NE(loaded.error(good + "v 0 0 0 1 1 1 1 1\n").find("'v' has 8 numbers, expected 3 to 7"),
            std::string::npos);
  EXPECT_NE(loaded.error(good + "vn 0 0 1 0\n").find("'vn' has 4 numbers, expected 3"),
            std::string::npos);
  EXPECT_NE(loaded.error(good + "vt 1\n").find("'vt' has 1 numbers, expected 2 to 3"),
            std::string::npos);
}

TEST(Obj, EveryIndexIsCheckedWhereverItStands) {
  const Loaded loaded;
  const std::string good = std::string(quad) + "vt 0 0\nvn 0 0 1\nf 1 2 3\n";
  for (const std::string word :
       {"0", "1.5", "x", "1/", "1/0", "1//", "1/1/", "1/1/1/1", "/1", "1e0", "+1", "99999999999",
        "-99999999999", "1,2", "1/x/1", "1//1/"}) {
    const std::string message = loaded.error(good + fmt::format("f 2 3 {}\n", word));
    EXPECT_NE(message.find(fmt::format("mesh.obj:8: '{}' is no corner of a face", word)),
              std::string::npos)
        << message;
  }
  const auto expect_missing = [&](std::string_view word, std::string_view what) {
    const std::string message = loaded.error(good + "f 1 2 " + std::string(word) + "\n");
    EXPECT_NE(message.find("mesh.obj:8: a face uses " + std::string(what)), std::string::npos)
        << message;
  };
  expect_missing("5", "vertex 5, the file has 4");
  expect_missing("1/2", "uv 2, the file has 1");
  expect_missing("1//2", "normal 2, the file has 1");
  expect_missing("2147483647", "vertex 2147483647, the file has 4");
  expect_missing("-5", "vertex -5, there are 4 above it");
  expect_missing("1/-2", "uv -2, there are 1 above it");
  expect_missing("1/1/-2147483648", "normal -2147483648, there are 1 above it");
  // A corner may stand below the face that uses it.
  EXPECT_NO_THROW(loaded.load("f 1 2 3\n" + std::string(quad)));
}

TEST(Obj, TrianglesTooSmallForSinglePrecisionAreLeftOut) {
  const Scene scene =
      Loaded().load(std::string(quad) + "v 1e-17 0 0\nv 0 1e-17 0\nf 1 2 3\nf 1 5 6\n", flat);
  EXPECT_EQ(mesh_of(scene).triangles.size(), 1u);
  expect_one_warning(scene, 2, "1 triangles without area");
}

TEST(Obj, CanBeCancelled) {
  const TemporaryFolder folder;
  std::string text = std::string(quad);
  for (int i = 0; i < 10'000; ++i) text += "f 1 2 3\n";
  const std::filesystem::path path = folder.write("mesh.obj", text);
  std::stop_source stop;
  EXPECT_EQ(read_obj(path, stop.get_token()).mesh.triangles.size(), 10'000u);
  stop.request_stop();
  EXPECT_THROW(read_obj(path, stop.get_token()), Cancelled);
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
                 "mesh.obj:4: a face uses vertex 9, the file has 3");
  expect_message(loaded.error("v 0 0 0\nv 1 0 0\nv 1 1 0\n"), 2,
                 "mesh mesh.obj has no triangles with an area");
  expect_message(loaded.error("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", mesh_light), 2,
                 "no triangles with an area");
  expect_message(loaded.error("v 0 0 0\nv 1e20 0 0\nv 1 1 0\nf 1 2 3\n",
                              R"(<transform name="to_world"><scale x="1e20"/></transform>)"),
                 2, "too far out");
  expect_message(error_of("<shape type=\"obj\">\n<string name=\"filename\" value=\"no.obj\"/>"
                          "</shape>"),
                 3, "cannot read no.obj: ");
  expect_message(error_of("<shape type=\"obj\"/>"), 2, "has no filename");
}

}  // namespace
}  // namespace quartet::test
