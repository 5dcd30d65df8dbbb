#include "renderer/scene/scene_hash.h"

#include <string>
#include <utility>

#include "tests/scene/scene_text.h"

namespace quartet::test {
namespace {

// References and caches know a scene by its hash: those of the first kinds of everything stay what
// they are, whatever kinds are added.

TEST(SceneHash, OfBuiltinScenesStaysWhatItWas) {
  for (const auto& [name, hash] : {std::pair{"cornell-box", "ebb35b73d808fa69"},
                                   {"cornell-checker", "9ac34575daa36927"},
                                   {"furnace", "549f35693ea04cc4"},
                                   {"thin-lens", "e0f77bb3e7dea519"},
                                   {"veach-plates", "e0d96f1b5ee9ae94"}}) {
    EXPECT_EQ(scene_hash(load_scene(find_scene(name))), hash) << name;
  }
}

TEST(SceneHash, OfEveryFirstKindStaysWhatItWas) {
  const Scene scene = load_text(R"(<scene version="3.0.0">
<sensor type="perspective"><float name="fov" value="40"/></sensor><emitter type="constant"/>
<emitter type="point"><point name="position" x="1" y="2" z="3"/>
<rgb name="intensity" value="4, 5, 6"/></emitter>
<shape type="disk"><bsdf type="roughconductor"><string name="distribution" value="ggx"/>
<float name="alpha" value="0.25"/><rgb name="eta" value="0.5"/><rgb name="k" value="2"/></bsdf></shape>
<shape type="sphere"><bsdf type="dielectric"><float name="int_ior" value="1.5"/>
<float name="ext_ior" value="1"/>
<texture name="specular_transmittance" type="checkerboard"/></bsdf></shape></scene>)");
  EXPECT_EQ(scene_hash(scene), "f455b0f03b4d838a");
}

TEST(SceneHash, DiffersForEachNumberOfAKind) {
  const auto hash_of = [](const MaterialKind& kind) {
    Scene scene;
    scene.materials.emplace_back().kind = kind;
    return scene_hash(scene);
  };
  const Color dark{glm::vec3(0.25f)};
  const std::string conductor = hash_of(Conductor{});
  EXPECT_NE(hash_of(Conductor{{.reflectance = dark}}), conductor);
  EXPECT_NE(hash_of(Conductor{{.eta = glm::vec3(0.5f)}}), conductor);
  EXPECT_NE(hash_of(Conductor{{.k = glm::vec3(0.5f)}}), conductor);
  const std::string rough = hash_of(RoughConductor{});
  EXPECT_NE(rough, conductor);
  EXPECT_NE(hash_of(RoughConductor{{.k = glm::vec3(0.5f)}}), rough);
  EXPECT_NE(hash_of(RoughConductor{{}, 0.3f}), rough);
  const std::string dielectric = hash_of(Dielectric{});
  EXPECT_NE(hash_of(Dielectric{.reflectance = dark}), dielectric);
  EXPECT_NE(hash_of(Dielectric{.transmittance = dark}), dielectric);
  EXPECT_NE(hash_of(Dielectric{.ior = 1.4f}), dielectric);
  EXPECT_NE(hash_of(Diffuse{dark}), hash_of(Diffuse{}));
}

}  // namespace
}  // namespace quartet::test
