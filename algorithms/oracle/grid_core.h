// Part of the oracle: one core of a pair, in doubles for the filters and in integers for the
// proofs.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/exact_matrix.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// A direction in integers, and in doubles a positive multiple of it: each component is off by at
// most 2^-52, and the greatest magnitude is between 1/4 and 1.
struct Direction {
  IntegerVector exact;
  Vec3d rounded;
};
Direction make_direction(IntegerVector exact);

// Integers that enclose a support value; equal if the value is known exactly.
struct SupportBounds {
  Integer low, high;
};

class GridCore {
 public:
  // Coordinates in doubles are in the pair's unit, relative to body a's origin. They are at most 5
  // in magnitude and off by at most this.
  static constexpr double coordinate_error = 0x1p-47;
  // Error bound of their dot product with a direction whose greatest component is 1.
  static constexpr double dot_error = 0x1p-44;

  // `matrix` is the body's linear part times a power of two, so that no entry is beyond 1. `scale`
  // is the power of two that takes the solid's filter coordinates, multiplied by the matrix, to the
  // pair's unit, in which `sweep` is what the body is swept by.
  void place(const Body& body, const Mat3d& matrix, double scale, const Vec3d& origin,
             const Vec3d& sweep);

  // Number of generators: the vertices of a polytope, and those at the end of a sweep behind them, or
  // the points of a curved core made so far.
  std::size_t size() const { return x_.size(); }
  const Solid& solid() const { return *solid_; }
  const Vec3d& origin() const { return origin_; }  // the body's origin
  Vec3d rounded(std::uint32_t i) const { return {x_[i], y_[i], z_[i]}; }
  Generator generator(std::uint32_t i) const;
  // Returns a vertex that is furthest, up to rounding. For a curved core it makes a new point,
  // which lies in the core for certain and is furthest up to the rounding of long double.
  std::uint32_t support(const Vec3d& direction);

  // Sets the coordinates as integers: multiples of 2^exponent over the product of the pair's
  // denominators, relative to body a's origin. `others` is the denominator of the other body's
  // matrix. `sweep` is in the same unit.
  void place_exactly(const ExactMatrix& matrix, long exponent, const Integer& others,
                     const IntegerVector& origin, IntegerVector sweep);
  const IntegerVector& exact(std::uint32_t i);
  // Returns a furthest vertex; for a curved core, a point as in `support`.
  std::uint32_t exact_support(const Direction& direction, double filter_scale);
  // Bounds on the greatest direction . x over the whole core, times 2^shift.
  SupportBounds support_bounds(const IntegerVector& direction, int shift) const;

 private:
  Vec3d turned(const Vec3d& local) const { return scale_ * (matrix_ * local) + origin_; }
  std::uint32_t add_point(const Vec3<long double>& local_direction, bool at_end);
  // True for a generator at the end of the sweep.
  bool is_at_end(std::uint32_t i) const {
    return solid_->is_curved() ? at_end_[i] != 0 : i >= solid_->x.size();
  }
  bool holds(const std::array<std::int64_t, 3>& point) const;
  Integer extent(int k) const;  // of a curved core, in steps of the solid's grid

  const Solid* solid_ = nullptr;
  Mat3d matrix_;
  double scale_ = 1;
  Vec3d origin_;
  std::vector<double> x_, y_, z_;
  std::vector<std::array<std::int64_t, 3>> points_;  // of a curved core, in grid steps
  std::vector<std::uint8_t> at_end_;                 // for each of these
  bool is_swept_ = false;
  Vec3d sweep_;
  IntegerVector exact_sweep_;
  // One step of the solid's grid along each axis; for a box, its half extents.
  std::array<IntegerVector, 3> columns_;
  IntegerVector exact_origin_;
  std::vector<IntegerVector> exact_;
  std::vector<std::uint8_t> known_;
};

}  // namespace touchstone::oracle
