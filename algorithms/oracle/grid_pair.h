// Part of the oracle: a pair of bounded cores on one grid of integers, and in doubles.
#pragma once

#include "algorithms/oracle/grid_core.h"
#include "algorithms/oracle/numbers/filters.h"
#include "algorithms/oracle/numbers/signed_root.h"

namespace touchstone::oracle {

class GridPair {
 public:
  // Places the pair in doubles only; `place_exactly` adds the integers. Neither body may be a
  // half-space. Both must outlive the use of the pair.
  void place(const Body& a, const Body& b);
  void place_exactly();  // does nothing the second time

  GridCore a, b;
  double radius = 0;  // sum of the radii in the pair's unit, off by at most two roundings

  bool is_curved() const { return a.solid().is_curved() || b.solid().is_curved(); }

  Vec3d rounded(const DifferencePoint& p) const { return a.rounded(p.a) - b.rounded(p.b); }
  IntegerVector exact(const DifferencePoint& p) { return a.exact(p.a) - b.exact(p.b); }
  // Returns a point of the difference a - b that is furthest along the direction. For a curved core
  // it is furthest up to rounding.
  DifferencePoint exact_support(const Direction& direction, double filter_scale);
  // A sufficient `shift` below: the number of bits of a curved core's root after the grid's point.
  static constexpr int root_shift = 160;
  // Upper and lower bounds on the support of the whole difference, times 2^shift. For polytopes
  // both are equal to it.
  Integer support_above(const Direction& direction, int shift, double filter_scale);
  Integer support_below(const Direction& direction, int shift, double filter_scale);

  // Returns length / |normal|, given in grid steps, in the pair's unit.
  double rounded_length(const Integer& length, const IntegerVector& normal) const;
  // Distance between a curved core's point and the furthest one because of rounding, in the pair's
  // unit.
  static constexpr double curved_rounding = 0x1p-60;

  // Converts sign * sqrt(numerator / denominator) grid steps to metres.
  SignedRoot in_metres(int sign, const Integer& numerator, const Integer& denominator) const;
  long exponent() const { return exponent_; }  // a grid step is 2^exponent / denominator metres
  const Integer& denominator() const { return denominator_; }

 private:
  SupportBounds support_bounds(const Direction& direction, int shift, double filter_scale);

  const Body *body_a_ = nullptr, *body_b_ = nullptr;
  bool exactly_ = false;
  int unit_ = 0;  // the pair's unit is 2^unit_ metres
  long exponent_ = 0;
  Integer denominator_ = 1;
};

}  // namespace touchstone::oracle
