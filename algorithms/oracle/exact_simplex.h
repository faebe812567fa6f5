// Part of the oracle, used by exact_gjk and expander: simplices of the difference of two bodies, in
// integers.
#pragma once

#include <array>

#include "algorithms/oracle/grid_pair.h"

namespace touchstone::oracle {

struct ExactSimplex {
  int size = 0;
  std::array<DifferencePoint, 4> points;
  std::array<IntegerVector, 4> at;
  // Weights of the point nearest to the origin, set by `reduce`: positive, with the sum `weight`.
  std::array<Integer, 4> weights;
  Integer weight;

  void add(GridPair& pair, const DifferencePoint& point) {
    points[size] = point;
    at[size] = pair.exact(point);
    ++size;
  }
};

// The position of the origin: either in the simplex, or beyond the plane normal . x = offset > 0,
// which touches the simplex at the nearest point. The distance is then offset / |normal|.
struct NearestPlane {
  bool contains_origin = false;
  IntegerVector normal;
  Integer offset;
};

// Keeps the vertices of the smallest feature that contains the point nearest to the origin. The
// last point is the newest, so features that contain it are tried first.
NearestPlane reduce(ExactSimplex& simplex);

}  // namespace touchstone::oracle
