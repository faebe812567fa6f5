// Grades contact manifolds against exact distances and touching areas.
#include "harness/grade/manifold/manifold_grade.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/grade/manifold/touching_area.h"
#include "harness/grade/pair_size.h"
#include "harness/process/queries/solve_case.h"

namespace touchstone::grade {
namespace {

const NarrowPhaseEntry& oracle() {
  static const NarrowPhaseEntry* const entry = registry::find<NarrowPhaseEntry>("exact");
  return *entry;
}

// Returns the oracle's distance of a point from a body, metres; zero inside.
double distance_from(const Shape& shape, const Pose& pose, const Vec3d& point) {
  static const std::shared_ptr<const Hull> at_origin = make_hull({Vec3d::Zero()});
  files::Case c;
  c.shape_a.kind = ShapeKind::hull;
  c.shape_a.hull = at_origin;
  c.pose_a.translation = point;
  c.shape_b = shape;
  c.pose_b = pose;
  const Outcome outcome = process::solve_case(oracle(), {}, c, Task::distance);
  if (outcome.answer != Answer::separated) return 0;
  return outcome.distance;
}

// Smaller areas, as a part of the squared size, count as none.
constexpr Real area_of_a_line = 1e-14L;
// Depths within this part of the size of the deepest count as equal to it.
constexpr Real same_depth = 1e-14L;

}  // namespace

ManifoldTruth manifold_truth(const files::Case& c) {
  ManifoldTruth truth;
  truth.size = pair_size(c);
  if (!(truth.size > 0)) truth.size = 1;
  const Outcome outcome = process::solve_case(oracle(), {}, c, Task::penetration);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  truth.depth = truth.least_depth = truth.greatest_depth = -infinity;
  if (outcome.answer == Answer::separated || outcome.answer == Answer::unknown) return truth;
  truth.depth = -outcome.distance;
  truth.least_depth = -outcome.upper;
  truth.greatest_depth = -outcome.lower;
  return truth;
}

double coordinate_rounding(const files::Case& c, const ManifoldTruth& truth) {
  const double far = std::max(c.pose_a.translation.cwiseAbs().maxCoeff(),
                              c.pose_b.translation.cwiseAbs().maxCoeff());
  return 4 * std::numeric_limits<double>::epsilon() * far / truth.size;
}

ManifoldGrade grade(const files::Case& c, const ManifoldTruth& truth, const Manifold& manifold) {
  ManifoldGrade result;
  if (manifold.count == 0) {
    result.missed = truth.overlap();
    return result;
  }
  double deepest = manifold.points[0].depth;
  for (const ContactPoint& point : manifold.contacts()) {
    result.off_body = std::max({result.off_body, distance_from(c.shape_a, c.pose_a, point.on_a),
                                distance_from(c.shape_b, c.pose_b, point.on_b)});
    const Vec3d between = point.on_a - point.on_b;
    result.off_line = std::max(result.off_line, (between - point.depth * manifold.normal).norm());
    result.apart = std::max(result.apart, -point.depth);
    deepest = std::max(deepest, point.depth);
  }
  result.off_body /= truth.size;
  result.off_line /= truth.size;
  result.apart /= truth.size;
  if (truth.overlap()) {
    const double off = std::max(truth.least_depth - deepest, deepest - truth.greatest_depth);
    result.depth_error = std::max(0.0, off) / truth.size;
  }

  const AreaFrame frame = area_frame(c, manifold.normal);
  const std::optional<std::vector<AreaPoint>> area = touching_area(c, frame);
  if (!area || !truth.overlap()) return result;
  const Real square = Real{truth.size} * truth.size;
  const Real whole = hull_area(*area);
  if (!(whole > area_of_a_line * square)) return result;
  std::vector<AreaPoint> points;
  for (const ContactPoint& point : manifold.contacts()) {
    points.push_back(frame.see((point.on_a.cast<Real>() + point.on_b.cast<Real>()) / 2));
  }
  const Real spanned = hull_area(points);
  const Real best = greatest_area_of_four(*area, same_depth * truth.size);
  result.of_best_four = static_cast<double>(std::min<Real>(1, spanned / best));
  result.of_all = static_cast<double>(std::min<Real>(1, spanned / whole));
  return result;
}

}  // namespace touchstone::grade
