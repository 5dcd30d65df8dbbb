#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace quartet {

/// A file that is to be written: its name, without a folder, and all that is in it.
struct SceneFile {
  std::string name;
  std::string text;
};

/// The scene as Mitsuba 3 XML, the first file, `stem`.xml; a mesh that is no parallelogram is an
/// OBJ file beside it, "`stem`-mesh-1.obj" and so on. load_scene() reads a scene from them whose
/// pictures are the same to the bit. Textures that nothing shows, and what stood in the scene's own
/// file beside the scene (names of parameters, comments), are left out. Not of what stands in for a
/// scene.
std::vector<SceneFile> scene_files(const Scene& scene, const std::string& stem);

}  // namespace quartet
