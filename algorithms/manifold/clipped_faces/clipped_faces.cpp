// Clipped faces: intersects the two opposite faces and keeps four corners of the result.
// Paper:   Gregorius, "Robust contact creation for physics simulations", GDC 2015 (reference face
//          and incident face); Sutherland, Hodgman, "Reentrant polygon clipping", CACM 17(1), 1974.
// Steps:   1. Find the normal and the depth of the least penetration: 15 axes in lanes for boxes, a
//             formula for a half-space, GJK and EPA for the others (penetration.cpp).
//          2. Separated pairs, and pairs without a normal, end here.
//          3. Find the face, edge or point of each body that supports it along the normal
//             (contact_feature.cpp).
//          4. Project both features along the normal; cut the smaller by the other's outline and
//             where the bodies part (contact_polygon.cpp).
//          5. Give each corner its two heights along the normal: they are the points on a and b.
//          6. Of five corners or more keep four: the greatest area that has a deepest corner
//             (manifold_reduction.cpp).
//          7. If the corners miss the depth of step 1, add its witness points as a contact.
// Departs: the normal is that of the least penetration and need not be a face's: both faces are
//          projected along it, neither is the reference, and each corner is lifted into both.
//          Corners of zero depth end the area where the bodies part. A face or edge that is tilted
//          by more than 25 degrees counts as the edge or point of it that lies furthest; crossing
//          edges, and points, make one contact, the witness points of the penetration. The rim of a
//          cylinder or cone is an inscribed polygon of 16 corners, a straight side is an edge, and
//          a capsule is its axis with a radius. Against a half-space the only cut is at depth zero.
// Answers: points are on the surface, or in the body, up to rounding (1e-13 of the size in double,
//          1e-4 in float) and that of the world's coordinates; the greatest depth is the depth of
//          the penetration to 1e-8 and 1e-4. Points of cylinders, cones and ellipsoids are up
//          to 1e-9 of the size off the line of the normal, which is EPA's tolerance.
//          In float an area that is below rounding across, or in which the bodies part, becomes
//          one or two points.
// Fails:   as sat and gjk do: not_converged within rounding of touching, and where EPA ends at its
//          cap. Only one face is taken of a hull whose side consists of several almost coplanar
//          faces. Solid hulls without faces get one point, and the status degenerate. Capsules and
//          edges that are parallel, but not within rounding, get one point.
// Cost:    O(n m) for faces of n and m corners, and O(k^2) for the k corners of their intersection.
#include <algorithm>
#include <limits>
#include <vector>

#include "algorithms/contact_manifold.h"
#include "algorithms/kernels/batch/box_pair_lanes.h"
#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/sat/box_box.h"
#include "algorithms/kernels/sat/separating_axis.h"
#include "algorithms/manifold/clipped_faces/contact_feature.h"
#include "algorithms/manifold/clipped_faces/contact_polygon.h"
#include "algorithms/manifold/clipped_faces/manifold_reduction.h"
#include "algorithms/manifold/clipped_faces/penetration.h"

namespace touchstone {
namespace {

constexpr int most_expansions = 256;

// The penetration of a pair, known before its faces are searched; world coordinates, metres.
struct Deepest {
  Answer answer;
  Status status;
  double depth;
  Vec3d normal, on_a, on_b;

  bool has_points() const { return answer != Answer::separated && normal.allFinite(); }
};

Deepest deepest_of(const Outcome& outcome) {
  return {outcome.answer, outcome.status,    0 - outcome.distance,
          outcome.normal, outcome.witness_a, outcome.witness_b};
}

template <class Scalar>
class ClippedFaces final : public ContactManifold {
 public:
  void bind(std::span<const Shape> shapes) override {
    shapes_.clear();
    shapes_.reserve(shapes.size());
    for (const Shape& shape : shapes) shapes_.emplace_back(shape);
    polytopes_.clear();
    for (const Shape& shape : shapes) {
      const bool box = shape.kind == ShapeKind::box;
      polytopes_.push_back(box ? make_polytope<Scalar>(shape) : Polytope<Scalar>{});
    }
    box_lanes_.bind(shapes);
  }

  void solve(const PairBatch& batch, std::span<Manifold> manifolds) override {
    const bool boxes = batch.kind_a == ShapeKind::box && batch.kind_b == ShapeKind::box;
    if (boxes) find_box_depths(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      manifolds[i] = {};
      const Placed a = place(batch, batch.pairs.first[i]), b = place(batch, batch.pairs.second[i]);
      if (batch.kind_b == ShapeKind::halfspace) {
        solve_plane(a, b, manifolds[i]);
      } else if (boxes) {
        solve_boxes(a, b, deepest_of(outcomes_[i]), manifolds[i]);
      } else {
        solve_bounded(a, b, manifolds[i]);
      }
    }
  }

 private:
  struct Placed {
    const FeatureShape<Scalar>& shape;
    const Pose& pose;
    std::uint32_t index;  // index of the shape

    const SupportShape<Scalar>& support() const { return shape.support; }
    Mat3<Scalar> rotation() const { return pose.rotation.template cast<Scalar>(); }
  };

  static constexpr Scalar rounding = 4 * SupportPair<Scalar>::rounding;
  // The tolerance by which the polygon's deepest corner may miss the depth.
  static constexpr Scalar least_digits = sizeof(Scalar) == 8 ? Scalar(1e-9) : Scalar(1e-4);

  Placed place(const PairBatch& batch, std::uint32_t body) const {
    const std::uint32_t shape = batch.pairs.shape_of[body];
    return {shapes_[shape], batch.pairs.poses[body], shape};
  }

  void find_box_depths(const PairBatch& batch);
  void solve_boxes(const Placed& a, const Placed& b, const Deepest& deepest, Manifold& manifold);
  void solve_bounded(const Placed& a, const Placed& b, Manifold& manifold);
  void solve_plane(const Placed& a, const Placed& b, Manifold& manifold);
  // The steps that all pairs of bounded bodies share; false if the corners miss the depth.
  bool solve_pair(SupportPair<Scalar>& pair, const Placed& a, const Placed& b,
                  const Deepest& deepest, Manifold& manifold);
  // Writes the manifold from the polygon's corners. `to_world` maps the polygon's frame, whose unit
  // is `unit` metres, to the world. Returns false if no corner reaches the depth.
  template <class ToWorld>
  bool write(const Deepest& deepest, double unit, bool numbered, const ToWorld& to_world,
             Manifold& manifold);

  std::vector<FeatureShape<Scalar>> shapes_;
  std::vector<Polytope<Scalar>> polytopes_;  // empty for shapes that are no boxes
  BoxPairLanes<Scalar> box_lanes_;
  ExpandingPolytope<Scalar> expanding_{most_expansions};
  ContactFeature<Scalar> feature_a_, feature_b_;
  ContactPolygon<Scalar> region_;
  std::vector<Outcome> outcomes_;    // results of a batch of box pairs
  std::vector<std::uint32_t> left_;  // indices of the pairs that the lanes do not solve
};

// Writes answer, status and normal; returns false if there is nothing more to find.
bool begin(const Deepest& deepest, Manifold& manifold) {
  manifold.answer = deepest.answer;
  manifold.status = deepest.status;
  if (!deepest.has_points()) return false;
  manifold.normal = deepest.normal;
  return true;
}

// Replaces the contact nearest to the deepest point by it, or appends it if there is room.
void add_deepest(const Deepest& deepest, Manifold& manifold) {
  const auto distance = [&](const ContactPoint& p) {
    return (p.on_a - deepest.on_a).squaredNorm();
  };
  const auto end = manifold.points.begin() + manifold.count;
  auto at = end;
  if (manifold.count == Manifold::most_points) {
    at = std::min_element(manifold.points.begin(), end,
                          [&](const auto& p, const auto& q) { return distance(p) < distance(q); });
  } else {
    ++manifold.count;
  }
  *at = {deepest.on_a, deepest.on_b, std::max(0.0, deepest.depth)};
}

template <class Scalar>
template <class ToWorld>
bool ClippedFaces<Scalar>::write(const Deepest& deepest, double unit, bool numbered,
                                 const ToWorld& to_world, Manifold& manifold) {
  const std::vector<PolygonCorner<Scalar>>& corners = region_.corners();
  const auto add = [&](const PolygonCorner<Scalar>& corner) {
    ContactPoint& point = manifold.points[static_cast<std::size_t>(manifold.count++)];
    point.on_a = to_world(region_.on_a(corner));
    point.on_b = to_world(region_.on_b(corner));
    // A depth below zero is rounding.
    point.depth = std::max(0.0, unit * static_cast<double>(corner.depth));
    if (!numbered) return;
    const std::uint64_t faces = std::uint64_t{feature_a_.number} << 16 | feature_b_.number;
    point.feature = faces << 32 | std::uint64_t{corner.from} << 16 | corner.to;
  };
  if (corners.size() <= Manifold::most_points) {
    for (const PolygonCorner<Scalar>& corner : corners) add(corner);
  } else {
    for (const std::uint32_t k : choose_four(corners, rounding)) add(corners[k]);
  }
  double found = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& point : manifold.contacts()) found = std::max(found, point.depth);
  return found >= deepest.depth - unit * static_cast<double>(least_digits);
}

// Fills outcomes_.
template <class Scalar>
void ClippedFaces<Scalar>::find_box_depths(const PairBatch& batch) {
  outcomes_.assign(batch.size(), {});
  left_.resize(batch.size());
  const std::size_t left =
      box_lanes_.solve(batch.pairs, Task::penetration, outcomes_, left_.data());
  for (std::size_t k = 0; k < left; ++k) {
    const Placed a = place(batch, batch.pairs.first[left_[k]]),
                 b = place(batch, batch.pairs.second[left_[k]]);
    const PolytopePair<Scalar> pair(polytopes_[a.index], a.pose, polytopes_[b.index], b.pose);
    int tested = 0;
    const Axis<Scalar> best = pair.far_apart() ? Axis<Scalar>{} : box_axis(pair, tested);
    // The witness points take longer than the axis and are hardly ever needed: left out here.
    Outcome& outcome = outcomes_[left_[k]];
    pair.report(best, Task::intersect, true, outcome);
    if (outcome.answer == Answer::separated) continue;
    outcome.distance = pair.unit() * static_cast<double>(best.gap);
    outcome.normal = best.normal.template cast<double>().normalized();
  }
}

template <class Scalar>
void ClippedFaces<Scalar>::solve_boxes(const Placed& a, const Placed& b, const Deepest& deepest,
                                       Manifold& manifold) {
  if (!begin(deepest, manifold)) return;
  SupportPair<Scalar> pair(a.support(), a.pose, b.support(), b.pose);
  if (solve_pair(pair, a, b, deepest, manifold)) return;
  if (deepest.on_a.allFinite()) return add_deepest(deepest, manifold);
  const PolytopePair<Scalar> polytopes(polytopes_[a.index], a.pose, polytopes_[b.index], b.pose);
  int tested = 0;
  Outcome outcome;
  polytopes.report(box_axis(polytopes, tested), Task::penetration, true, outcome);
  add_deepest(deepest_of(outcome), manifold);
}

template <class Scalar>
void ClippedFaces<Scalar>::solve_bounded(const Placed& a, const Placed& b, Manifold& manifold) {
  if (balls_are_apart(a.support(), a.pose, b.support(), b.pose)) {
    manifold.answer = Answer::separated;
    manifold.status = Status::ok;
    return;
  }
  SupportPair<Scalar> pair(a.support(), a.pose, b.support(), b.pose);
  const Penetration<Scalar> found = find_penetration(pair, expanding_);
  Deepest deepest{found.answer,
                  found.status,
                  pair.unit() * static_cast<double>(found.depth),
                  found.normal.template cast<double>().normalized(),
                  pair.to_world(found.a),
                  pair.to_world(found.b)};
  if (!a.shape.complete || !b.shape.complete) deepest.status = Status::degenerate;
  if (!begin(deepest, manifold)) return;
  if (!solve_pair(pair, a, b, deepest, manifold)) add_deepest(deepest, manifold);
}

template <class Scalar>
bool ClippedFaces<Scalar>::solve_pair(SupportPair<Scalar>& pair, const Placed& a, const Placed& b,
                                      const Deepest& deepest, Manifold& manifold) {
  const Vec3<Scalar> normal = deepest.normal.template cast<Scalar>();
  find_feature<Scalar>(a.shape, a.rotation(), pair.a(), Vec3<Scalar>::Zero(), normal, feature_a_);
  find_feature<Scalar>(b.shape, b.rotation(), pair.b(), pair.centre_b(), -normal, feature_b_);
  region_.find(feature_a_, feature_b_, normal, rounding);
  return write(
      deepest, pair.unit(), feature_a_.numbered && feature_b_.numbered,
      [&](const Vec3<Scalar>& point) { return pair.to_world(point); }, manifold);
}

// Body b is the half-space.
template <class Scalar>
void ClippedFaces<Scalar>::solve_plane(const Placed& a, const Placed& b, Manifold& manifold) {
  Outcome outcome;
  solve_halfspace(a.support(), a.pose, b.support(), b.pose, Task::penetration, outcome);
  Deepest deepest = deepest_of(outcome);
  if (!a.shape.complete && deepest.answer != Answer::separated) deepest.status = Status::degenerate;
  if (!begin(deepest, manifold)) return;
  const double unit = power_of_two_above(a.support().reach(a.pose.rotation));
  PosedShape<Scalar> turned(a.support(), a.pose.rotation, unit);
  const Vec3<Scalar> normal = deepest.normal.template cast<Scalar>();
  find_feature<Scalar>(a.shape, a.rotation(), turned, Vec3<Scalar>::Zero(), normal, feature_a_);
  feature_b_.number = 0;
  const Scalar height = normal.dot(turned.support(normal)) + turned.radius() -
                        static_cast<Scalar>(deepest.depth / unit);
  region_.find_on_plane(feature_a_, height, normal, rounding);
  const Vec3d origin = a.pose(a.support().centre);
  const auto to_world = [&](const Vec3<Scalar>& point) {
    return Vec3d(origin + unit * point.template cast<double>());
  };
  if (!write(deepest, unit, feature_a_.numbered, to_world, manifold)) {
    add_deepest(deepest, manifold);
  }
}

bool supports(ShapeKind a, ShapeKind b) {
  return a != ShapeKind::halfspace || b != ShapeKind::halfspace;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<ManifoldEntry> manifold_clipped_faces() {
  return {{.info = {.name = "clipped-faces",
                    .citation = "Gregorius, \"Robust contact creation for physics simulations\", "
                                "GDC 2015; Sutherland, Hodgman, \"Reentrant polygon clipping\", "
                                "Communications of the ACM 17(1), 1974"},
           .scalars = {Precision::float32, Precision::float64},
           .supports = supports,
           .make = [](const ManifoldSettings& settings) -> std::unique_ptr<ContactManifold> {
             if (settings.scalar == Precision::float32) {
               return std::make_unique<ClippedFaces<float>>();
             }
             return std::make_unique<ClippedFaces<double>>();
           }}};
}

}  // namespace touchstone::entries
