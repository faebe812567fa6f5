// Where a ray from inside the Minkowski difference C = A - B leaves it: between three support
// points, its portal, which is pushed outward. What the portal methods share.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Departs: any ray, not only one to the origin; where the centres coincide it is along x. A hit is
// believed only where weights of the four points give the origin up to rounding; a portal that is a
// sliver does not pass. From one ray to the next a polytope's portal goes over its edges, and is
// not looked for again.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// Of one query on two bounded bodies, with their radii. Lengths are in the pair's unit, directions
// of unit length.
template <class Scalar>
class PortalSearch {
 public:
  using Point = DifferencePoint<Scalar>;
  // Anticlockwise as seen against the ray.
  using Portal = std::array<Point, 3>;
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  enum class Exit : std::uint8_t {
    done,
    straight,  // the ray leaves C in the point that lies furthest along it, thrice in the portal
    capped,
    stuck,  // rounding: a portal without an area
  };
  // A direction, and how far C reaches along it: moving b so far separates.
  struct Depth {
    Scalar depth = std::numeric_limits<Scalar>::infinity();
    Vec3<Scalar> normal = Vec3<Scalar>::Zero();
    bool settled = false;  // no direction near it has less, to the tolerance
  };

  // The cap is of each loop. `tolerance`: how far C may reach beyond a portal that is on its
  // surface, and how much less a depth must be to go on.
  PortalSearch(SupportPair<Scalar>& pair, int max_iterations, Scalar tolerance)
      : pair_(pair), max_iterations_(max_iterations), tolerance_(tolerance) {}

  // Writes answer and status. Where they overlap, start and portal have the origin inside, and
  // normal() and depth() are the portal's, or the ray's where it is straight.
  Exit decide(Outcome& outcome);
  // After decide(): the portal is pushed on to the surface, and then settled.
  Depth settle_from_portal();
  // Casts rays from the origin, each along the normal of the portal before, as long as its depth is
  // less by the tolerance: to a local minimum of the depth. Begins with the direction of `from` and
  // a portal whose cone from the origin is anywhere. The depth of `from` may be unknown, infinity.
  Depth settle(Depth from);
  // A portal for a ray from the origin, which is inside of C; `furthest` is support(ray).
  Exit cast(const Vec3<Scalar>& ray, const Point& furthest);
  // The same for a ray that is about the normal of a portal on the surface.
  Exit cast_along_normal(const Vec3<Scalar>& ray, const Point& furthest);

  // The point of C that lies furthest in a direction.
  Point support(const Vec3<Scalar>& direction);
  // A support plane had all of C beyond it; normal() is then its direction.
  bool separated() const { return separated_; }

  const Point& start() const { return start_; }
  const Portal& portal() const { return portal_; }
  void set_portal(const Portal& portal) { portal_ = portal; }
  // The point where the ray passes the portal, as points of the two bodies.
  Point passage() const;
  const Vec3<Scalar>& normal() const { return normal_; }
  Scalar depth() const { return depth_; }  // along the normal, of C or at least of the portal
  int iterations() const { return iterations_; }

 private:
  enum class Goal : std::uint8_t { origin, surface };

  Vec3<Scalar> from_start(const Point& point) const { return point.difference - start_.difference; }
  // Positive where the ray passes the plane of start, p and q on its positive side.
  Scalar side(const Point& p, const Point& q) const {
    return from_start(p).cross(from_start(q)).dot(ray_);
  }
  Exit discover(const Point& furthest);
  Exit close();
  Exit refine(Goal goal);
  bool is_portal_of(const Vec3<Scalar>& ray);
  Exit turn();
  bool origin_is_inside() const;

  SupportPair<Scalar>& pair_;
  int max_iterations_;
  Scalar tolerance_;
  Point start_;
  Vec3<Scalar> ray_;
  Portal portal_;
  Vec3<Scalar> normal_ = Vec3<Scalar>::Zero();
  Scalar depth_ = 0;
  bool separated_ = false;
  int iterations_ = 0;
};

extern template class PortalSearch<float>;
extern template class PortalSearch<double>;

}  // namespace touchstone
