#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "renderer/scene/materials/conductor.h"
#include "renderer/scene/materials/dielectric.h"
#include "renderer/scene/materials/diffuse.h"
#include "renderer/scene/materials/rough_conductor.h"

namespace quartet {

/// The kinds of material, one file each. A kind says what it is called in scene files (name), which
/// colours it has (colors), what it is to people (text), and how it is hashed (add_to), read (read)
/// and written (write). With its colours looked up by a function (at) it becomes an AtPoint, which
/// is what paths ask: whether it reflects or transmits into single directions only (specular),
/// whether light goes through to the other side (transmits), sample(), and unless specular
/// evaluate(). One that lets no light through is asked of directions on the front only.
/// bsdf_sample.h says what they take and give; (u, v) in [0, 1)² chooses a direction.
using MaterialKind = std::variant<Diffuse, Conductor, RoughConductor, Dielectric>;

struct Material {
  MaterialKind kind;
  bool two_sided = false;  ///< reflects on the back like on the front; never one that transmits
  std::string id;          ///< as in the file, may be empty

  void add_to(Hasher& hasher) const;
};

/// As scene files call its kind.
std::string_view material_name(const Material& material);

/// "dielectric, reflectance 1, index 1.5".
std::string material_text(const Textures& textures, const Material& material);

/// Whether some colour of it depends on texture coordinates.
bool is_textured(const Material& material);

bool transmits(const Material& material);

}  // namespace quartet
