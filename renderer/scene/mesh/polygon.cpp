#include "renderer/scene/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>

#include "renderer/base/cancel.h"

namespace quartet {
namespace {

/// Twice the area of a triangle, above 0 where it turns to the left. Exact in sign for corners in
/// single precision, unless their sizes differ by more than a factor of 100 or so.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners in the plane that shows most of the polygon, where it runs to the left; none for one
/// whose mean normal is 0.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
  // Relative to a corner, or the products of large coordinates would hide a small area.
  const glm::dvec3 origin(corners[0]);
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::dvec3(corners[i]) - origin;
    const glm::dvec3 b = glm::dvec3(corners[(i + 1) % corners.size()]) - origin;
    normal += glm::cross(a, b);
  }
  const glm::dvec3 size = glm::abs(normal);
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest > 0.0)) {
    return {};
  }
  const int axis = size.x == largest ? 0 : size.y == largest ? 1 : 2;
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (normal[axis] < 0.0) {
    std::swap(u, v);
  }
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners) {
    flat.emplace_back(corner[u], corner[v]);
  }
  return flat;
}

/// Cuts along the shorter diagonal that lies inside; false if neither does.
bool cut_quad(std::span<const glm::vec3> corners, const std::vector<glm::dvec2>& p,
              std::vector<glm::uvec3>& triangles) {
  const bool first = turn(p[0], p[1], p[2]) > 0.0 && turn(p[0], p[2], p[3]) > 0.0;
  const bool second = turn(p[0], p[1], p[3]) > 0.0 && turn(p[1], p[2], p[3]) > 0.0;
  if (!first && !second) {
    return false;
  }
  const glm::vec3 across02 = corners[2] - corners[0];
  const glm::vec3 across13 = corners[3] - corners[1];
  if (first && (!second || glm::dot(across02, across02) < glm::dot(across13, across13))) {
    triangles.emplace_back(0, 1, 2);
    triangles.emplace_back(0, 2, 3);
  } else {
    triangles.emplace_back(0, 1, 3);
    triangles.emplace_back(1, 2, 3);
  }
  return true;
}

/// The corners that are not convex, by place: only they can stand in the way of an ear. A k-d tree
/// (Bentley 1975) over all corners, whose nodes count those among theirs that do.
class Blockers {
 public:
  explicit Blockers(const std::vector<glm::dvec2>& points)
      : points_(points), order_(points.size()), leaf_of_(points.size()), blocks_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, 0, order_.size());
  }

  void set(unsigned corner, bool blocks) {
    if (blocks_[corner] == blocks) {
      return;
    }
    blocks_[corner] = blocks;
    for (std::size_t node = leaf_of_[corner];; node = (node - 1) / 2) {
      nodes_[node].count += blocks ? 1u : ~0u;
      if (node == 0) {
        break;
      }
    }
  }

  /// Whether one lies in the closed triangle (a, b, c), which runs to the left. One in the very
  /// place of a corner does not count: that is how a hole is tied to the border around it.
  bool any_within(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) const { return any_within(0, a, b, c); }

 private:
  struct Node {
    glm::dvec2 low, high;
    std::size_t first, end;  // of order_
    unsigned count = 0;
    bool leaf = true;
  };

  /// Node i has the children 2 i + 1 and 2 i + 2.
  void build(std::size_t index, std::size_t first, std::size_t end) {
    if (nodes_.size() <= index) {
      nodes_.resize(index + 1);
    }
    Node node{points_[order_[first]], points_[order_[first]], first, end};
    for (std::size_t i = first; i < end; ++i) {
      node.low = glm::min(node.low, points_[order_[i]]);
      node.high = glm::max(node.high, points_[order_[i]]);
      leaf_of_[order_[i]] = index;
    }
    constexpr std::size_t leaf_size = 8;
    node.leaf = end - first <= leaf_size;
    nodes_[index] = node;
    if (node.leaf) {
      return;
    }
    const glm::dvec2 size = node.high - node.low;
    const int axis = size.x > size.y ? 0 : 1;
    const std::size_t middle = first + (end - first) / 2;
    std::nth_element(order_.begin() + std::ptrdiff_t(first),
                     order_.begin() + std::ptrdiff_t(middle), order_.begin() + std::ptrdiff_t(end),
                     [&](unsigned i, unsigned k) { return points_[i][axis] < points_[k][axis]; });
    build(2 * index + 1, first, middle);
    build(2 * index + 2, middle, end);
  }

  /// Whether all of a node lies to the right of the line from a to b.
  static bool is_right_of(const Node& node, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 leftmost(b.y < a.y ? node.high.x : node.low.x,
                              b.x > a.x ? node.high.y : node.low.y);
    return turn(a, b, leftmost) < 0.0;
  }

  bool any_within(std::size_t index, glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) const {
    const Node& node = nodes_[index];
    if (node.count == 0 || is_right_of(node, a, b) || is_right_of(node, b, c) ||
        is_right_of(node, c, a)) {
      return false;
    }
    if (!node.leaf) {
      return any_within(2 * index + 1, a, b, c) || any_within(2 * index + 2, a, b, c);
    }
    return std::any_of(order_.begin() + std::ptrdiff_t(node.first),
                       order_.begin() + std::ptrdiff_t(node.end), [&](unsigned corner) {
                         const glm::dvec2 p = points_[corner];
                         return blocks_[corner] && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 &&
                                turn(c, a, p) >= 0.0 && p != a && p != b && p != c;
                       });
  }

  const std::vector<glm::dvec2>& points_;
  std::vector<unsigned> order_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> leaf_of_;
  std::vector<bool> blocks_;
};

/// What is left of a polygon while its ears are clipped.
class Ring {
 public:
  Ring(const std::vector<glm::dvec2>& points, std::vector<unsigned> corners)
      : points_(points), next_(points.size()), before_(points.size()), left_(corners.size()) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const unsigned follower = corners[(i + 1) % corners.size()];
      next_[corners[i]] = follower;
      before_[follower] = corners[i];
    }
    first_ = corners[0];
  }

  std::size_t left() const { return left_; }
  unsigned first() const { return first_; }
  unsigned next(unsigned corner) const { return next_[corner]; }
  unsigned before(unsigned corner) const { return before_[corner]; }
  bool has(unsigned corner) const { return next_[before_[corner]] == corner; }
  double turn_at(unsigned corner) const {
    return turn(points_[before_[corner]], points_[corner], points_[next_[corner]]);
  }
  glm::uvec3 ear(unsigned corner) const { return {before_[corner], corner, next_[corner]}; }

  void remove(unsigned corner) {
    next_[before_[corner]] = next_[corner];
    before_[next_[corner]] = before_[corner];
    first_ = next_[corner];
    --left_;
  }

  std::vector<unsigned> corners() const {
    std::vector<unsigned> list;
    for (unsigned corner = first_; list.size() < left_; corner = next_[corner]) {
      list.push_back(corner);
    }
    return list;
  }

 private:
  const std::vector<glm::dvec2>& points_;
  std::vector<unsigned> next_;
  std::vector<unsigned> before_;
  std::size_t left_;
  unsigned first_ = 0;
};

/// Corners that do not lie where the one before lies.
std::vector<unsigned> distinct_corners(const std::vector<glm::dvec2>& points) {
  std::vector<unsigned> distinct;
  for (unsigned i = 0; i < points.size(); ++i) {
    if (distinct.empty() || points[i] != points[distinct.back()]) {
      distinct.push_back(i);
    }
  }
  while (distinct.size() > 1 && points[distinct.back()] == points[distinct.front()]) {
    distinct.pop_back();
  }
  return distinct;
}

/// Whether the border turns around once, as that of everything does that does not cross itself.
bool turns_once(const std::vector<glm::dvec2>& points, const Ring& ring) {
  double angle = 0.0;
  for (const unsigned corner : ring.corners()) {
    const glm::dvec2 in = points[corner] - points[ring.before(corner)];
    const glm::dvec2 out = points[ring.next(corner)] - points[corner];
    angle += std::atan2(in.x * out.y - in.y * out.x, glm::dot(in, out));
  }
  return std::abs(angle - 2.0 * std::numbers::pi) < 1.0;
}

void cut_fan(const Ring& ring, std::vector<glm::uvec3>& triangles) {
  const std::vector<unsigned> left = ring.corners();
  for (std::size_t i = 2; i < left.size(); ++i) {
    triangles.emplace_back(left[0], left[i - 1], left[i]);
  }
}

/// Clips ears until three corners are left or no ear is there. An ear that is clipped makes or
/// unmakes an ear only beside it, so that all need to be looked at only once.
void clip_ears(const std::vector<glm::dvec2>& points, Ring& ring, Blockers& blockers,
               std::vector<glm::uvec3>& triangles, const std::stop_token& stop) {
  std::vector<unsigned> waiting = ring.corners();
  CancelTick tick(stop);
  for (std::size_t i = 0; i < waiting.size() && ring.left() > 3; ++i) {
    tick();
    const unsigned corner = waiting[i];
    if (!ring.has(corner) || !(ring.turn_at(corner) > 0.0)) {
      continue;
    }
    const glm::uvec3 ear = ring.ear(corner);
    if (blockers.any_within(points[ear.x], points[ear.y], points[ear.z])) {
      continue;
    }
    triangles.push_back(ear);
    ring.remove(corner);
    blockers.set(corner, false);
    for (const unsigned beside : {ear.x, ear.z}) {
      blockers.set(beside, !(ring.turn_at(beside) > 0.0));
      waiting.push_back(beside);
    }
  }
}

/// Corners on a straight border, and the tips of spikes: without them the inside is the same.
bool remove_flat_corners(Ring& ring, Blockers& blockers) {
  bool removed = false;
  for (const unsigned corner : ring.corners()) {
    if (ring.left() > 3 && ring.turn_at(corner) == 0.0) {
      ring.remove(corner);
      blockers.set(corner, false);
      removed = true;
    }
  }
  return removed;
}

}  // namespace

PolygonCut cut_polygon(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles,
                       const std::stop_token& stop) {
  if (corners.size() == 3) {
    triangles.emplace_back(0, 1, 2);
    return PolygonCut::whole;
  }
  const std::vector<glm::dvec2> points = flattened(corners);
  if (points.empty()) {
    for (unsigned i = 2; i < corners.size(); ++i) {
      triangles.emplace_back(0, i - 1, i);
    }
    return PolygonCut::crossing;
  }
  if (corners.size() == 4 && cut_quad(corners, points, triangles)) {
    return PolygonCut::whole;
  }
  Ring ring(points, distinct_corners(points));
  Blockers blockers(points);
  bool convex = true;
  for (const unsigned corner : ring.corners()) {
    const bool blocks = !(ring.turn_at(corner) > 0.0);
    blockers.set(corner, blocks);
    convex = convex && !blocks;
  }
  if (!convex && corners.size() > most_concave_corners) {
    return PolygonCut::too_many;
  }
  PolygonCut result = turns_once(points, ring) ? PolygonCut::whole : PolygonCut::crossing;
  // Each round but the first begins with corners that stood in the way for being flat.
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    clip_ears(points, ring, blockers, triangles, stop);
    if (ring.left() <= 3 || !remove_flat_corners(ring, blockers)) {
      break;
    }
  }
  if (ring.left() > 3 || ring.turn_at(ring.first()) < 0.0) {
    result = PolygonCut::crossing;
  }
  cut_fan(ring, triangles);
  return result;
}

}  // namespace quartet
