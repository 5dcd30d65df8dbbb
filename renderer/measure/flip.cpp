#include "renderer/measure/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

#include "renderer/base/parallel.h"

namespace quartet {

namespace {

constexpr double pixels_per_degree = 0.7 * 3840.0 / 0.7 * std::numbers::pi / 180.0;

// ---- Colour spaces -----------------------------------------------------------------------------

/// Rec. 709 to CIE XYZ over that of white, so that white is (1, 1, 1). The rows of the paper's
/// matrix add up to white.
const glm::dmat3& to_relative_xyz() {
  static const glm::dmat3 matrix = [] {
    const glm::dvec3 white(23359437.0 / 24577794.0, 1.0, 80288307.0 / 73733382.0);
    const glm::dmat3 rows(glm::dvec3(10135552.0, 8788810.0, 4435075.0) / 24577794.0 / white.x,
                          glm::dvec3(2613072.0, 8788810.0, 887015.0) / 12288897.0,
                          glm::dvec3(1425312.0, 8788810.0, 70074185.0) / 73733382.0 / white.z);
    return glm::transpose(rows);
  }();
  return matrix;
}

/// The lightness L* of a relative luminance, up to its scale and offset.
float lab_curve(float t) {
  constexpr float delta = 6.0f / 29.0f;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

/// CIELab with the Hunt effect: colours of dark things are less colourful.
glm::vec3 hunt_lab(glm::vec3 relative_xyz) {
  const glm::vec3 f(lab_curve(relative_xyz.x), lab_curve(relative_xyz.y),
                    lab_curve(relative_xyz.z));
  const float lightness = 116.0f * f.y - 16.0f;
  const float hunt = 0.01f * lightness;
  return {lightness, hunt * 500.0f * (f.x - f.y), hunt * 200.0f * (f.y - f.z)};
}

float color_distance(glm::vec3 lab1, glm::vec3 lab2) {
  const glm::vec3 d = lab1 - lab2;
  return std::pow(std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z), 0.7f);  // HyAB
}

/// color_distance to [0, 1]: most of that range is for small differences.
class ColorError {
 public:
  ColorError() {
    const glm::mat3 xyz(to_relative_xyz());
    largest_ = color_distance(hunt_lab(xyz * glm::vec3(0.0f, 1.0f, 0.0f)),
                              hunt_lab(xyz * glm::vec3(0.0f, 0.0f, 1.0f)));
  }
  float operator()(glm::vec3 lab1, glm::vec3 lab2) const {
    constexpr float knee = 0.4f;
    constexpr float knee_value = 0.95f;
    const float t = color_distance(lab1, lab2) / largest_;
    return t < knee ? t * knee_value / knee
                    : std::min(1.0f, knee_value + (t - knee) / (1.0f - knee) * (1.0f - knee_value));
  }

 private:
  float largest_;
};

// ---- Separable filters -------------------------------------------------------------------------

using Plane = std::vector<float>;

struct Size {
  int width, height;
  std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
};

/// What a filter makes of the pixels i steps behind and ahead, for the weight of that distance. The
/// last two are exactly 0 where the picture is flat; the square root that is later taken of them
/// would make much of a rounding error.
enum class KernelShape {
  smooth,  ///< weight 0 times the pixel itself, plus both neighbours
  edge,    ///< what is ahead minus what is behind
  point,   ///< both neighbours less the pixel itself: weights that sum up to 0
};

/// A filter along one axis: weights of the pixel itself and of its neighbours by distance.
struct Kernel {
  KernelShape shape;
  std::vector<float> weights;
  int radius() const { return int(weights.size()) - 1; }
};

enum class FilterAxis { x, y };

/// One row of output: `at(i)` are the pixels i steps along the axis.
template <KernelShape shape, class At>
void filter_row(const Kernel& kernel, int width, const At& at, float* out) {
  const float* const here = at(0);
  for (int x = 0; x < width; ++x) {
    out[x] = shape == KernelShape::smooth ? kernel.weights[0] * here[x] : 0.0f;
  }
  for (int i = 1; i <= kernel.radius(); ++i) {
    const float weight = kernel.weights[std::size_t(i)];
    const float* const ahead = at(i);
    const float* const behind = at(-i);
    for (int x = 0; x < width; ++x) {
      const float value = shape == KernelShape::smooth ? ahead[x] + behind[x]
                          : shape == KernelShape::edge
                              ? ahead[x] - behind[x]
                              : (ahead[x] - here[x]) + (behind[x] - here[x]);
      out[x] += weight * value;
    }
  }
}

template <class At>
void filter_row(const Kernel& kernel, int width, const At& at, float* out) {
  switch (kernel.shape) {
    case KernelShape::smooth:
      filter_row<KernelShape::smooth>(kernel, width, at, out);
      break;
    case KernelShape::edge:
      filter_row<KernelShape::edge>(kernel, width, at, out);
      break;
    case KernelShape::point:
      filter_row<KernelShape::point>(kernel, width, at, out);
      break;
  }
}

/// The plane filtered along an axis; beyond its border lies the border's own colour.
Plane filter(const Plane& in, Size size, FilterAxis axis, const Kernel& kernel) {
  Plane out(in.size());
  const int width = size.width;
  const auto row = [&](int y) {
    return in.data() + std::size_t(std::clamp(y, 0, size.height - 1)) * std::size_t(width);
  };
  parallel_for(std::size_t(size.height), 8, [&](std::size_t begin, std::size_t end) {
    const int radius = kernel.radius();
    Plane padded(std::size_t(width + 2 * radius));
    for (int y = int(begin); y < int(end); ++y) {
      float* const to = out.data() + std::size_t(y) * std::size_t(width);
      if (axis == FilterAxis::y) {
        filter_row(
            kernel, width, [&](int i) { return row(y + i); }, to);
        continue;
      }
      const float* const from = row(y);
      std::fill_n(padded.begin(), radius, from[0]);
      std::copy_n(from, width, padded.begin() + radius);
      std::fill_n(padded.end() - radius, radius, from[width - 1]);
      filter_row(
          kernel, width, [&](int i) { return padded.data() + radius + i; }, to);
    }
  });
  return out;
}

Plane smooth(const Plane& in, Size size, const Kernel& kernel) {
  return filter(filter(in, size, FilterAxis::x, kernel), size, FilterAxis::y, kernel);
}

// ---- What the eye resolves ---------------------------------------------------------------------

/// exp(−distance² / spread) at the distances 0, 1, …, radius pixels.
std::vector<double> bell(double spread, int radius) {
  std::vector<double> values;
  for (int i = 0; i <= radius; ++i) {
    values.push_back(std::exp(-i * i / spread));
  }
  return values;
}

/// Of a symmetric kernel.
double sum_of(const std::vector<double>& values) {
  return 2.0 * std::accumulate(values.begin() + 1, values.end(), 0.0) + values[0];
}

Kernel smooth_kernel(const std::vector<double>& values) {
  const double sum = sum_of(values);
  Kernel kernel{KernelShape::smooth, {}};
  for (const double value : values) {
    kernel.weights.push_back(float(value / sum));
  }
  return kernel;
}

/// A contrast sensitivity a1 √(π/b1) e^(−π² d²/b1) + a2 √(π/b2) e^(−π² d²/b2), d in degrees, as the
/// sum of two separable kernels with the shares that each has of the whole.
struct Sensitivity {
  std::array<Kernel, 2> kernels;
  std::array<float, 2> shares;
};

Sensitivity sensitivity(double a1, double b1, double a2, double b2) {
  constexpr double widest = 0.04;  // the largest b
  const int radius = int(std::ceil(
      3.0 * std::sqrt(widest / (2.0 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
  Sensitivity result;
  std::array<double, 2> sums{};
  const std::array<double, 2> heights{a1 * std::sqrt(std::numbers::pi / b1),
                                      a2 * std::sqrt(std::numbers::pi / b2)};
  const std::array<double, 2> widths{b1, b2};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto values = bell(
        widths[i] * pixels_per_degree * pixels_per_degree / (std::numbers::pi * std::numbers::pi),
        radius);
    result.kernels[i] = smooth_kernel(values);
    sums[i] = heights[i] * sum_of(values) * sum_of(values);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    result.shares[i] = float(sums[i] / (sums[0] + sums[1]));
  }
  return result;
}

Plane blurred(const Plane& in, Size size, const Sensitivity& sensitivity) {
  Plane result = smooth(in, size, sensitivity.kernels[0]);
  if (sensitivity.shares[1] == 0.0f) {
    return result;
  }
  const Plane second = smooth(in, size, sensitivity.kernels[1]);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = sensitivity.shares[0] * result[i] + sensitivity.shares[1] * second[i];
  }
  return result;
}

/// Derivatives of a Gaussian: of first order for edges, of second for points; the positive weights
/// add up to 1 and the negative ones to −1. `gaussian` smooths across them.
struct FeatureKernels {
  Kernel gaussian, edge, point;
};

FeatureKernels feature_kernels() {
  const double sd = 0.5 * 0.082 * pixels_per_degree;
  const int radius = int(std::ceil(3.0 * sd));
  const std::vector<double> values = bell(2.0 * sd * sd, radius);
  std::vector<double> edge;
  std::vector<double> point;
  double edge_sum = 0.0;
  double positive = 0.0;
  double negative = 0.0;
  for (int i = 0; i <= radius; ++i) {
    const double value = values[std::size_t(i)];
    edge.push_back(i * value);
    edge_sum += edge.back();
    point.push_back((i * i / (sd * sd) - 1.0) * value);
    (point.back() > 0.0 ? positive : negative) += (i == 0 ? 1.0 : 2.0) * std::abs(point.back());
  }
  FeatureKernels kernels{smooth_kernel(values), {KernelShape::edge, {}}, {KernelShape::point, {}}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    kernels.edge.weights.push_back(float(edge[i] / edge_sum));
    kernels.point.weights.push_back(float(point[i] / (point[i] > 0.0 ? positive : negative)));
  }
  return kernels;
}

/// What is compared of a picture: planes of Hunt-adjusted CIELab as the eye resolves it, and how
/// strong edges and points are.
struct Percept {
  std::vector<glm::vec3> lab;
  Plane edges, points;
};

Plane magnitude(const Plane& x, const Plane& y) {
  Plane result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    result[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
  }
  return result;
}

Percept percept(const RadianceImage& image) {
  static const Sensitivity achromatic = sensitivity(1.0, 0.0047, 0.0, 1e-5);
  static const Sensitivity red_green = sensitivity(1.0, 0.0053, 0.0, 1e-5);
  static const Sensitivity blue_yellow = sensitivity(34.1, 0.04, 13.5, 0.025);
  static const FeatureKernels features = feature_kernels();
  const glm::mat3 to_xyz(to_relative_xyz());
  const glm::mat3 to_rgb(glm::inverse(to_relative_xyz()));
  const Size size{image.width(), image.height()};

  // YCxCz without its scales and offset, which are undone before anything but sums is made of it:
  // y, x − y, y − z. The first is also (Y + 16)/116, on which features are looked for.
  std::array<Plane, 3> opponent;
  opponent.fill(Plane(size.pixels()));
  for (std::size_t i = 0; i < size.pixels(); ++i) {
    const glm::vec3 xyz = to_xyz * glm::clamp(image.pixels()[i], 0.0f, 1.0f);
    opponent[0][i] = xyz.y;
    opponent[1][i] = xyz.x - xyz.y;
    opponent[2][i] = xyz.y - xyz.z;
  }
  const Plane down = filter(opponent[0], size, FilterAxis::y, features.gaussian);
  const Plane across = filter(opponent[0], size, FilterAxis::x, features.gaussian);
  Percept result;
  result.edges = magnitude(filter(down, size, FilterAxis::x, features.edge),
                           filter(across, size, FilterAxis::y, features.edge));
  result.points = magnitude(filter(down, size, FilterAxis::x, features.point),
                            filter(across, size, FilterAxis::y, features.point));

  const Plane y = blurred(opponent[0], size, achromatic);
  const Plane x_less_y = blurred(opponent[1], size, red_green);
  const Plane y_less_z = blurred(opponent[2], size, blue_yellow);
  result.lab.resize(size.pixels());
  parallel_for(size.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::vec3 xyz(y[i] + x_less_y[i], y[i], y[i] - y_less_z[i]);
      result.lab[i] = hunt_lab(to_xyz * glm::clamp(to_rgb * xyz, 0.0f, 1.0f));
    }
  });
  return result;
}

}  // namespace

ScalarImage flip_map(const RadianceImage& test, const RadianceImage& reference) {
  assert(test.width() == reference.width() && test.height() == reference.height());
  static const ColorError color_error;
  const Percept a = percept(test);
  const Percept b = percept(reference);
  ScalarImage map(test.width(), test.height());
  parallel_for(map.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float feature =
          std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
      const float feature_error = std::sqrt(feature / std::numbers::sqrt2_v<float>);
      map.pixels()[i] = std::pow(color_error(a.lab[i], b.lab[i]), 1.0f - feature_error);
    }
  });
  return map;
}

double flip(const RadianceImage& test, const RadianceImage& reference) {
  const ScalarImage map = flip_map(test, reference);
  return std::accumulate(map.pixels().begin(), map.pixels().end(), 0.0) / double(map.size());
}

}  // namespace quartet
