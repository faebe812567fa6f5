// The nearest point of a segment to a box, in vectors of eight numbers. plain_capsule_box.cpp includes
// this file once for each level of vector instructions, inside that level's namespace.

using Eight __attribute__((vector_size(8 * sizeof(double)))) = double;

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Eight all(double x) { return Eight{x, x, x, x, x, x, x, x}; }
TOUCHSTONE_TARGET TOUCHSTONE_INLINE double greatest(const Eight& x) {
  const auto greater = [](const Quad<double>& p, const Quad<double>& q)
                           TOUCHSTONE_TARGET { return p > q ? p : q; };
  const Quad<double> four =
      greater(__builtin_shufflevector(x, x, 0, 1, 2, 3), __builtin_shufflevector(x, x, 4, 5, 6, 7));
  const Quad<double> two = greater(four, __builtin_shufflevector(four, four, 2, 3, 0, 1));
  return two[0] > two[1] ? two[0] : two[1];
}

// The t in [-1, 1] at which q + t d is nearest to the box with these half extents around the origin,
// in the axes of the box. The square of the distance is convex along the segment. Half its slope is
// the sum of d_k (x_k - x_k clamped to the box), which is linear between the places where a coordinate
// passes a face: these six and the two ends bracket the zero, and a line between the two that are next
// to it has it.
TOUCHSTONE_TARGET TOUCHSTONE_INLINE double nearest_to_box(const Vec& q, const Vec& d,
                                                          const Vec3d& half) {
  const double x = half[0], y = half[1], z = half[2];
  const Eight to_face = {x - q.x, -x - q.x, y - q.y, -y - q.y, z - q.z, -z - q.z, 1, -1};
  const Eight along = {d.x, d.x, d.y, d.y, d.z, d.z, 1, 1};
  // A coordinate that does not change gives an infinity, or NaN, and so an end.
  Eight t = to_face / along;
  t = t < 1 ? t : all(1);
  t = t > -1 ? t : all(-1);
  const auto slope_of = [&](double start, double step, double most) TOUCHSTONE_TARGET {
    const Eight at = start + t * step;
    const Eight above = at < most ? at : all(most);
    return step * (at - (above > -most ? above : all(-most)));
  };
  const Eight slope = slope_of(q.x, d.x, x) + slope_of(q.y, d.y, y) + slope_of(q.z, d.z, z);
  const double at_end = slope[6], at_start = slope[7];
  if (!(at_start < 0)) return at_end > 0 ? -1 : 0;
  if (!(at_end > 0)) return 1;
  constexpr double none = -std::numeric_limits<double>::infinity();
  const double low = greatest(slope > 0 ? all(-1) : t);
  const double high = -greatest(slope < 0 ? all(-1) : -t);
  const double slope_low = greatest(slope > 0 ? all(none) : slope);
  const double slope_high = -greatest(slope < 0 ? all(none) : -slope);
  const double rise = slope_high - slope_low;
  return rise > 0 ? low - (high - low) * slope_low / rise : (low + high) / 2;
}

TOUCHSTONE_TARGET bool solve_capsule_box(Task task, const Shape& capsule, const Pose& pose_a,
                                         const Shape& box, const Pose& pose_b, Outcome& outcome,
                                         double margin) {
  const Vec centre = read(pose_b.translation) - read(pose_a.translation);
  const Vec half = half_of(capsule, pose_a);
  const Vec x = column(pose_b.rotation, 0), y = column(pose_b.rotation, 1),
            z = column(pose_b.rotation, 2);
  const Vec q{-dot(x, centre), -dot(y, centre), -dot(z, centre)};
  const Vec d{dot(x, half), dot(y, half), dot(z, half)};
  const double t = nearest_to_box(q, d, box.half_extents);
  return solve_at(task, margin, t, {centre, half, x, y, z, q, d}, capsule.radius, pose_a,
                  box.half_extents, outcome);
}
