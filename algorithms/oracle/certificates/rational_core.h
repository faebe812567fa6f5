// Part of the oracle, used by the checks of certificates: a body's core in the world, in rationals.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "algorithms/oracle/certificates/rational_pose.h"
#include "algorithms/oracle/certificates/rationals.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// The solid must outlive this object. A faulty body or generator throws a Fault.
class RationalCore {
 public:
  // Roots are computed to `root_bits` bits.
  RationalCore(const Body& body, mp_bitcnt_t root_bits);
  RationalCore(const Solid& solid, const RationalPose& pose, mp_bitcnt_t root_bits);

  // Moves the core: first turns it about the body's origin, then displaces it.
  void turn(const std::array<RationalVector, 3>& rotation);
  void displace(const RationalVector& by);

  // An upper bound on the distance of the core's points from the body's origin. Throws Fault for a half-space.
  mpq_class reach() const;

  bool is_polytope() const { return solid_.core == Solid::Core::polytope; }
  // The vertices of a polytope in world coordinates.
  std::vector<RationalVector> vertices() const;

  bool is_halfspace() const { return solid_.core == Solid::Core::halfspace; }
  // A half-space is normal . x <= height, with an outward normal that is not zero. A singular matrix makes no
  // half-space, and nothing is proven of one: `normal` and `points` throw Fault, and no support is known.
  const RationalVector& normal() const {
    require(!is_singular_halfspace(), "the matrix of a half-space is singular");
    return normal_;
  }
  bool is_singular_halfspace() const { return is_halfspace() && is_zero(normal_); }

  // An upper bound on n . x over the core's points x; empty if n . x is unbounded, or there is no half-space.
  std::optional<mpq_class> support(const RationalVector& n) const;

  // The generators in world coordinates, each checked to lie in the core. For a half-space: one
  // point of its plane.
  std::vector<RationalVector> points(const std::vector<Generator>& generators) const;

  // True if a round core, or a box, has the point in world coordinates. Throws Fault if the matrix has no inverse.
  bool holds_in_world(const RationalVector& point) const;

 private:
  void place_plane();
  mpq_class support_in_body(const RationalVector& u) const;
  RationalVector point_in_body(const Generator& generator) const;
  bool holds(const RationalVector& x) const;

  const Solid& solid_;
  mp_bitcnt_t root_bits_;
  std::array<RationalVector, 3> rows_;
  RationalVector translation_, extents_, normal_;
  mpq_class height_;
};

}  // namespace touchstone::oracle
