// Part of part-pairs: a plane between the hulls of two bodies, before their trees are descended.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/concave_phase.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {

// A polytope of 26 planes around a mesh, along the ways to a cube's faces, edges and corners.
class DiscretePolytope {
 public:
  // Three numbers, and a fourth that is 0.
  using Vector = simd::Quad<float>;

  explicit DiscretePolytope(std::span<const Vec3d> vertices);

  // A point that is as far along the way as the mesh reaches, or further, up to rounding (metres).
  const Vector& support(const Vector& way) const { return points_[sector_of(way)]; }

  // The middle of its ends along the axes, and about the radius of a ball around it that the mesh's hull holds.
  const Vector& centre() const { return centre_; }
  float inner() const { return inner_; }
  // The greatest magnitude of an end along one of the ways (metres). No coordinate of a point of the polytope is
  // greater than twice that.
  float reach() const { return reach_; }

 private:
  // The signs of the way's parts and which of two is greater tell between which three planes it lies.
  static std::size_t sector_of(const Vector& way) {
    using Lanes = simd::baseline::Simd<float>;
    const Vector size = Lanes::abs(way);
    const Vector one = __builtin_shufflevector(size, size, 0, 0, 1, 3);
    const Vector other = __builtin_shufflevector(size, size, 1, 2, 2, 3);
    return Lanes::to_bits(Lanes::less(one, other)) | Lanes::to_bits(Lanes::less(way, Vector{}))
                                                         << 3;
  }

  std::array<Vector, 64> points_;  // one a sector
  Vector centre_;
  float inner_, reach_;
};

class HullSeparation {
 public:
  // The bodies stay alive and unchanged.
  void bind(std::span<const BoundBody> bodies);

  // Returns true if a plane parts the two meshes by more than rounding; false tells nothing.
  bool parts(const PlacedConcave& a, const PlacedConcave& b) const;

 private:
  std::span<const BoundBody> bodies_;
  std::vector<std::optional<DiscretePolytope>>
      polytopes_;  // none of bodies that are small, or no meshes
};

}  // namespace touchstone
