// Part of certified: a portal of the difference C = A - B of two polytopes near its surface, found in
// doubles. Nothing is proven of it. Includes kernels and the oracle's solids.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Steps:   1. Cast a ray from a mean of points of C through the origin.
//          2. Find three points of C around the ray: across it, they are a triangle around zero. A
//             face of the given simplex will do.
//          3. Replace a corner by the point of C furthest along the portal's normal, until none is
//             further than 1e-12 of the unit.
#pragma once

#include <array>
#include <cstdint>

#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/oracle/solid.h"

namespace touchstone {

// A support point of the pair, and the vertices of a and of b by their place in the solids, if they
// are known.
struct RoughCorner {
  static constexpr std::uint32_t unknown = 0xffffffff;
  std::uint32_t a = unknown, b = unknown;
  DifferencePoint<double> point;
  bool is_numbered() const { return a != unknown; }
};

// `pair` has the cores of the two solids, which are polytopes. `simplex` has points of C, or none.
class RoughPortal {
 public:
  RoughPortal(SupportPair<double>& pair, const oracle::Solid& a, const oracle::Solid& b,
              const Simplex<double>& simplex)
      : pair_(pair), a_(a), b_(b), simplex_(simplex) {}

  double unit() const { return pair_.unit(); }
  const Vec3d& centre_b() const { return pair_.centre_b(); }

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

  // Returns false if no triangle of C is around the ray. `from_simplex`: begins with a face of the
  // simplex, if there is one.
  bool find(const Start& start, bool from_simplex);
  const std::array<RoughCorner, 3>& portal() const { return portal_; }
  bool is_numbered() const {
    return portal_[0].is_numbered() && portal_[1].is_numbered() && portal_[2].is_numbered();
  }
  Vec3d normal() const { return across().stableNormalized(); }  // of the portal, along the ray
  // The point of C that is furthest in a direction.
  RoughCorner support(const Vec3d& direction);

 private:
  bool take_face_of_simplex();
  bool enclose_ray();
  void approach_surface();

  Vec3d across() const {
    const Vec3d& p = portal_[0].point.difference;
    return (portal_[1].point.difference - p).cross(portal_[2].point.difference - p);
  }

  static constexpr int most_turns = 32;

  SupportPair<double>& pair_;
  const oracle::Solid &a_, &b_;
  const Simplex<double>& simplex_;
  Vec3d ray_ = Vec3d::Zero();
  std::array<RoughCorner, 3> portal_;
};

}  // namespace touchstone
