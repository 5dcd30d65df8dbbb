#include "renderer/scene/xml/refractive_index.h"

#include <array>

namespace quartet {
namespace {

// Hecht, Optics, 4th edition, as listed in the documentation of Mitsuba's dielectric.
constexpr std::array dielectrics = {
    NamedDielectric{"vacuum", 1.0f},
    NamedDielectric{"helium", 1.000036f},
    NamedDielectric{"hydrogen", 1.000132f},
    NamedDielectric{"air", 1.000277f},
    NamedDielectric{"carbon dioxide", 1.00045f},
    NamedDielectric{"water ice", 1.31f},
    NamedDielectric{"water", 1.333f},
    NamedDielectric{"acetone", 1.36f},
    NamedDielectric{"ethanol", 1.361f},
    NamedDielectric{"fused quartz", 1.458f},
    NamedDielectric{"carbon tetrachloride", 1.461f},
    NamedDielectric{"pyrex", 1.47f},
    NamedDielectric{"glycerol", 1.4729f},
    NamedDielectric{"acrylic glass", 1.49f},
    NamedDielectric{"polypropylene", 1.49f},
    NamedDielectric{"benzene", 1.501f},
    NamedDielectric{"bk7", 1.5046f},
    NamedDielectric{"silicone oil", 1.52045f},
    NamedDielectric{"sodium chloride", 1.544f},
    NamedDielectric{"amber", 1.55f},
    NamedDielectric{"pet", 1.575f},
    NamedDielectric{"bromine", 1.661f},
    NamedDielectric{"diamond", 2.419f},
};

// Measured spectra (Palik, Handbook of Optical Constants of Solids; the SOPRA database; the files
// that Mitsuba ships) integrated against the CIE 1931 matching functions and converted to Rec. 709,
// in the values published with the Tungsten renderer. The public scenes use the same numbers.
constexpr std::array conductors = {
    // Not a metal: reflects everything, at every angle.
    NamedConductor{"none", {0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}},
    NamedConductor{"a-C", {2.944100f, 2.227150f, 1.968167f}, {0.887433f, 0.799322f, 0.815286f}},
    NamedConductor{"Ag", {0.155265f, 0.116723f, 0.138381f}, {4.828343f, 3.122246f, 2.146950f}},
    NamedConductor{"Al", {1.657460f, 0.880369f, 0.521229f}, {9.223869f, 6.269523f, 4.837001f}},
    NamedConductor{"Au", {0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}},
    NamedConductor{"Be", {4.185059f, 3.185060f, 2.784091f}, {3.835440f, 3.010126f, 2.869009f}},
    NamedConductor{"Cr", {4.369683f, 2.916702f, 1.654701f}, {5.206434f, 4.231365f, 3.754947f}},
    NamedConductor{"Cu", {0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}},
    NamedConductor{"Cu2O", {3.549283f, 2.952062f, 2.736920f}, {0.113218f, 0.194666f, 0.600168f}},
    NamedConductor{"CuO", {3.245382f, 2.449629f, 2.197411f}, {0.520274f, 0.570737f, 0.717225f}},
    NamedConductor{"Hg", {2.398931f, 1.440025f, 0.909551f}, {6.327627f, 4.371941f, 3.421790f}},
    NamedConductor{"Ir", {3.086410f, 2.082194f, 1.617887f}, {5.592151f, 4.067176f, 3.267261f}},
    NamedConductor{"K", {0.064049f, 0.046410f, 0.038184f}, {2.104216f, 1.348936f, 0.913211f}},
    NamedConductor{"Li", {0.265787f, 0.195610f, 0.220920f}, {3.540174f, 2.311131f, 1.668593f}},
    NamedConductor{"Mo", {4.483701f, 3.525458f, 2.776077f}, {4.111131f, 3.420872f, 3.150603f}},
    NamedConductor{
        "Na_palik", {0.060267f, 0.056141f, 0.061991f}, {3.179291f, 2.112480f, 1.579094f}},
    NamedConductor{"Nb", {3.420135f, 2.790192f, 2.395586f}, {3.441382f, 2.737644f, 2.579913f}},
    NamedConductor{
        "Ni_palik", {2.367275f, 1.663358f, 1.467055f}, {4.498833f, 3.050164f, 2.345427f}},
    NamedConductor{"Rh", {2.585795f, 1.860187f, 1.554428f}, {6.782293f, 4.702950f, 3.976089f}},
    NamedConductor{"Ta", {2.062585f, 2.393092f, 2.628068f}, {2.408047f, 1.741371f, 1.947038f}},
    NamedConductor{"TiN", {1.648469f, 1.150448f, 1.379780f}, {3.368460f, 1.943489f, 1.102012f}},
    NamedConductor{"V_palik", {4.277513f, 3.513154f, 2.761126f}, {3.491184f, 2.889358f, 3.111697f}},
    NamedConductor{"W", {4.370703f, 3.300297f, 2.998267f}, {3.500678f, 2.604865f, 2.273193f}},
};

template <typename Row>
std::string join_names(std::span<const Row> table) {
  std::string result;
  for (const Row& row : table) {
    if (!result.empty()) result += ", ";
    result += row.name;
  }
  return result;
}

}  // namespace

std::span<const NamedDielectric> named_dielectrics() {
  return dielectrics;
}

std::span<const NamedConductor> named_conductors() {
  return conductors;
}

std::string names(std::span<const NamedDielectric> table) {
  return join_names(table);
}

std::string names(std::span<const NamedConductor> table) {
  return join_names(table);
}

}  // namespace quartet
