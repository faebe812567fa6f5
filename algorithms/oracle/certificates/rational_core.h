// A body's core in the world, in rationals: as certificates are checked against it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "algorithms/oracle/certificates/rationals.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// The solid stays alive. What is wrong with the body, or with a generator, is thrown as a Fault.
class RationalCore {
 public:
  // Roots are taken to so many bits.
  RationalCore(const Body& body, mp_bitcnt_t root_bits);

  bool is_halfspace() const { return solid_.core == Solid::Core::halfspace; }
  // A half-space is normal . x <= height; the normal is outward, and zero where the matrix is
  // singular, so that there is no half-space.
  const RationalVector& normal() const { return normal_; }

  // At least the greatest n . x of the core's points x; none where they have no greatest.
  std::optional<mpq_class> support(const RationalVector& n) const;

  // The generators in the world, each checked to lie in the core; of a half-space, a point of its
  // plane.
  std::vector<RationalVector> points(const std::vector<Generator>& generators) const;

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
