// One ray and the triangles that it is tested against, one after the other, without an error.
// Papers: Woop, Benthin, Wald, "Watertight ray/triangle intersection", JCGT 2, 2013 (the shear);
//         Shewchuk 1997 (exact where a bound on the rounding decides nothing).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "algorithms/kernels/rays/exact_ray.h"
#include "algorithms/ray_cast.h"

namespace touchstone {

// The first hit among the triangles that were offered. Their order does not matter.
class RayQuery {
 public:
  // The ray must be proper: see `is_proper`.
  explicit RayQuery(const Ray& ray);

  // Tests a triangle. Returns true if it is hit.
  bool offer(std::uint32_t triangle, const Vec3d& a, const Vec3d& b, const Vec3d& c);

  bool is_hit() const { return best_.triangle != RayHit::no_triangle; }
  // No triangle beyond this t counts any more.
  double t_end() const { return t_end_; }
  // The hit. Its t is off by at most 2^-40 of the distance at which the triangle's furthest vertex is
  // along the ray, u and v by at most 2^-24. The status is `degenerate` if a triangle's numbers were too small or too great to
  // decide (beyond 2^-120 or 2^120).
  RayHit hit() const;

 private:
  struct Candidate {
    std::uint32_t triangle = RayHit::no_triangle;
    double t = 0, error = 0;  // t is within error of the true one
    std::optional<ExactFraction> exact;
    Vec3d a, b, c;
    double u = 0, v = 0;
  };

  RayTriangle pair_of(const Candidate& candidate) const;
  bool offer_exactly(Candidate candidate);
  bool is_before_best(Candidate& candidate);
  void keep(const Candidate& candidate);

  Ray ray_;
  std::array<int, 3> axes_;  // the last is that of the direction's greatest component
  double shear_x_, shear_y_, inverse_;
  double t_end_;
  Candidate best_;
  bool undecided_ = false;
};

// True if all numbers are finite (t_max may be infinite) and the direction is not zero.
bool is_proper(const Ray& ray);
// The hit of a ray that is not.
RayHit improper_hit();
// The ray of floats, as doubles. Infinite where a float is not enough.
Ray rounded_to_float(const Ray& ray);

}  // namespace touchstone
