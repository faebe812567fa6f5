// Part of exact concave: planes between groups of parts, found in doubles.
#pragma once

#include <array>
#include <optional>

#include "algorithms/core/pose.h"
#include "algorithms/oracle/certificates/parts/part_tree.h"
#include "algorithms/oracle/numbers/integer.h"

namespace touchstone::oracle {

// A box of a body in its place: its centre, and the ways from there to three of its faces, in doubles.
struct RoundedGroup {
  Vec3d centre;
  Mat3d ways;    // a column each
  Mat3d across;  // a column a face's normal
  double size;   // no coordinate that went into it is greater (metres)

  RoundedGroup(const RationalBox& box, const Pose& pose);
  // A segment; the normals are those that it has with ways of the other group.
  RoundedGroup(const Vec3d& from, const Vec3d& to, const RoundedGroup& other);
};

// A direction from a to b along which the groups are further apart than this, by more than doubles can be
// wrong; none if none of those that are tried is one.
std::optional<IntegerVector> plane_between(const RoundedGroup& a, const RoundedGroup& b,
                                           double apart_by);

}  // namespace touchstone::oracle
