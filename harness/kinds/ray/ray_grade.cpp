// Grades answers about rays.
#include "harness/kinds/ray/ray_grade.h"

#include <cmath>

#include "harness/kinds/grading.h"

namespace touchstone::kinds {

Graded grade_ray(RayTask task, const RayHit& hit, const RayHit& exact, const RayCastEntry& entry,
                 Precision scalar, double size) {
  const auto with = [&](Grade grade) { return Graded{grade, exact.hit}; };
  if (const auto by_status = grade_of_status(hit.status, false)) return with(*by_status);
  if (const auto by_verdict = grade_of_verdict(hit.hit, exact.hit)) return with(*by_verdict);
  if (!hit.hit || task == RayTask::any) return with(Grade::right);
  const bool is_exact = scalar == Precision::float64 || entry.exact_verdicts;
  const double margin =
      (is_exact ? ray_margin_exact : ray_margin_float) * (std::abs(exact.t) + size);
  const bool is_other = entry.exact_verdicts && hit.triangle != exact.triangle;
  if (is_other || !(std::abs(hit.t - exact.t) <= margin)) return with(Grade::inexact);
  return with(Grade::right);
}

}  // namespace touchstone::kinds
