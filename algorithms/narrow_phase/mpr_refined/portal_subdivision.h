// Part of mpr-refined: portals in all directions around the origin, inside a convex set. They give
// a lower bound on the distance to its surface, and dividing them raises it. Includes core and
// kernels.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008
//          (portals).
// Departs: there are as many portals as cover all directions, instead of one around a ray. There is
//          no horizon as in EPA: portals may overlap, and the edges between the first ones stay.
//          Edges that are nearer to the origin than the surface therefore keep the bound low.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "algorithms/kernels/gjk/gjk_iteration.h"

namespace touchstone {

// Triangles between points of the set whose cones from the origin cover all directions. In no
// direction does the set end nearer to the origin than its triangle.
template <class Scalar>
class PortalSubdivision {
 public:
  using Point = DifferencePoint<Scalar>;
  static constexpr int most_divisions = 8;

  struct Portal {
    std::array<std::uint8_t, 3> corners;
    Vec3<Scalar> normal;
    Scalar lower;  // no point of the triangle is nearer to the origin
  };

  // Returns false if the origin may be outside because of rounding.
  bool start(const std::array<Point, 4>& tetrahedron) {
    Simplex<Scalar> simplex;
    simplex.size = 4;
    simplex.points = tetrahedron;
    if (!is_surely_inside(simplex)) return false;
    std::ranges::copy(tetrahedron, points_.begin());
    point_count_ = 4;
    portal_count_ = 0;
    const auto& w = points_;
    const Vec3<Scalar> edge = w[1].difference - w[0].difference;
    const bool turned =
        edge.cross(w[2].difference - w[0].difference).dot(w[3].difference - w[0].difference) > 0;
    if (turned) std::swap(points_[0], points_[1]);
    add(0, 1, 2);
    add(3, 1, 0);
    add(3, 2, 1);
    add(3, 0, 2);
    return true;
  }

  const Portal& lowest() const {
    return *std::min_element(portals_.begin(), portals_.begin() + portal_count_,
                             [](const Portal& p, const Portal& q) { return p.lower < q.lower; });
  }
  int count_below(Scalar enough) const {
    return static_cast<int>(std::count_if(portals_.begin(), portals_.begin() + portal_count_,
                                          [&](const Portal& p) { return p.lower < enough; }));
  }
  std::array<Point, 3> points(const Portal& portal) const {
    const auto& [i, j, k] = portal.corners;
    return {points_[i], points_[j], points_[k]};
  }

  // Divides the lowest portal by a point on the outer side of its plane. The new portals cover its
  // directions, and more if the point is beyond its edges.
  void divide_lowest(const Point& point) {
    const std::array<std::uint8_t, 3> corners = lowest().corners;
    portals_[&lowest() - portals_.data()] = portals_[portal_count_ - 1];
    --portal_count_;
    points_[point_count_] = point;
    for (int k = 0; k < 3; ++k) {
      const std::uint8_t i = corners[k], j = corners[(k + 1) % 3];
      const Scalar side = points_[i].difference.cross(points_[j].difference).dot(point.difference);
      if (side > 0) add(i, j, point_count_);
    }
    ++point_count_;
  }

 private:
  void add(std::uint8_t i, std::uint8_t j, std::uint8_t k) {
    const Vec3<Scalar>&p = points_[i].difference, &q = points_[j].difference,
          &r = points_[k].difference;
    const Vec3<Scalar> normal = (q - p).cross(r - p);
    const Scalar length = normal.norm();
    Portal& portal = portals_[portal_count_++];
    portal = {{i, j, k}, Vec3<Scalar>::UnitX(), 0};
    // The triangle is above this height, whatever rounding did to the normal.
    if (length > 0) {
      portal.normal = normal / length;
      portal.lower = std::min({p.dot(portal.normal), q.dot(portal.normal), r.dot(portal.normal)});
    }
  }

  std::array<Point, 4 + most_divisions> points_;
  std::array<Portal, 4 + 2 * most_divisions> portals_;
  std::uint8_t point_count_ = 0;
  int portal_count_ = 0;
};

}  // namespace touchstone
