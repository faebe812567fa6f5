// The separating axis test (SAT) as it stands in the textbook: two polytopes are apart if and only if their projections are, on a
// face normal of one or on the cross product of an edge of each.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree: A Hierarchical Structure for Rapid Interference Detection", SIGGRAPH 1996; for
//          any two polytopes Ericson, "Real-Time Collision Detection", 2005, section 5.2.1.
// Steps:   1. Place the vertices; a face normal is the cross product of its sides, and a box has three of each.
//          2. On each axis n, in both directions, the projections of a and b overlap by max n . a - min n . b. Stop at an axis on
//             which this is negative: it separates.
//          3. Otherwise the least overlap of all axes is the penetration depth, along its axis.
// Departs: counts what rounding can hide. A normal is off by an angle that grows as its two sides become parallel; the true
//          overlap may be less by that angle times the extent. Edges that are nearly parallel have no axis of their own: beside
//          them, axes of faces are as good up to their angle.
// Answers: `lower` and `upper` are certified. No witness points. `touching` within bounds that are at most 6e-14 of the size
//          apart.
// Fails:   not_converged with bounds where the angles hide the side of contact or more than 1e-10 of the size of a depth, as at
//          slivers and between edges that are 1e-8 to 1e-12 from parallel; degenerate for a hull without volume or without faces;
//          capacity where the normals, or the pairs of edges, would take more than a hundred million products. Takes boxes and hulls.
// Cost:    O((Fa + Fb + Ea Eb) (Va + Vb)) time; O(V + F + E) memory.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "algorithms/kernels/textbook/contact.h"
#include "algorithms/kernels/textbook/difference.h"
#include "algorithms/narrow_phase.h"

namespace touchstone {
namespace {

using textbook::Difference;

// A unit vector, and the angle by which rounding may have turned it.
struct Axis {
  Vec3d direction;
  double doubt;
};

struct Axes {
  std::vector<Axis> normals, edges;
};

// The cross product of two vectors, which are themselves off by angles of together `doubt`.
Axis cross(const Vec3d& u, const Vec3d& v, double doubt) {
  const Vec3d product = u.cross(v);
  const double length = product.norm();
  return {product / length, doubt * u.norm() * v.norm() / length};
}

// The normal of a polygon: the sum of the cross products of its fan. Its corners may miss the plane, by rounding, or because
// faces were merged.
Axis polygon_normal(const std::vector<Vec3d>& corners, const std::vector<std::uint32_t>& loop,
                    double rounding) {
  Vec3d area = Vec3d::Zero();
  double longest = 0, off_plane = 0;
  const Vec3d& first = corners[loop[0]];
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Vec3d side = corners[loop[k]] - first, other = corners[loop[k + 1]] - first;
    area += side.cross(other);
    longest = std::max({longest, side.norm(), other.norm()});
  }
  const double length = area.norm();
  for (const std::uint32_t k : loop)
    off_plane = std::max(off_plane, std::abs(area.dot(corners[k] - first)) / length);
  return {area / length, (rounding + 2 * off_plane) * longest / length};
}

// Writes the axes of a body in the world's directions. Lengths are divided by `unit`, as `rounding` is.
void place(const Shape& shape, const Mat3d& rotation, double unit, double rounding,
           std::vector<Vec3d>& corners, Axes& axes) {
  axes.normals.clear();
  axes.edges.clear();
  if (shape.kind == ShapeKind::box) {
    for (int k = 0; k < 3; ++k) {
      axes.normals.push_back(cross(rotation.col((k + 1) % 3), rotation.col((k + 2) % 3), rounding));
      axes.edges.push_back({rotation.col(k).normalized(), rounding});
    }
    return;
  }
  corners.clear();
  for (const Vec3d& v : shape.hull->vertices) corners.push_back(rotation * v / unit);
  for (const Hull::Face& face : shape.hull->faces)
    axes.normals.push_back(polygon_normal(corners, face.loop, rounding));
  for (const Hull::Edge& edge : shape.hull->edges) {
    const Vec3d along = corners[edge.head] - corners[edge.tail];
    axes.edges.push_back({along.normalized(), rounding / along.norm()});
  }
}

// The axis on which the projections are furthest apart, and what is known of the signed distance (in the unit of C).
class Test {
 public:
  explicit Test(Difference& c) : c_(c) {}

  // Tests an axis in both directions. Returns true if it separates.
  bool separates(const Axis& axis, bool is_of_parallel_edges) {
    for (const double sign : {1.0, -1.0}) {
      const Vec3d n = sign * axis.direction;
      const double gap = -n.dot(c_.support(n).w);  // minus the overlap of the projections
      if (gap > best_) {
        best_ = gap;
        normal_ = n;
      }
      if (gap > c_.rounding()) return true;
      // No point of C is further than 1 from the origin, so the true axis has no more than this.
      if (!is_of_parallel_edges) most_ = std::max(most_, gap + 2 * axis.doubt);
    }
    ++tested_;
    return false;
  }

  // Tests the axis of two edges. Those at an angle of less than the root of a rounding are parallel as far as faces go.
  bool separates(const Axis& edge_a, const Axis& edge_b) {
    const double doubt = edge_a.doubt + edge_b.doubt;
    const Axis axis = cross(edge_a.direction, edge_b.direction, doubt);
    const double angle = edge_a.direction.cross(edge_b.direction).norm();
    const bool is_parallel = angle < 1e-8;
    if (is_parallel) parallel_ = std::max(parallel_, 2 * (angle + doubt));
    return angle > 0 && separates(axis, is_parallel);
  }

  const Vec3d& normal() const { return normal_; }
  double gap() const { return best_; }
  double lower() const { return best_ - c_.rounding(); }
  double upper() const { return std::max(most_, best_ + parallel_) + c_.rounding(); }
  int tested() const { return tested_; }

 private:
  Difference& c_;
  Vec3d normal_ = Vec3d::UnitX();
  double best_ = -std::numeric_limits<double>::infinity(), most_ = best_, parallel_ = 0;
  int tested_ = 0;
};

class SatTextbook final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override { shapes_ = textbook::bind_shapes(shapes); }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      const textbook::BoundShape &shape_a = shapes_[pairs.shape_of[a]],
                                 &shape_b = shapes_[pairs.shape_of[b]];
      const Pose &pose_a = pairs.poses[a], &pose_b = pairs.poses[b];
      Difference c(shape_a, pose_a, shape_b, pose_b);
      outcomes[i] = {.status = Status::degenerate};
      if (!c.is_finite() || !has_faces(*shape_a.shape) || !has_faces(*shape_b.shape)) continue;
      // That of a corner is a part of that of a support point.
      const double rounding = c.rounding() / 3;
      place(*shape_a.shape, pose_a.rotation, c.unit(), rounding, corners_, axes_a_);
      place(*shape_b.shape, pose_b.rotation, c.unit(), rounding, corners_, axes_b_);
      solve_pair(c, vertices_of(*shape_a.shape) + vertices_of(*shape_b.shape), task, outcomes[i]);
      outcomes[i].support_calls = c.support_calls();
    }
  }

 private:
  static bool has_faces(const Shape& shape) {
    return shape.kind == ShapeKind::box || !shape.hull->faces.empty();
  }
  static double vertices_of(const Shape& shape) {
    return shape.kind == ShapeKind::box ? 8 : static_cast<double>(shape.hull->vertices.size());
  }

  // `vertices`: those of both.
  void solve_pair(Difference& c, double vertices, Task task, Outcome& outcome) const {
    const auto count = [](const auto& a) { return static_cast<double>(a.size()); };
    const double normals = count(axes_a_.normals) + count(axes_b_.normals);
    const double edge_pairs = count(axes_a_.edges) * count(axes_b_.edges);
    outcome.status = Status::capacity;
    if (normals * vertices > most_products) return;
    Test test(c);
    bool is_separated = false;
    for (const Axes* axes : {&axes_a_, &axes_b_}) {
      for (const Axis& normal : axes->normals)
        is_separated = is_separated || test.separates(normal, false);
    }
    if (!is_separated && edge_pairs * vertices > most_products) return;
    for (const Axis& edge_a : axes_a_.edges) {
      for (const Axis& edge_b : axes_b_.edges)
        is_separated = is_separated || test.separates(edge_a, edge_b);
    }
    outcome.iterations = test.tested();
    if (is_separated) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
    } else if (test.upper() < 0) {
      textbook::write_overlapping(outcome);
      if (task == Task::penetration) write_depth(c, test, outcome);
    } else {
      textbook::write_undecided(c, test.lower(), test.upper(), outcome);
    }
  }

  void write_depth(const Difference& c, const Test& test, Outcome& outcome) const {
    outcome.distance = c.unit() * test.gap();
    outcome.lower = c.unit() * test.lower();
    outcome.upper = c.unit() * test.upper();
    outcome.normal = test.normal();
    if (test.upper() - test.gap() > most_hidden + 4 * c.rounding())
      outcome.status = Status::not_converged;
  }

  static constexpr double most_products = 1e8;
  static constexpr double most_hidden = 1e-10;  // of a depth, by rounding; in the unit of C

  std::vector<textbook::BoundShape> shapes_;
  std::vector<Vec3d> corners_;
  Axes axes_a_, axes_b_;
};

bool are_boxes_or_hulls(ShapeKind kind_a, ShapeKind kind_b, Task /*task*/) {
  const auto fits = [](ShapeKind kind) {
    return kind == ShapeKind::box || kind == ShapeKind::hull;
  };
  return fits(kind_a) && fits(kind_b);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_sat_textbook() {
  return {{.info = {.name = "sat-textbook",
                    .citation = "Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996; Ericson, "
                                "Real-Time Collision Detection, "
                                "2005: separating axes, every normal and every pair of edges"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {Precision::float64},
           .supports = are_boxes_or_hulls,
           .make = [](const NarrowPhaseSettings&) -> std::unique_ptr<NarrowPhase> {
             return std::make_unique<SatTextbook>();
           }}};
}

}  // namespace touchstone::entries
