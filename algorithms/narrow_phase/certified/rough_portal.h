// Part of certified: a portal of the difference C = A - B of two polytopes near its surface, found in
// doubles. Nothing is proven of it. Includes kernels and the oracle's solids.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Steps:   1. Cast a ray from a mean of points of C through the origin.
//          2. Find three points of C around the ray: across it, they are a triangle around zero.
//          3. Replace a corner by the point of C furthest along the portal's normal, until none is
//             further than 1e-12 of the unit.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/oracle/solid.h"

namespace touchstone {

// Vertices of a and of b, by their place in the solids, and their difference in the pair's unit.
struct RoughCorner {
  std::uint32_t a = 0, b = 0;
  Vec3d point = Vec3d::Zero();
};

// `pair` has the cores of the two solids, which are polytopes.
class RoughPortal {
 public:
  RoughPortal(SupportPair<double>& pair, const oracle::Solid& a, const oracle::Solid& b)
      : pair_(pair), a_(a), b_(b) {}

  // The points of C and their weights whose sum is the start of the ray.
  struct Start {
    std::array<RoughCorner, 4> points;
    std::array<std::uint32_t, 4> weights;
  };
  // The point of C that is furthest behind the plane along the normal.
  Start start_behind(const Vec3d& normal);
  // Four points of C that are not in a plane unless C is; weights that differ make it unlikely that
  // the ray passes an edge.
  Start start_amid(const Vec3d& normal, const std::array<std::uint32_t, 4>& weights);

  // Returns false if no triangle of C is around the ray.
  bool find(const Start& start);
  const std::array<RoughCorner, 3>& portal() const { return portal_; }
  // The point of C that is furthest in a direction.
  RoughCorner support(const Vec3d& direction);

 private:
  bool enclose_ray();
  void approach_surface();

  static constexpr int most_turns = 32;

  SupportPair<double>& pair_;
  const oracle::Solid &a_, &b_;
  Vec3d ray_ = Vec3d::Zero();
  std::array<RoughCorner, 3> portal_;
};

}  // namespace touchstone
