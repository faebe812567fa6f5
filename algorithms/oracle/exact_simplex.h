// Simplices of the difference of two bodies, in integers.
#pragma once

#include <array>

#include "algorithms/oracle/grid_pair.h"

namespace touchstone::oracle {

struct ExactSimplex {
  int size = 0;
  std::array<DifferencePoint, 4> points;
  std::array<IntegerVector, 4> at;
  // Of the nearest point to the origin, after `reduce`: positive; their sum is `weight`.
  std::array<Integer, 4> weights;
  Integer weight;

  void add(GridPair& pair, const DifferencePoint& point) {
    points[size] = point;
    at[size] = pair.exact(point);
    ++size;
  }
};

// Where the origin is: in the simplex, or on the far side of the plane normal . x = offset > 0,
// which touches the simplex at the nearest point, so the distance is offset / |normal|.
struct NearestPlane {
  bool contains_origin = false;
  IntegerVector normal;
  Integer offset;
};

// Leaves the vertices of the smallest feature that holds the nearest point to the origin. The last
// point is the newest: features with it are tried first.
NearestPlane reduce(ExactSimplex& simplex);

}  // namespace touchstone::oracle
