// The loop of simplex_walk.h. Included by simplex_walk.cpp once for each level of vector
// instructions, inside that level's namespace; the same at every level.

struct Scan {
  static constexpr bool climbs = true;
  template <class Scalar>
  TOUCHSTONE_TARGET static std::uint32_t furthest(const SupportShape<Scalar>& hull,
                                                  const Vec3<Scalar>& d) {
    return furthest_at(std::span<const hull_scan::VertexBlock<Scalar>>(hull.vertices), d).index;
  }
};

template <class Scalar>
TOUCHSTONE_TARGET Walk<Scalar> walk_at(SupportPair<Scalar>& pair, const WalkGoal& goal,
                                       Scalar tolerance) {
  constexpr Scalar rounding = SupportPair<Scalar>::rounding;
  // Shorter ones have lost their digits, or are about to. (Squares of lengths.)
  constexpr Scalar shortest = sizeof(Scalar) == 8 ? Scalar{1e-200} : Scalar{1e-24f};
  Walk<Scalar> found;
  Simplex<Scalar>& simplex = found.simplex;
  const Scalar apart = pair.radius() + rounding;
  Vec3<Scalar> way = -pair.centre_b();
  if (!(way.squaredNorm() > shortest)) way = Vec3<Scalar>::UnitX();
  Scalar nearest = std::numeric_limits<Scalar>::infinity();
  while (found.iterations < goal.most_iterations) {
    ++found.iterations;
    const DifferencePoint<Scalar> point = pair.template support<Scan>(-way);
    const Scalar length = way.norm();
    found.lower = way.dot(point.difference) / length;
    if (found.lower > apart && (goal.only_apart || nearest - found.lower <= tolerance)) {
      found.end = goal.only_apart ? WalkEnd::apart : WalkEnd::near;
      found.way = way;
      return found;
    }
    for (int i = 0; i < simplex.size; ++i) {
      if (simplex.points[i].difference == point.difference) return found;
    }
    simplex.points[simplex.size++] = point;
    way = reduce_quickly(simplex);
    if (simplex.size == 4) {
      if (is_surely_inside(simplex)) found.end = WalkEnd::inside;
      return found;
    }
    const Scalar squared = way.squaredNorm();
    // So written that NaN ends the walk.
    if (!(squared > shortest)) return found;
    const Scalar before = nearest;
    nearest = way.dot(simplex.points[0].difference) / std::sqrt(squared);
    if (!(nearest < before)) return found;
  }
  return found;
}
