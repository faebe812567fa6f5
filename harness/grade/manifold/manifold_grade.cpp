// Grades contact manifolds against exact distances and touching areas, tabulates the grades, and
// lists the limits that ours exceed.
#include "harness/grade/manifold/manifold_grade.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "algorithms/hull/convex_hull.h"
#include "harness/grade/manifold/touching_area.h"
#include "harness/grade/margins.h"
#include "harness/process/solve_case.h"

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

namespace {

// The limits of our algorithms, as parts of the size.
struct Limits {
  double off_body, depth_error;
};
constexpr Limits limits_of(Precision scalar) {
  return scalar == Precision::float64 ? Limits{1e-13, 1e-8} : Limits{1e-4, 1e-4};
}
// Points of cylinders, cones and ellipsoids are found to the tolerance of EPA, a billionth, along their surface.
double off_line_limit(const files::Case& c, Precision scalar) {
  const auto is_curved = [](const Shape& shape) {
    return shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone ||
           shape.kind == ShapeKind::ellipsoid;
  };
  const double usual = limits_of(scalar).off_body;
  return is_curved(c.shape_a) || is_curved(c.shape_b) ? std::max(usual, 1e-9) : usual;
}
constexpr double least_area = 0.9;  // as a part of the best four, in double

const std::vector<std::string> header = {
    "pairs", "algorithm",         "asked",  "missed",     "points", "off body", "depth error",
    "apart", "area of best four", "(mean)", "area of all"};

std::string length(double x) { return x == 0 ? "0" : fmt::format("{:.1e}", x); }

}  // namespace

void ManifoldTally::add(const std::string& family, const std::string& algorithm,
                        const AlgorithmInfo& info, Precision scalar, const files::Case& c,
                        const ManifoldTruth& truth, const Manifold& manifold) {
  const Key key{family, algorithm};
  auto at = std::ranges::find(rows_, key, [](const auto& row) { return row.first; });
  if (at == rows_.end()) at = rows_.insert(rows_.end(), {key, Worst()});
  Worst& worst = at->second;
  const ManifoldGrade graded = grade(c, truth, manifold);
  ++worst.asked;
  worst.missed += graded.missed ? 1 : 0;
  if (manifold.count > 0) {
    worst.least_points = std::min(worst.least_points, manifold.count);
    worst.most_points = std::max(worst.most_points, manifold.count);
  }
  worst.off_body = std::max(worst.off_body, graded.off_body);
  worst.depth_error = std::max(worst.depth_error, graded.depth_error);
  worst.apart = std::max(worst.apart, graded.apart);
  if (graded.of_best_four) {
    ++worst.with_area;
    worst.of_best_four = std::min(worst.of_best_four, *graded.of_best_four);
    worst.sum_of_best_four += *graded.of_best_four;
    worst.of_all = std::min(worst.of_all, *graded.of_all);
  }

  if (info.origin != Origin::ours || manifold.status == Status::unsupported) return;
  const Limits limits = limits_of(scalar);
  const double rounding = coordinate_rounding(c, truth);
  const auto wrong = [&](std::string_view what, double value) {
    wrong_.push_back(fmt::format("{}, {} of case '{}': {} {}", info.name, to_string(scalar), c.id,
                                 what, length(value)));
  };
  if (graded.missed && manifold.status == Status::ok)
    wrong("no point of bodies as deep as", truth.depth);
  if (graded.off_body > limits.off_body + rounding)
    wrong("a point off its body by", graded.off_body);
  if (graded.off_line > off_line_limit(c, scalar) + 2 * rounding) {
    wrong("points apart by another depth by", graded.off_line);
  }
  if (manifold.status == Status::ok && graded.depth_error > limits.depth_error + rounding) {
    wrong("a depth off by", graded.depth_error);
  }
  if (scalar == Precision::float64 && graded.of_best_four && *graded.of_best_four < least_area) {
    wrong("of the area of the best four only", *graded.of_best_four);
  }
}

std::vector<std::vector<std::string>> ManifoldTally::cells() const {
  std::vector<std::vector<std::string>> all;
  for (const auto& [key, worst] : rows_) {
    const auto area = [&](double x) {
      return worst.with_area > 0 ? fmt::format("{:.4f}", x) : std::string();
    };
    const std::string points = worst.most_points == 0 ? ""
                               : worst.least_points == worst.most_points
                                   ? fmt::format("{}", worst.most_points)
                                   : fmt::format("{} to {}", worst.least_points, worst.most_points);
    const double mean =
        worst.sum_of_best_four / static_cast<double>(std::max<std::size_t>(1, worst.with_area));
    all.push_back({key.family, key.algorithm, fmt::format("{}", worst.asked),
                   fmt::format("{}", worst.missed), points, length(worst.off_body),
                   length(worst.depth_error), length(worst.apart), area(worst.of_best_four),
                   area(mean), area(worst.of_all)});
  }
  return all;
}

base::Table ManifoldTally::table() const {
  base::Table table(header, 2);
  for (std::vector<std::string>& row : cells()) table.add(std::move(row));
  return table;
}

}  // namespace touchstone::grade
