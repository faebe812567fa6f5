// Grades answers about bodies that need not be convex.
#include "harness/kinds/mesh/mesh_grade.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/kinds/grading.h"

namespace touchstone::kinds {

double mesh_reach(const ConcaveBody& a, const Pose& pose_a, const ConcaveBody& b,
                  const Pose& pose_b) {
  constexpr double convex_size = 4;  // of families and timed sets, metres
  double reach = 1;
  for (const auto& [body, pose] : {std::pair(&a, &pose_a), std::pair(&b, &pose_b)}) {
    double size = convex_size;
    if (body->mesh) {
      for (const Vec3d& v : body->mesh->vertices) size = std::max(size, v.cwiseAbs().maxCoeff());
    }
    reach = std::max(reach, 2 * size + pose->translation.cwiseAbs().maxCoeff());
  }
  return reach;
}

Graded grade_mesh(ConcaveTask task, const MeshAnswer& answer, const MeshAnswer& exact,
                  const MeshAnswer* exact_distance, Precision scalar, double reach) {
  const bool is_contact = exact.answer == Answer::touching || exact.answer == Answer::overlapping;
  const auto with = [&](Grade grade) { return Graded{grade, is_contact}; };
  if (const auto by_status = grade_of_status(answer.status, answer.answer == Answer::unknown)) {
    return with(*by_status);
  }
  if (exact.answer == Answer::unknown) return with(Grade::unresolved);
  const bool contact = answer.answer != Answer::separated;
  if (const auto by_verdict = grade_of_verdict(contact, is_contact)) return with(*by_verdict);
  if (task == ConcaveTask::contacts && exact.status == Status::ok &&
      (answer.pairs != exact.pairs || answer.hash != exact.hash)) {
    return with(Grade::inexact);
  }
  if (task == ConcaveTask::distance && !contact) {
    const double margin =
        (scalar == Precision::float64 ? mesh_margin_double : mesh_margin_float) * reach;
    const bool bounds_hold = std::isnan(answer.lower) || (answer.lower <= exact_distance->upper &&
                                                          answer.upper >= exact_distance->lower);
    const bool is_near = answer.distance >= exact_distance->lower - margin &&
                         answer.distance <= exact_distance->upper + margin;
    if (!is_near || !bounds_hold) return with(Grade::inexact);
  }
  return with(Grade::right);
}

}  // namespace touchstone::kinds
