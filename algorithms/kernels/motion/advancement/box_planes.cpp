// Gaps along the fifteen axes of two boxes, and the rates at which they close.
#include "algorithms/kernels/motion/advancement/box_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/motion/advancement/round_cores.h"
#include "algorithms/kernels/motion/advancement/turning_normal.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using simd::Quad;

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

double sign_of(double x) { return std::copysign(1.0, x); }

struct Axis {
  int of_a, of_b;  // a face of either, the other being -1, or an edge of each
  double sense;

  bool is_face_of_a() const { return of_b < 0; }
  bool is_face_of_b() const { return of_a < 0; }
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
  // The unit vector along an axis.
  Vec3d direction(int axis) const {
    constexpr double rounding = 1e-14;
    const Vec3d column = per_column * matrix.col(axis);
    if (std::abs(column.squaredNorm() - 1) < rounding) return column;
    return column.normalized();
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

// The offset of the centres and its rates as seen from each body, which turns, and how b turns as seen from a; in world
// axes.
struct BoxRates {
  Vec3d offset, offset_rate_a, offset_rate_b, turn;
};

constexpr double nearly_parallel_square = 0.05 * 0.05;

// A row for the faces of a and for those of b, and one for each edge of a with those of b.
struct Gaps {
  static constexpr int rows = 5;
  double least;
  // The vectors along the axes, whose signs are the senses; gaps times a length, and the square of that; for how long
  // gaps last, if they are wide enough, or -1.
  Quad<double> sense[rows], gap[rows], square[rows], lasts[rows];

  Axis axis(int row, int lane) const {
    return {row == 1   ? -1
            : row == 0 ? lane
                       : row - 2,
            row == 0 ? -1 : lane, sign_of(sense[row][lane])};
  }
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/motion/advancement/box_gaps.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

void measure(const Box& a, const Box& b, const BoxRates& rates, Gaps& gaps) {
  switch (isa()) {
    case Isa::avx512: avx512::measure_at(a, b, rates, gaps); break;
    case Isa::avx2: avx2::measure_at(a, b, rates, gaps); break;
    default: baseline::measure_at(a, b, rates, gaps);
  }
}

struct Choice {
  BoxLook::State state;
  Axis axis;
};

// The axis whose gap lasts longest, or if none is wide enough, the one with the widest gap.
Choice choose(const Gaps& gaps) {
  int row = 0, lane = 0;
  double longest = -1;
  for (int r = 0; r < Gaps::rows; ++r) {
    for (int k = 0; k < 3; ++k) {
      const bool longer = gaps.lasts[r][k] > longest;
      longest = longer ? gaps.lasts[r][k] : longest;
      row = longer ? r : row;
      lane = longer ? k : lane;
    }
  }
  if (longest > 0) return {BoxLook::State::open, gaps.axis(row, lane)};
  double widest = -std::numeric_limits<double>::infinity();  // squared, with its sign
  for (int r = 0; r < Gaps::rows; ++r) {
    for (int k = 0; k < 3; ++k) {
      if (!(gaps.square[r][k] > nearly_parallel_square)) continue;
      const double gap = gaps.gap[r][k] * std::abs(gaps.gap[r][k]) / gaps.square[r][k];
      if (!(gap > widest)) continue;
      widest = gap;
      row = r;
      lane = k;
    }
  }
  const bool near = widest > -gaps.least * gaps.least;
  return {near ? BoxLook::State::near : BoxLook::State::overlap, gaps.axis(row, lane)};
}

}  // namespace

BoxLook look_at_boxes(SupportPair<double>& pair, const PairMotion& motion, double least_gap) {
  const Box a(pair.a(), pair.unit()), b(pair.b(), pair.unit());
  const Vec3d& offset = pair.centre_b();
  const Vec3d velocity = motion.velocity / pair.unit();
  Gaps gaps;
  gaps.least = least_gap;
  measure(a, b,
          {offset, velocity - motion.turn_a.cross(offset), velocity - motion.turn_b.cross(offset),
           motion.turn_b - motion.turn_a},
          gaps);
  const auto [state, axis] = choose(gaps);
  BoxLook look;
  look.state = state;
  if (look.state == BoxLook::State::overlap) return look;
  const bool is_open = look.state == BoxLook::State::open;
  if (axis.is_face_of_a()) {
    look.normal = axis.sense * a.direction(axis.of_a);
    look.turning = motion.turn_a;
    if (is_open) return look;
    look.on_b = pair.b().support(-look.normal);
    look.on_a = a.nearest(offset + look.on_b);
  } else if (axis.is_face_of_b()) {
    look.normal = axis.sense * b.direction(axis.of_b);
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
