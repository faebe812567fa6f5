// Gaps along the fifteen axes of two boxes, and the rates at which they close.
#include "algorithms/kernels/motion/advancement/box_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/motion/advancement/round_cores.h"
#include "algorithms/kernels/motion/advancement/turning_normal.h"

namespace touchstone {
namespace {

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

double sign_of(double x) { return std::copysign(1.0, x); }

struct Axis {
  int of_a = -1, of_b = -1;  // a face of either, or an edge of each
  double sense = 1;

  bool is_face_of_a() const { return of_b < 0; }
  bool is_face_of_b() const { return of_a < 0; }
};

// The axis whose gap lasts longest, or if none is wide enough, the one with the widest gap.
class Choice {
 public:
  explicit Choice(double least_gap) : least_gap_(least_gap) {}

  // Gap and rate are times `length`, of which the square is given. Returns whether the rate is needed.
  bool is_open(double gap, double square, const Axis& axis) {
    if (gap > 0 && gap * gap > least_gap_ * least_gap_ * square) return true;
    if (!is_open_ && gap * std::abs(gap) > widest_ * square) {
      widest_ = gap * std::abs(gap) / square;
      axis_ = axis;
    }
    return false;
  }
  void consider(double gap, double rate, const Axis& axis) {
    constexpr double least_rate = 1e-3;  // a gap that hardly closes lasts for as long as it is wide
    const double closing = std::max(-rate, least_rate * gap);
    if (!(gap * closing_ > gap_ * closing)) return;
    gap_ = gap;
    closing_ = closing;
    axis_ = axis;
    is_open_ = true;
  }

  BoxLook::State state() const {
    if (is_open_) return BoxLook::State::open;
    return widest_ > -least_gap_ * least_gap_ ? BoxLook::State::near : BoxLook::State::overlap;
  }
  const Axis& axis() const { return axis_; }

 private:
  double least_gap_, gap_ = 0, closing_ = 1;
  // The widest gap, squared with its sign.
  double widest_ = -std::numeric_limits<double>::infinity();
  bool is_open_ = false;
  Axis axis_;
};

// A box about its centre, in the pair's unit.
struct Box {
  explicit Box(const PosedShape<double>& shape, double unit)
      : matrix(shape.matrix()),
        per_column(unit / shape.shape().unit),
        extents(shape.shape().extents / per_column) {}

  // A vector in the box's axes.
  Vec3d seen(const Vec3d& v) const { return per_column * (matrix.transpose() * v); }
  // The point of the box that is nearest to a point.
  Vec3d nearest(const Vec3d& point) const {
    return per_column * (matrix * seen(point).cwiseMax(-extents).cwiseMin(extents));
  }
  // Half an edge along an axis.
  Vec3d half_edge(int axis) const { return extents[axis] * per_column * matrix.col(axis); }
  // The middle of the edge along an axis that is furthest in the direction.
  Vec3d edge_middle(int axis, const Vec3d& direction) const {
    const int k = next(axis), l = next(k);
    const auto side = [&](int i) -> Vec3d {
      return sign_of(matrix.col(i).dot(direction)) * half_edge(i);
    };
    return side(k) + side(l);
  }

  const Mat3d& matrix;
  double per_column;  // a power of two: one by the length of the columns, up to rounding
  Vec3d extents;
};

Choice choose_axis(const Box& a, const Box& b, const Vec3d& offset, const Vec3d& velocity,
                   const PairMotion& motion, double least_gap) {
  const Vec3d &p = a.extents, &q = b.extents;
  // The offset and its rate as seen from a and from b, and the axes of b as seen from a.
  const Vec3d c = a.seen(offset), v = a.seen(velocity - motion.turn_a.cross(offset));
  const Vec3d d = b.seen(offset), w = b.seen(velocity - motion.turn_b.cross(offset));
  const Vec3d turn = a.seen(motion.turn_b - motion.turn_a);
  const Mat3d m = a.per_column * b.per_column * (a.matrix.transpose() * b.matrix);
  Mat3d rate, size, size_rate;  // the rates of m, and |m|
  for (int j = 0; j < 3; ++j) {
    rate.col(j) = turn.cross(m.col(j));
    for (int i = 0; i < 3; ++i) {
      size(i, j) = std::abs(m(i, j));
      size_rate(i, j) = sign_of(m(i, j)) * rate(i, j);
    }
  }
  Choice best(least_gap);
  for (int i = 0; i < 3; ++i) {
    const Axis axis{i, -1, sign_of(c[i])};
    const double gap = std::abs(c[i]) - p[i] - size.row(i).dot(q);
    if (best.is_open(gap, 1, axis)) {
      best.consider(gap, axis.sense * v[i] - size_rate.row(i).dot(q), axis);
    }
  }
  for (int j = 0; j < 3; ++j) {
    const Axis axis{-1, j, sign_of(d[j])};
    const double gap = std::abs(d[j]) - q[j] - size.col(j).dot(p);
    if (best.is_open(gap, 1, axis)) {
      best.consider(gap, axis.sense * w[j] - size_rate.col(j).dot(p), axis);
    }
  }
  constexpr double nearly_parallel = 0.05;
  for (int i = 0; i < 3; ++i) {
    const int k = next(i), l = next(k);
    for (int j = 0; j < 3; ++j) {
      const int s = next(j), t = next(s);
      const double square = m(k, j) * m(k, j) + m(l, j) * m(l, j);
      if (!(square > nearly_parallel * nearly_parallel)) continue;
      const double along = c[l] * m(k, j) - c[k] * m(l, j);
      const Axis axis{i, j, sign_of(along)};
      const double gap = std::abs(along) - p[k] * size(l, j) - p[l] * size(k, j) -
                         q[s] * size(i, t) - q[t] * size(i, s);
      if (!best.is_open(gap, square, axis)) continue;
      const double change = v[l] * m(k, j) + c[l] * rate(k, j) - v[k] * m(l, j) - c[k] * rate(l, j);
      best.consider(gap,
                    axis.sense * change - p[k] * size_rate(l, j) - p[l] * size_rate(k, j) -
                        q[s] * size_rate(i, t) - q[t] * size_rate(i, s),
                    axis);
    }
  }
  return best;
}

}  // namespace

BoxLook look_at_boxes(SupportPair<double>& pair, const PairMotion& motion, double least_gap) {
  const Box a(pair.a(), pair.unit()), b(pair.b(), pair.unit());
  const Vec3d& offset = pair.centre_b();
  const Choice choice = choose_axis(a, b, offset, motion.velocity / pair.unit(), motion, least_gap);
  const Axis& axis = choice.axis();
  BoxLook look;
  look.state = choice.state();
  if (look.state == BoxLook::State::overlap) return look;
  const bool is_open = look.state == BoxLook::State::open;
  if (axis.is_face_of_a()) {
    look.normal = axis.sense * a.per_column * a.matrix.col(axis.of_a);
    look.turning = motion.turn_a;
    if (is_open) return look;
    look.on_b = pair.b().support(-look.normal);
    look.on_a = a.nearest(offset + look.on_b);
  } else if (axis.is_face_of_b()) {
    look.normal = axis.sense * b.per_column * b.matrix.col(axis.of_b);
    look.turning = motion.turn_b;
    if (is_open) return look;
    look.on_a = pair.a().support(look.normal);
    look.on_b = b.nearest(look.on_a - offset);
  } else {
    const Vec3d edge_a = a.half_edge(axis.of_a), edge_b = b.half_edge(axis.of_b);
    const Vec3d along_a = a.matrix.col(axis.of_a), along_b = b.matrix.col(axis.of_b);
    look.normal = axis.sense * along_a.cross(along_b).normalized();
    look.turning =
        turning_across_edges(along_a, along_b, look.normal, motion.turn_a, motion.turn_b);
    if (is_open) return look;
    const Vec3d middle_a = a.edge_middle(axis.of_a, look.normal),
                middle_b = b.edge_middle(axis.of_b, -look.normal);
    const ClosestOfRound closest =
        closest_of_segments(edge_a, edge_b, offset + middle_b - middle_a);
    look.on_a = middle_a + closest.on_a;
    look.on_b = middle_b + closest.on_b;
  }
  return look;
}

}  // namespace touchstone
