// Part of the oracle: what proves an answer. harness/files reads and writes it.
//
// A certificate encloses one number, the signed distance s of the two cores: their distance if they
// are apart, otherwise minus their penetration depth, which is the length of the shortest
// translation after which 0 is not in the interior of their difference. The bodies' signed distance is
// s minus the two radii.
//
// Lower bound: any direction n. The gap between the cores' shadows on a line along n is (min n.b -
// max n.a) / |n|, over all points b and a of the cores; s is at least that. (Apart: n gives a
// separating plane. Overlapping: that translation along n separates.)
//
// Upper bound: points of the difference A - B of the cores. Either one point z that is a convex
// combination of them, and then s <= |z|; or a closed surface of triangles between them with the
// origin strictly on the inner side of each. Then s <= minus the least distance of their planes
// from the origin, since the ball of that radius lies inside the difference.
//
// If the bounds meet, the answer is exact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/numbers/integer.h"
#include "algorithms/oracle/numbers/signed_root.h"

namespace touchstone::oracle {

// A point of a core, in body coordinates: a polytope's vertex by its index in Solid::vertices, or,
// for a cylinder, cone or ellipsoid, any point in it, given exactly.
struct Generator {
  std::int32_t vertex = -1;
  std::array<long double, 3> point{};  // metres; valid only if vertex < 0
};

// Generator a of the first body minus generator b of the second, both in world coordinates. A
// half-space has no generators: its index is 0, and the difference is taken from the nearest point
// of its plane. The bound on s is then the signed height of the other body's generator over that
// plane.
struct DifferencePoint {
  std::uint32_t a = 0, b = 0;
  friend bool operator==(const DifferencePoint&, const DifferencePoint&) = default;
};

struct Certificate {
  // The claim is lower <= s <= upper, and the answer that follows for the bodies. With R the sum of
  // the radii: separated if s > R, touching if s = R, overlapping if s < R, unknown if the bounds
  // do not decide. Two bodies without balls, one of them flat or a point, touch if they meet and
  // the difference of the cores has no interior there.
  Answer answer = Answer::unknown;
  SignedRoot lower, upper;

  std::vector<Generator> a, b;
  IntegerVector direction{};  // from a to b in world axes, any nonzero length; proves `lower`
  // One proof of `upper`: difference points with weights > 0.
  struct Term {
    DifferencePoint point;
    Integer weight;
  };
  std::vector<Term> closest;
  // The other, if s < 0: triangles anticlockwise seen from outside, each of three `points`.
  struct Surface {
    std::vector<DifferencePoint> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };
  Surface surface;
};

}  // namespace touchstone::oracle
