// What proves an answer.
//
// Everything that is known of a pair is an enclosure of one number, the signed distance s of the
// two cores: their distance where they are apart, and otherwise minus their penetration depth, the
// length of the shortest translation after which they have no interior point in common. The bodies'
// signed distance is s less the two radii.
//   Lower bound: any direction n. The part of the line between the cores' shadows on it is
//     (min n.b - max n.a) / |n| long, over all points b and a of the cores; s is at least that.
//     (Apart: a separating plane. Overlapping: that translation along n separates.)
//   Upper bound: points of the difference A - B of the cores. One point z that is a convex
//     combination of some of them: s <= |z|. Or a closed surface of triangles between them with the
//     origin strictly on the inner side of each: s <= minus the least distance of their planes from
//     the origin, since that ball lies inside the difference.
// Where the bounds meet the answer is exact.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/oracle/numbers/integer.h"
#include "algorithms/oracle/numbers/signed_root.h"

namespace touchstone::oracle {

// A point of a core, in body coordinates: a polytope's vertex by its number in Solid::vertices, or,
// for a cylinder, cone or ellipsoid, any point that lies in it, given exactly.
struct Generator {
  std::int32_t vertex = -1;
  std::array<long double, 3> point{};  // metres; means something where vertex < 0
};

// generator a of the first body less generator b of the second, both in the world. A half-space has
// no generators: the number is then 0, the difference is from the nearest point of its plane, and
// what bounds s is the signed height of the one generator that is named over that plane.
struct DifferencePoint {
  std::uint32_t a = 0, b = 0;
  friend bool operator==(const DifferencePoint&, const DifferencePoint&) = default;
};

struct Certificate {
  // What is claimed: lower <= s <= upper, and the answer that follows for the bodies: separated
  // where s > R, touching where s = R, overlapping where s < R, R being the sum of the radii;
  // unknown where the bounds do not tell. Two bodies of which one is flat or a point, without a
  // ball, touch where they meet and the difference of the cores has no interior there.
  Answer answer = Answer::unknown;
  SignedRoot lower, upper;

  std::vector<Generator> a, b;
  IntegerVector direction{};  // from a to b in world axes, any length but zero; proves `lower`
  // Proves `upper`: weights > 0 of difference points ...
  struct Term {
    DifferencePoint point;
    Integer weight;
  };
  std::vector<Term> closest;
  // ... or, where s < 0, triangles anticlockwise seen from outside, each of three `points`.
  struct Surface {
    std::vector<DifferencePoint> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };
  Surface surface;
};

}  // namespace touchstone::oracle
