#pragma once

#include "renderer/study/needs/parts.h"

namespace quartet {

// Each is what its file ends in.
extern const Part depth_part;
extern const Part next_event_part;
extern const Part roulette_part;
extern const Part light_part;
extern const Part texture_part;
extern const Part gloss_part;
extern const Part lens_part;
extern const Part normals_part;

/// What people call a shape: its id, or its place in the file.
std::string shape_label(const Scene& scene, std::size_t shape);
/// What people call a material: its id, or that of the first shape that is made of it.
std::string material_label(const Scene& scene, std::size_t material);

}  // namespace quartet
