// Separating axis test, complete: face normals of both bodies, and cross products of their edges.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996; Gregorius, "The Separating Axis Test
//          between Convex Polyhedra", GDC 2013 (an edge pair counts only if its arcs cross on the
//          Gauss map).
// Steps:   1. Pairs whose bounding balls are far apart are separated (kernels/sat/polytope_query).
//          2. With a memory, test the axis that separated the pair last (cached_axis).
//          3. Two boxes take the closed form of their 15 axes (kernels/sat/box_box).
//          4. Test the line of the centres, then the gap along each face normal of both bodies
//             (kernels/sat/separating_axis).
//          5. For each edge of a, list the edges of b whose arcs may cross its arc on the Gauss map
//             (kernels/sat/gauss_arcs), and test the crossing by signs.
//          6. Measure the gap along the cross product of each crossing pair. Stop at any axis that
//             separates.
//          7. Report the greatest gap: positive is separated, negative is the depth, with witness
//             points of the supporting features (kernels/sat/witness_points).
// Departs: edges and normals have unit length in the arc test, and pairs that rounding leaves open
//          are kept: their axis is measured over all vertices, which is valid for any axis. Axes of
//          almost parallel edges are made orthogonal to one edge again. The error that remains
//          moves the gap by no more than rounding, because the facet of the Minkowski difference is
//          as narrow as the axis is uncertain. Flat hulls, segments and points have the normals and
//          edges of a prism or box without thickness.
// Answers: the depth and both bounds are exact up to rounding. If the greatest gap is below its
//          rounding error (1e-14 of the size in double, 1e-5 in float), the answer is `touching`
//          with these bounds on the signed distance. Two hulls of one point each have no size;
//          the error is then that of their offset.
// Fails:   reports degenerate for a solid hull without faces that no tested axis
//          separates, and for matrices far from rotations; capacity for a hull of more than 16,384
//          vertices that the line of centres does not separate, and for two hulls of some thousand
//          vertices each that no face normal separates.
// Cost:    O(Fa Vb + Fb Va + Ea (Fb + Eb)) time, O(F + E) memory.
#include <cmath>
#include <cstring>
#include <limits>

#include "algorithms/kernels/sat/box_box.h"
#include "algorithms/kernels/sat/polytope_query.h"
#include "algorithms/kernels/sat/separating_axis.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/sat/cached_axis.h"

namespace touchstone {
namespace {

template <class Scalar>
class Sat final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override { shapes_.bind(shapes); }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    shapes_.solve(task, batch, outcomes, [&](const PolytopePair<Scalar>& pair, std::size_t i) {
      Axis<Scalar> best;
      tested_ = 0;
      gave_up_ = false;
      if (!pair.far_apart()) {
        const bool boxes = batch.kind_b == ShapeKind::box;
        best = batch.memory.empty() ? best_axis(pair, boxes)
                                    : best_axis(pair, boxes, batch.memory[batch.memory_of[i]]);
      }
      if (gave_up_) {
        outcomes[i].answer = Answer::unknown;
        outcomes[i].status = Status::capacity;
        clear_numbers(outcomes[i]);
      } else {
        pair.report(best, task, true, outcomes[i]);
      }
      outcomes[i].iterations = tested_;
      outcomes[i].support_calls = -1;
    });
  }

 private:
  using Edge = typename Polytope<Scalar>::Edge;

  static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  // Unit vectors have a few roundings each: a product below this may have either sign.
  static constexpr Scalar uncertain = 16 * epsilon;
  // Sine of the angle between two edges below which their axis is corrected.
  static constexpr Scalar almost_parallel = Scalar{0.5};
  static constexpr std::size_t most_edge_pairs = std::size_t{1} << 27;
  // Sine below which the axis is noise.
  static constexpr Scalar parallel = 1024 * epsilon;

  // Returns the axis with the greatest gap, or one that separates.
  Axis<Scalar> best_axis(const PolytopePair<Scalar>& pair, bool boxes) {
    if (boxes) return box_axis(pair, tested_);
    Axis<Scalar> best = pair.centre_axis();
    ++tested_;
    if (pair.separates(best)) return best;
    best = pair.face_axis(tested_);
    if (pair.separates(best)) return best;
    gave_up_ = pair.complete() && too_many_edges(pair);
    if (!gave_up_) test_edges(pair, best);
    return best;
  }

  // Tests the axis of the previous frame first.
  Axis<Scalar> best_axis(const PolytopePair<Scalar>& pair, bool boxes, PairMemory& memory) {
    static_assert(sizeof(CachedAxis) <= sizeof memory.bytes);
    CachedAxis kept;
    std::memcpy(&kept, memory.bytes.data(), sizeof kept);
    Axis<Scalar> best;
    if (!kept.separates(pair, boxes, best, tested_)) {
      best = best_axis(pair, boxes);
      if (!pair.separates(best)) return best;
      kept.keep(pair, best.normal);
    }
    std::memcpy(memory.bytes.data(), &kept, sizeof kept);
    return best;
  }

  // A test of all pairs of edges would take half a second.
  static bool too_many_edges(const PolytopePair<Scalar>& pair) {
    return pair.a().shape->edges.size() * pair.b().shape->edges.size() > most_edge_pairs;
  }

  static int sign(Scalar x) { return x > uncertain ? 1 : x < -uncertain ? -1 : 0; }

  // Raises `best` to the greatest gap over the edge pairs; stops if one separates.
  void test_edges(const PolytopePair<Scalar>& pair, Axis<Scalar>& best) {
    const PlacedPolytope<Scalar>&a = pair.a(), &b = pair.b();
    // Normals transform by cofactors and edges by the matrix. These products take edges of a to the
    // stored normals of b, and normals of a to the stored edges of b.
    const Mat3<Scalar> to_normals = a.orientation * (b.normals.transpose() * a.matrix);
    const Mat3<Scalar> to_edges = b.orientation * (b.matrix.transpose() * a.normals);
    for (const Edge& of_a : a.shape->edges) {
      const Vec3<Scalar> along = to_normals * of_a.direction;
      const Vec3<Scalar> left = to_edges * a.shape->faces[of_a.left].normal;
      const Vec3<Scalar> right = to_edges * a.shape->faces[of_a.right].normal;
      crossing_.clear();
      b.shape->arcs.list_crossing(
          {along.template cast<float>(), left.template cast<float>(), right.template cast<float>()},
          crossing_);
      for (const std::uint32_t k : crossing_) {
        const Edge& of_b = b.shape->edges[k];
        // An arc of b crosses the great circle of a's arc if its ends are on opposite sides.
        const int b_left = sign(b.shape->faces[of_b.left].normal.dot(along)),
                  b_right = sign(b.shape->faces[of_b.right].normal.dot(along));
        if (b_left * b_right > 0) continue;
        const int a_left = sign(left.dot(of_b.direction)),
                  a_right = sign(right.dot(of_b.direction));
        if (a_left * a_right > 0) continue;
        // The circles meet in two opposite points. The arcs of a and of -b must pass through the
        // same one.
        const int side_b = b_left != 0 ? b_left : -b_right;
        const int side_a = a_left != 0 ? a_left : -a_right;
        if (side_a * side_b < 0) continue;
        const bool crossing = a_left * a_right * b_left * b_right != 0;
        test_edge_pair(pair, of_a, of_b, side_a != 0 ? side_a : side_b, crossing, best);
        if (pair.separates(best)) return;
      }
    }
  }

  // `side`: 1 if the outward axis is a's direction x b's, -1 if it is opposite, 0 if unknown.
  // `crossing`: the arcs certainly cross, so the edges support the bodies there.
  void test_edge_pair(const PolytopePair<Scalar>& pair, const Edge& of_a, const Edge& of_b,
                      int side, bool crossing, Axis<Scalar>& best) {
    const PlacedPolytope<Scalar>&a = pair.a(), &b = pair.b();
    const Vec3<Scalar> along_a = a.orientation * (a.matrix * of_a.direction);
    const Vec3<Scalar> along_b = b.orientation * (b.matrix * of_b.direction);
    Vec3<Scalar> normal = along_a.cross(along_b);
    const Scalar sine = normal.norm();
    if (sine < parallel) {
      // The facet is too narrow to matter unless the facets beside it are almost perpendicular to
      // it; then the middle of the arc replaces the axis.
      const Vec3<Scalar> middle =
          a.normals * (a.shape->faces[of_a.left].normal + a.shape->faces[of_a.right].normal);
      const Scalar length = middle.norm();
      if (length < Scalar{1.5} && length > 0) offer(pair.axis_along(middle / length), best);
      return;
    }
    normal /= side < 0 ? -sine : sine;
    if (sine < almost_parallel) {
      normal -= normal.dot(along_a) / along_a.squaredNorm() * along_a;
      normal.normalize();
    }
    if (crossing && sine >= almost_parallel) {
      offer({normal.dot(b(of_b.point) - a(of_a.point)), normal}, best);
      return;
    }
    offer(pair.axis_along(normal), best);
    if (side == 0) offer(pair.axis_along(-normal), best);
  }

  void offer(const Axis<Scalar>& axis, Axis<Scalar>& best) {
    ++tested_;
    if (axis.gap > best.gap) best = axis;
  }

  PolytopeShapes<Scalar> shapes_;
  std::vector<std::uint32_t> crossing_;  // edges of b whose arcs may cross the arc of an edge of a
  int tested_ = 0;
  bool gave_up_ = false;  // some pairs of edges were not tested
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_sat() {
  return {{.info = {.name = "sat",
                    .citation = "Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996; Gregorius, The "
                                "Separating Axis Test between Convex Polyhedra, GDC 2013"},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = {Precision::float32, Precision::float64},
           .supports = are_polytopes,
           .traits = {.starts_warm = true},
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             if (settings.scalar == Precision::float32) return std::make_unique<Sat<float>>();
             return std::make_unique<Sat<double>>();
           }}};
}

}  // namespace touchstone::entries
