// Finds faces in the points' affine frame with Qhull, and checks them before it accepts them.
#include "algorithms/hull/convex_hull.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "algorithms/hull/affine_frame.h"
#include "algorithms/hull/qhull_loops.h"

namespace touchstone {
namespace {

// The distance by which a merged face may miss a point, in affine coordinates.
constexpr double face_tolerance = 1e-10;

// --- faces from loops ---------------------------------------------------------------------------

// Twice the vector area (Newell). `p` holds the vertices' positions.
Vec3d area_vector(const Loop& loop, const std::vector<Vec3d>& p) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += (p[loop[i]] - p[loop[0]]).cross(p[loop[i + 1]] - p[loop[0]]);
  }
  return sum;
}
Vec3d area_vector(const Loop& loop, const std::vector<DoubleDouble3>& p) {
  DoubleDouble3 sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum = sum + cross(p[loop[i]] - p[loop[0]], p[loop[i + 1]] - p[loop[0]]);
  }
  return sum.value();
}

// Removes vertices of only two faces: they lie on an edge that merging made straight.
void drop_straight_vertices(std::vector<Loop>& loops, std::size_t vertices) {
  std::vector<int> faces(vertices, 0);
  for (const Loop& loop : loops) {
    for (std::uint32_t v : loop) ++faces[v];
  }
  for (Loop& loop : loops) std::erase_if(loop, [&](std::uint32_t v) { return faces[v] == 2; });
}

// Orients the loops anticlockwise. Returns false unless each loop is convex and has every point
// behind it.
bool orient(std::vector<Loop>& loops, const std::vector<Vec3d>& p, double tolerance) {
  Vec3d centre = Vec3d::Zero();
  for (const Vec3d& x : p) centre += x / static_cast<double>(p.size());
  for (Loop& loop : loops) {
    if (loop.size() < 3) return false;
    Vec3d n = area_vector(loop, p);
    const double area = n.norm();
    if (!(area > 0)) return false;
    n /= area;
    if (n.dot(centre - p[loop[0]]) > 0) {
      std::reverse(loop.begin(), loop.end());
      n = -n;
    }
    double plane = std::numeric_limits<double>::infinity();
    for (std::uint32_t v : loop) plane = std::min(plane, n.dot(p[v]));
    for (const Vec3d& x : p) {
      if (!(n.dot(x) <= plane + tolerance)) return false;
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3d& a = p[loop[i]];
      const Vec3d& b = p[loop[(i + 1) % loop.size()]];
      const Vec3d& c = p[loop[(i + 2) % loop.size()]];
      if (!((b - a).cross(c - b).dot(n) >= -tolerance)) return false;
    }
  }
  return true;
}

// Returns the edges between the loops, or none unless each edge is in two loops, once in each
// direction, and Euler's formula holds.
std::vector<Hull::Edge> edges_between(const std::vector<Loop>& loops) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> left;
  std::vector<std::uint32_t> used;
  for (std::uint32_t f = 0; f < loops.size(); ++f) {
    const Loop& loop = loops[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      used.push_back(loop[i]);
      if (!left.insert({{loop[i], loop[(i + 1) % loop.size()]}, f}).second) return {};
    }
  }
  std::vector<Hull::Edge> edges;
  for (const auto& [ends, face] : left) {
    const auto other = left.find({ends.second, ends.first});
    if (other == left.end()) return {};
    if (ends.first < ends.second) edges.push_back({ends.first, ends.second, face, other->second});
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.size() + loops.size() != edges.size() + 2) return {};
  return edges;
}

// Adds faces, edges and neighbours to a solid hull. Leaves them empty if Qhull or the check fails.
void add_faces(Hull& hull, OwnFrame& frame) {
  // The distance by which rounding of the given coordinates may move points off their plane.
  const double rounding =
      std::min(4 * std::numeric_limits<double>::epsilon() / frame.thickness, 1e-4);
  std::vector<Loop> loops = qhull_loops(frame.points, rounding > 1e-14 ? rounding : 0);
  drop_straight_vertices(loops, hull.vertices.size());
  if (loops.size() < 4 || !orient(loops, frame.points, std::max(face_tolerance, 16 * rounding))) {
    return;
  }
  std::vector<Hull::Edge> edges = edges_between(loops);
  if (edges.empty()) return;
  std::vector<Hull::Face> faces;
  faces.reserve(loops.size());
  for (Loop& loop : loops) {
    const Vec3d area = area_vector(loop, frame.offsets);
    const double size = area.cwiseAbs().maxCoeff();
    if (!(size > 0)) return;
    faces.push_back({std::move(loop), (area / size).normalized()});
  }
  hull.faces = std::move(faces);
  hull.edges = std::move(edges);
  hull.neighbours.resize(hull.vertices.size());
  for (const Hull::Edge& e : hull.edges) {
    hull.neighbours[e.tail].push_back(e.head);
    hull.neighbours[e.head].push_back(e.tail);
  }
}

// --- reduction ----------------------------------------------------------------------------------

// Indices of the corners of a flat set's hull (monotone chain: Andrew, Information Processing
// Letters 9, 1979).
std::vector<std::uint32_t> flat_corners(const std::vector<Vec3d>& p) {
  std::vector<std::uint32_t> order(p.size());
  for (std::uint32_t i = 0; i < p.size(); ++i) order[i] = i;
  const auto key = [&](std::uint32_t i) { return std::pair(p[i].x(), p[i].y()); };
  std::sort(order.begin(), order.end(), [&](auto i, auto j) { return key(i) < key(j); });
  std::vector<std::uint32_t> corners;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = corners.size();
    for (std::uint32_t i : order) {
      while (corners.size() >= start + 2) {
        const Vec3d& a = p[corners[corners.size() - 2]];
        const Vec3d& b = p[corners.back()];
        const double turn =
            (b.x() - a.x()) * (p[i].y() - a.y()) - (b.y() - a.y()) * (p[i].x() - a.x());
        if (turn > 0) break;
        corners.pop_back();
      }
      corners.push_back(i);
    }
    corners.pop_back();  // it is the first point of the other chain
    std::reverse(order.begin(), order.end());
  }
  return corners;
}

// Indices of the points to keep, ascending.
std::vector<std::uint32_t> corners_of(const Hull& hull, const OwnFrame& frame) {
  std::vector<std::uint32_t> kept;
  if (hull.dimension == 0) {
    kept = {0};
  } else if (hull.dimension == 1) {
    const auto less = [](const Vec3d& a, const Vec3d& b) { return a.x() < b.x(); };
    const auto [low, high] = std::minmax_element(frame.points.begin(), frame.points.end(), less);
    kept = {static_cast<std::uint32_t>(low - frame.points.begin()),
            static_cast<std::uint32_t>(high - frame.points.begin())};
  } else if (hull.dimension == 2) {
    kept = flat_corners(frame.points);
  } else if (!hull.faces.empty()) {
    for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
      if (!hull.neighbours[v].empty()) kept.push_back(v);
    }
  } else {  // the extreme points are unknown: keeps all distinct points
    std::map<std::array<double, 3>, std::uint32_t> first;
    for (std::uint32_t v = 0; v < hull.vertices.size(); ++v) {
      const Vec3d& p = hull.vertices[v];
      if (first.insert({{p.x(), p.y(), p.z()}, v}).second) kept.push_back(v);
    }
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

Hull reduced(Hull hull, const std::vector<std::uint32_t>& kept) {
  std::vector<std::uint32_t> renumbered(hull.vertices.size());
  std::vector<Vec3d> vertices;
  std::vector<std::vector<std::uint32_t>> neighbours;
  for (std::uint32_t v : kept) {
    renumbered[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(hull.vertices[v]);
    if (!hull.faces.empty()) neighbours.push_back(std::move(hull.neighbours[v]));
  }
  for (Hull::Face& face : hull.faces) {
    for (std::uint32_t& v : face.loop) v = renumbered[v];
  }
  for (Hull::Edge& edge : hull.edges) {
    edge.tail = renumbered[edge.tail];
    edge.head = renumbered[edge.head];
  }
  for (std::vector<std::uint32_t>& list : neighbours) {
    for (std::uint32_t& v : list) v = renumbered[v];
  }
  hull.vertices = std::move(vertices);
  hull.neighbours = std::move(neighbours);
  return hull;
}

}  // namespace

std::shared_ptr<const Hull> make_hull(std::vector<Vec3d> points) {
  auto hull = std::make_shared<Hull>();
  hull->vertices = std::move(points);
  OwnFrame frame = own_frame(hull->vertices);
  hull->dimension = frame.dimension;
  if (frame.dimension == 3) add_faces(*hull, frame);
  return hull;
}

Shape hull_of(std::vector<Vec3d> points) {
  Shape shape;
  shape.kind = ShapeKind::hull;
  shape.hull = make_hull(std::move(points));
  return shape;
}

std::shared_ptr<const Hull> make_reduced_hull(const std::vector<Vec3d>& points) {
  Hull hull;
  hull.vertices = points;
  OwnFrame frame = own_frame(points);
  hull.dimension = frame.dimension;
  if (frame.dimension == 3) add_faces(hull, frame);
  const std::vector<std::uint32_t> kept = corners_of(hull, frame);
  return std::make_shared<Hull>(reduced(std::move(hull), kept));
}

}  // namespace touchstone
