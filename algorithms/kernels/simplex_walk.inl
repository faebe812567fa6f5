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

// One walk, a step in two halves.
template <class Scalar>
class Walker {
 public:
  TOUCHSTONE_TARGET void start(SupportPair<Scalar>& pair, Scalar tolerance, Walk<Scalar>& found) {
    pair_ = &pair;
    found_ = &found;
    tolerance_ = tolerance;
    apart_ = pair.radius() + SupportPair<Scalar>::rounding;
    nearest_ = std::numeric_limits<Scalar>::infinity();
    way_ = -pair.centre_b();
    if (!(way_.squaredNorm() > shortest)) way_ = Vec3<Scalar>::UnitX();
  }

  TOUCHSTONE_TARGET void look() { point_ = pair_->template support<Scan>(-way_); }

  // True at the walk's end.
  TOUCHSTONE_TARGET bool step(const WalkGoal& goal) {
    Simplex<Scalar>& simplex = found_->simplex;
    ++found_->iterations;
    found_->lower = way_.dot(point_.difference) / way_.norm();
    if (found_->lower > apart_ && (goal.only_apart || nearest_ - found_->lower <= tolerance_)) {
      found_->end = goal.only_apart ? WalkEnd::apart : WalkEnd::near;
      found_->way = way_;
      return true;
    }
    for (int i = 0; i < simplex.size; ++i) {
      if (simplex.points[i].difference == point_.difference) return true;
    }
    simplex.points[simplex.size++] = point_;
    way_ = reduce_quickly(simplex);
    if (simplex.size == 4) {
      if (is_surely_inside(simplex)) found_->end = WalkEnd::inside;
      return true;
    }
    const Scalar squared = way_.squaredNorm();
    const Scalar before = nearest_;
    nearest_ = way_.dot(simplex.points[0].difference) / std::sqrt(squared);
    // So written that NaN ends the walk.
    return !(squared > shortest) || !(nearest_ < before) ||
           found_->iterations >= goal.most_iterations;
  }

 private:
  // Shorter ones have lost their digits, or are about to. (Squares of lengths.)
  static constexpr Scalar shortest = sizeof(Scalar) == 8 ? Scalar{1e-200} : Scalar{1e-24f};

  SupportPair<Scalar>* pair_;
  Walk<Scalar>* found_;
  Scalar tolerance_, apart_, nearest_;
  Vec3<Scalar> way_;
  DifferencePoint<Scalar> point_;
};

template <class Scalar>
TOUCHSTONE_TARGET void walk_all(std::span<WalkTask<Scalar>> tasks, const WalkGoal& goal) {
  std::array<Walker<Scalar>, side_by_side> walkers;
  std::size_t next = 0, walking = 0;
  const auto start = [&](Walker<Scalar>& walker) TOUCHSTONE_TARGET {
    WalkTask<Scalar>& task = tasks[next++];
    walker.start(*task.pair, task.tolerance, task.found);
  };
  while (walking < side_by_side && next < tasks.size()) start(walkers[walking++]);
  while (walking > 0) {
    for (std::size_t i = 0; i < walking; ++i) walkers[i].look();
    for (std::size_t i = walking; i-- > 0;) {
      if (!walkers[i].step(goal)) continue;
      if (next < tasks.size()) {
        start(walkers[i]);
      } else {
        walkers[i] = walkers[--walking];
      }
    }
  }
}
