// One core of a pair: in doubles for the filters and in integers for the proofs.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/exact_matrix.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// A direction as integers, and as doubles: those of a positive multiple of it, off by at most 2^-52
// in each component, the greatest of which is between 1/4 and 1.
struct Direction {
  IntegerVector exact;
  Vec3d rounded;
};
Direction make_direction(IntegerVector exact);

// Between which integers a support value lies; equal where it is known exactly.
struct SupportBounds {
  Integer low, high;
};

class GridCore {
 public:
  // Coordinates in doubles are in the pair's unit, relative to body a's origin. They are at most 5
  // in magnitude and off by at most this ...
  static constexpr double coordinate_error = 0x1p-47;
  // ... and their dot products with a direction whose greatest component is 1 by at most this.
  static constexpr double dot_error = 0x1p-44;

  // `matrix` is the body's linear part times a power of two, so that no entry is beyond 1; `scale`
  // is the power of two that takes the solid's filter coordinates, turned by it, to the pair's
  // unit.
  void place(const Body& body, const Mat3d& matrix, double scale, const Vec3d& origin);

  // Generators: the vertices of a polytope; the points of a curved core that were made so far.
  std::size_t size() const { return x_.size(); }
  const Solid& solid() const { return *solid_; }
  const Vec3d& origin() const { return origin_; }  // of the body
  Vec3d rounded(std::uint32_t i) const { return {x_[i], y_[i], z_[i]}; }
  Generator generator(std::uint32_t i) const;
  // A vertex that is about the furthest. For a curved core a new point is made, in the core for
  // sure, and the furthest up to the rounding of long double.
  std::uint32_t support(const Vec3d& direction);

  // Coordinates as integers, over 2^exponent and the product of the pair's denominators, relative
  // to body a's origin. `others` is the denominator of the other body's matrix.
  void place_exactly(const ExactMatrix& matrix, long exponent, const Integer& others,
                     const IntegerVector& origin);
  const IntegerVector& exact(std::uint32_t i);
  // A furthest vertex; for a curved core as in `support`.
  std::uint32_t exact_support(const Direction& direction, double filter_scale);
  // The greatest value of direction . x over the whole core, times 2^shift.
  SupportBounds support_bounds(const IntegerVector& direction, int shift) const;

 private:
  Vec3d turned(const Vec3d& local) const { return scale_ * (matrix_ * local) + origin_; }
  std::uint32_t add_point(const Vec3<long double>& local_direction);
  bool holds(const std::array<std::int64_t, 3>& point) const;
  Integer extent(int k) const;  // of a curved core, over the solid's grid

  const Solid* solid_ = nullptr;
  Mat3d matrix_;
  double scale_ = 1;
  Vec3d origin_;
  std::vector<double> x_, y_, z_;
  std::vector<std::array<std::int64_t, 3>> points_;  // of a curved core, over the solid's grid
  // One step of the solid's grid along each of its axes; for a box, its half extents.
  std::array<IntegerVector, 3> columns_;
  IntegerVector exact_origin_;
  std::vector<IntegerVector> exact_;
  std::vector<std::uint8_t> known_;
};

}  // namespace touchstone::oracle
