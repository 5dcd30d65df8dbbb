#include "renderer/scene/mesh/obj_file.h"
#include "tests/fuzz/feed.h"
#include "tests/fuzz/mesh_promises.h"

namespace quartet {

/// The input is an OBJ file.
void feed_obj(std::string_view input) {
  const std::filesystem::path path = scratch_file("mesh.obj", input);
  succeeds<std::runtime_error>("mesh.obj", [&] {
    const Mesh mesh = read_obj(path).mesh;
    promise_mesh(mesh);
    promise(!mesh.parallelogram, "a file says nothing of parallelograms");
    // A corner of a triangle takes at least two bytes, as in "f 1 2 3", of which a strip of n
    // corners makes n - 2 triangles.
    promise(mesh.triangles.size() <= input.size(), "more triangles than bytes");
  });
}

}  // namespace quartet

QUARTET_FUZZ_ENTRY(quartet::feed_obj)
