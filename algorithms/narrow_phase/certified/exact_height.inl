// Part of certified: the exact sign of the height of a rounded polytope over a plane, in integers of
// `size` limbs. Included by exact_contact.cpp.
#include <algorithm>
#include <span>

#include "algorithms/narrow_phase/certified/grid_body.h"

namespace touchstone {
namespace {

// A plane normal . x = offset with doubles, as integers: the normal in steps of 2^exponent.
struct GridPlane {
  FixedVector<2> normal;
  int exponent = 0;
  SplitDouble offset;

  // Sets `fits` to false if the normal's exponents are too far apart for 128 bits.
  GridPlane(const Vec3d& n, double o, bool& fits) : offset(o) {
    GridRange range;
    std::array<SplitDouble, 3> parts;
    for (int i = 0; i < 3; ++i) range.add(parts[i] = SplitDouble(n[i]));
    fits = range.least <= range.most && range.most - range.least <= 120;
    if (!fits) return;
    exponent = range.least;
    for (int i = 0; i < 3; ++i) {
      if (parts[i].mantissa == 0) continue;
      add_product(normal[i], parts[i].mantissa, 1,
                  static_cast<unsigned>(parts[i].exponent - exponent));
    }
  }
};

// The body has listed its lowest vertices, in steps of 2^step relative to the plane's own origin.
template <std::size_t size>
Answer verdict_over_plane(const GridBody<size>& body, const GridPlane& plane,
                          const FixedInteger<size>& radius, int step) {
  auto lowest = dot(plane.normal, body[body.near().front()]);
  for (const std::size_t i : body.near().subspan(1)) {
    const auto height = dot(plane.normal, body[i]);
    if ((height - lowest).sign() < 0) lowest = height;
  }
  if (plane.offset.mantissa != 0) {
    FixedInteger<size + 2> offset;
    add_product(offset, plane.offset.mantissa, 1,
                static_cast<unsigned>(plane.offset.exponent - plane.exponent - step));
    lowest = lowest - offset;
  }
  int sign = lowest.sign();
  if (sign > 0 && radius.sign() > 0) {
    sign = (lowest * lowest - (radius * radius) * dot(plane.normal, plane.normal)).sign();
  } else if (radius.sign() > 0) {
    sign = -1;
  }
  return sign > 0 ? Answer::separated : sign < 0 ? Answer::overlapping : Answer::touching;
}

}  // namespace
}  // namespace touchstone
