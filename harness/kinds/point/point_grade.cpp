// Grades answers about points.
#include "harness/kinds/point/point_grade.h"

#include <algorithm>
#include <cmath>

#include "harness/kinds/grading.h"

namespace touchstone::kinds {

double point_reach(const Vec3d& point, const TriangleMesh& mesh) {
  double reach = point.norm();
  for (const Vec3d& v : mesh.vertices) reach = std::max(reach, v.norm());
  return reach;
}

Graded grade_point(PointTask task, const PointAnswer& answer, const PointAnswer& exact,
                   Precision scalar, double reach) {
  const bool is_side = task == PointTask::side;
  const bool is_contact = is_side ? exact.side != PointSide::outside : exact.distance == 0;
  const auto with = [&](Grade grade) { return Graded{grade, is_contact}; };
  const bool is_unknown = is_side && answer.side == PointSide::unknown;
  if (const auto by_status = grade_of_status(answer.status, is_unknown)) return with(*by_status);
  if (is_side) {
    const bool contact = answer.side != PointSide::outside;
    if (const auto by_verdict = grade_of_verdict(contact, is_contact)) return with(*by_verdict);
    return with(answer.side == exact.side ? Grade::right : Grade::inexact);
  }
  if (std::isnan(exact.distance) && std::isnan(answer.distance)) return with(Grade::right);
  const double margin = scalar == Precision::float64 ? point_margin_double : point_margin_float;
  const bool is_near = std::abs(answer.distance - exact.distance) <= margin * reach;
  return with(is_near ? Grade::right : Grade::inexact);
}

}  // namespace touchstone::kinds
