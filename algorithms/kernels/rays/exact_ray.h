// A line against a triangle in expansions: where the line is first in the triangle, as a fraction.
// Used where doubles prove nothing.
#pragma once

#include <optional>

#include "algorithms/kernels/rays/expansion.h"

namespace touchstone {

// top / bottom, with bottom > 0.
struct ExactFraction {
  FloatExpansion top, bottom{1};

  // The sign of this - other.
  int compare(const ExactFraction& other) const {
    return (top * other.bottom - other.top * bottom).sign();
  }
  int compare(double x) const { return (top - FloatExpansion(x) * bottom).sign(); }
  double value() const { return top.value() / bottom.value(); }
};

struct RayTriangle {
  Vec3d origin, direction;  // of the ray; the direction is not zero
  Vec3d a, b, c;            // the triangle's vertices
};

// True if `first_hit` is exact for these numbers and t_max.
bool is_safe(const RayTriangle& pair, double t_max);

struct ExactHit {
  ExactFraction t;
  double u = 0, v = 0;  // weights of b and c, rounded
};

// The least t >= 0 at which the ray is in the closed triangle, if there is one. Any triangle is
// allowed, a segment and a point too.
std::optional<ExactHit> first_hit(const RayTriangle& pair);

}  // namespace touchstone
