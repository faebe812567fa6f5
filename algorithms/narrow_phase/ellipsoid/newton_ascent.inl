// Part of ellipsoid: the loop of the ascent of ellipsoid_pair.h. ellipsoid_pair.cpp includes this
// file once for each level of vector instructions, inside that level's namespace. Results are equal
// at every level. All functions called here are inlined, since others are compiled without the
// level's instructions.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN Climb<Scalar> climb_at(const EllipsoidPair<Scalar>& pair,
                                                            const Vec3<Scalar>& start,
                                                            const ClimbGoal& goal,
                                                            Scalar tolerance) {
  constexpr Scalar rounding = EllipsoidPair<Scalar>::rounding;
  constexpr Scalar noise = rounding / 4;
  // Beyond this slide witness points within the tolerance would still be oblique.
  const Scalar askew =
      std::max(tolerance, sizeof(Scalar) == 8 ? static_cast<Scalar>(1e-10) : rounding);
  const Scalar inside = std::max(pair.radius - rounding, Scalar{0});
  const Scalar far = goal.only_apart ? rounding : rounding + static_cast<Scalar>(goal.margin);
  Climb<Scalar> found;
  std::array<EllipsoidPlane<Scalar>, 2> planes;
  int here = 0;
  planes[here] = EllipsoidPlane<Scalar>(pair, start);
  Scalar damping = 0;
  // This form of the comparisons rejects a step to NaN.
  const auto is_better = [&](const EllipsoidPlane<Scalar>& next, const EllipsoidPlane<Scalar>& at) {
    return next.gap > at.gap + noise ||
           (next.gap > at.gap - noise && next.slide_squared < at.slide_squared);
  };
  const auto end = [&](ClimbEnd how) {
    found.end = how;
    found.plane = planes[here];
    return found;
  };
  while (found.iterations < goal.most_iterations) {
    ++found.iterations;
    const EllipsoidPlane<Scalar>& at = planes[here];
    const Scalar slide = at.slide_squared;
    const bool apart = at.gap - pair.radius > rounding;
    if (at.gap - pair.radius > far) return end(ClimbEnd::apart);
    if (goal.only_verdict && at.between.squaredNorm() < inside * inside) {
      return end(ClimbEnd::inside);
    }
    // The distance of the two points exceeds the gap by at most slide^2 / (2 gap).
    const bool near = at.gap > 0 && slide <= 2 * tolerance * at.gap;
    if (slide <= tolerance * tolerance || (near && slide <= askew * askew)) {
      return end(apart ? ClimbEnd::apart : ClimbEnd::stationary);
    }
    const Curvature<Scalar> curvature(pair, at);
    Scalar shift = at.gap;
    // If the function is not concave here, the curvature alone still gives an ascent direction.
    if (shift < 0 && !(curvature.determinant(shift) > 0 && curvature.trace() + 2 * shift > 0)) {
      shift = -curvature.least() / 2;
    }
    for (bool newton = true;; newton = !newton) {
      const Vec3<Scalar> step = curvature.solve(at.slide, shift + damping);
      const Vec3<Scalar> ahead = newton ? Vec3<Scalar>(at.normal + step) : reweighted(pair, at);
      planes[1 - here] = EllipsoidPlane<Scalar>(pair, unit_vector(ahead));
      if (is_better(planes[1 - here], at)) {
        here = 1 - here;
        damping = newton ? damping / 16 : Scalar{0};
        break;
      }
      // True if even a short step does not ascend.
      const bool spent = !newton && !(step.squaredNorm() > noise * noise);
      if (spent || found.iterations >= goal.most_iterations) return end(ClimbEnd::stuck);
      ++found.iterations;
      if (!newton) damping = std::max(8 * damping, curvature.trace() + std::abs(at.gap)) / 2;
    }
  }
  return end(ClimbEnd::stuck);
}
