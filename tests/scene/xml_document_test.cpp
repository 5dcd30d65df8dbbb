#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

constexpr std::string_view furnace = R"(<default name="albedo" value="0.25"/>
<shape type="cube" id="$name"><bsdf type="diffuse">
<rgb name="reflectance" value="$albedo $albedo 0.$digits"/></bsdf></shape>
<default name="name" value="box"/><default name="digits" value="75"/>)";

TEST(Parameters, DefaultsReplaceWhereverTheyStand) {
  const Scene scene = load_body(furnace);
  EXPECT_EQ(scene.shapes[0].id, "box");
  EXPECT_EQ(kind_of<Diffuse>(scene, scene.shapes[0]).reflectance.value,
            glm::vec3(0.25f, 0.25f, 0.75f));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Parameters, OverridesWin) {
  const Scene scene = load_body(furnace, {{"albedo", "0.5"}, {"name", "furnace"}});
  EXPECT_EQ(scene.shapes[0].id, "furnace");
  EXPECT_EQ(kind_of<Diffuse>(scene, scene.shapes[0]).reflectance.value,
            glm::vec3(0.5f, 0.5f, 0.75f));
}

TEST(Parameters, AnOverrideNeedsNoDefault) {
  const Scene scene = load_body(R"(<shape type="cube" id="$name"/>)", {{"name", "x"}});
  EXPECT_EQ(scene.shapes[0].id, "x");
}

TEST(Parameters, TheLongestNameWins) {
  const Scene scene = load_body(R"(<default name="a" value="1"/><default name="ab" value="2"/>
<shape type="cube" id="$ab$a"/>)");
  EXPECT_EQ(scene.shapes[0].id, "21");
}

TEST(Parameters, DefaultsMayUseEarlierOnes) {
  const Scene scene = load_body(R"(<default name="a" value="x"/><default name="b" value="y$a"/>
<shape type="cube" id="$b"/>)");
  EXPECT_EQ(scene.shapes[0].id, "yx");
}

TEST(Parameters, Errors) {
  expect_message(
      error_of("<default name=\"a\" value=\"1\"/>\n<shape type=\"cube\" id=\"$b\"/>"), 3,
      "parameter '$b' has no value; give it one with -D b=... or a <default> (defined: a)");
  const std::string unknown = error_of(furnace, {{"albeod", "0.5"}});
  EXPECT_NE(unknown.find("scene.xml: has no parameter 'albeod' (its parameters: albedo, digits, "
                         "name)"),
            std::string::npos)
      << unknown;
  const std::string none = error_of("", {{"a", "1"}});
  EXPECT_NE(none.find("(its parameters: none)"), std::string::npos) << none;
  expect_message(error_of("<default value=\"1\"/>"), 2, "needs a name");
  expect_message(error_of(furnace, {{"albedo", "much"}}), 4, "expected finite numbers");
}

TEST(XmlDocument, BrokenFiles) {
  expect_message(error_of_text("<scene version=\"3.0.0\">\n<shape type=\"cube\">\n</scene>\n"), 3,
                 "not well-formed XML");
  expect_message(error_of_text(""), 1, "not well-formed XML");
  expect_message(error_of_text("<world version=\"3.0.0\"/>"), 1,
                 "the root element is <world>, expected <scene");
  const TemporaryFolder folder;
  for (const std::filesystem::path& path : {folder.path() / "absent.xml", folder.path()}) {
    try {
      load_scene(path);
      ADD_FAILURE() << path;
    } catch (const SceneError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("cannot read " + path.string() + ": "))
          << error.what();
    }
  }
}

TEST(XmlDocument, OldDialectIsRefusedWithAWayOut) {
  expect_message(error_of_text("<scene version=\"0.5.0\"/>"), 1, "convert the file to Mitsuba 3");
  expect_message(error_of_text("<scene version=\"new\"/>"), 1, "\"new\" is not a version");
  expect_message(error_of_text("<scene/>"), 1, "expected <scene version=\"3.0.0\">");
  EXPECT_NO_THROW(
      load_text("<scene version=\"2.1.0\">" + std::string(sensor) + std::string(sky) + "</scene>"));
}

TEST(XmlDocument, LinesSurviveCommentsAndWindowsLineEnds) {
  const Scene scene = load_body("<!-- two\r\nlines -->\r\n\r\n<shape type=\"teapot\"/>");
  expect_one_warning(scene, 5, "teapot");
}

TEST(SceneFile, UnknownElementsAreLeftOut) {
  const Scene scene = load_body("<fog/>\n<fog/>");
  expect_one_warning(scene, 2, "<fog> is not known and left out");
}

TEST(SceneFile, NeedsALightAndACamera) {
  const std::string open = "<scene version=\"3.0.0\">\n";
  expect_message(error_of_text(open + std::string(sky) + "</scene>"), 1,
                 "no camera, expected <sensor");
  expect_message(error_of_text(open + std::string(sensor) + "<shape type=\"cube\"/></scene>"), 1,
                 "no light, expected an <emitter");
  expect_message(error_of_text(open + std::string(sensor) +
                               R"(<shape type="cube"><emitter type="area">
                                  <rgb name="radiance" value="0"/></emitter></shape></scene>)"),
                 1, "no light");
}

TEST(SceneFile, WrongKindsOfValues) {
  expect_message(error_of("<shape type=\"cube\">\n<boolean name=\"flip_normals\" value=\"1\"/>"
                          "</shape>"),
                 3, "flip_normals of shape 'cube' is '1', expected true or false");
  expect_message(
      error_of("<shape type=\"sphere\">\n<float name=\"radius\" value=\"1,5\"/></shape>"), 3,
      "'1,5', expected a finite number");
  expect_message(error_of("<shape type=\"sphere\">\n<point name=\"center\" x=\"q\"/></shape>"), 3,
                 "expected finite numbers");
  const Scene twice = load_body(R"(<shape type="sphere"><float name="radius" value="1"/>
<float name="radius" value="2"/></shape>)");
  expect_one_warning(twice, 3, "radius of shape 'sphere' is given twice");
  EXPECT_EQ(std::get<Sphere>(twice.shapes[0].geometry).radius, 2.0f);
}

}  // namespace
}  // namespace quartet::test
