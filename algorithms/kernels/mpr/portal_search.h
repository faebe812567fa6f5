// The portal search of MPR: finds where a ray leaves the Minkowski difference C = A - B. The ray
// passes through a triangle of support points, its portal, which is pushed outward. Used by mpr and
// mpr-refined.
// Paper:   Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008.
// Steps:   1. Choose a start inside C, the difference of the centres, and the ray from it to the
//             origin (`decide`).
//          2. Take the support point along the ray and one across it; replace them until a third
//             closes a portal around the ray (`discover`, `close`).
//          3. Take the support point along the portal's normal. If the origin is beyond its plane,
//             the bodies are separated (`refine`).
//          4. If the origin is inside the portal's plane, stop. Otherwise the point makes three
//             portals with the old corners: keep the one that the ray passes most clearly, and
//             repeat step 3.
//          5. Accept an overlap only if the start and the portal contain the origin whatever
//             rounding did to them; otherwise repeat from another start, at most three times. If a
//             plane and the portal's weights show that contact is nearer than rounding, the answer
//             is `touching`, with these bounds.
//          6. For a depth, push the portal to the surface of C; its plane's height is the depth
//             (`settle_from_portal`).
//          7. Cast a ray from the origin along that normal, find its portal, and repeat while the
//             depth falls by the tolerance (`settle`). For polytopes the old portal turns over its
//             edges to the new ray (`turn`).
// Departs: the ray may have any direction; if the centres coincide it is the x axis. A portal that
//          is a sliver does not prove a hit. For polytopes the search of step 2 is not repeated for
//          each ray.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "algorithms/core/outcome.h"
#include "algorithms/kernels/minkowski/support.h"

namespace touchstone {

// One query on two bounded bodies with their radii. Lengths are in the pair's unit; directions have
// unit length.
template <class Scalar>
class PortalSearch {
 public:
  using Point = DifferencePoint<Scalar>;
  // Anticlockwise as seen against the ray.
  using Portal = std::array<Point, 3>;
  static constexpr Scalar rounding = SupportPair<Scalar>::rounding;

  enum class Exit : std::uint8_t {
    done,
    straight,  // the ray leaves C at its point furthest along the ray, which is all three corners
    capped,
    stuck,  // the portal has no area because of rounding
  };
  // A direction and the extent of C along it: moving b by `depth` along `normal` separates the
  // bodies.
  struct Depth {
    Scalar depth = std::numeric_limits<Scalar>::infinity();
    Vec3<Scalar> normal = Vec3<Scalar>::Zero();
    bool settled = false;  // a local minimum, to the tolerance
  };

  // The iteration cap applies to each loop. `tolerance` bounds how far C may reach beyond a portal
  // that counts as on its surface, and is the least decrease of a depth that continues the search.
  PortalSearch(SupportPair<Scalar>& pair, int max_iterations, Scalar tolerance)
      : pair_(pair), max_iterations_(max_iterations), tolerance_(tolerance) {}

  // Writes answer and status, and for bodies that touch what the task asks for. If they overlap, the
  // start and the portal enclose the origin, and normal() and depth() are those of the portal, or of
  // the ray if the exit is `straight`.
  Exit decide(Task task, Outcome& outcome);
  // Pushes the portal of decide() to the surface, then settles as below.
  Depth settle_from_portal();
  // Casts rays from the origin, each along the normal of the last portal, while the depth falls by
  // the tolerance: descends to a local minimum of the depth. Starts with the direction of `from`;
  // the current portal may lie anywhere around the origin. The depth of `from` may be infinity.
  Depth settle(Depth from);
  // Finds a portal for a ray from the origin, which must be inside C. `furthest` is support(ray).
  Exit cast(const Vec3<Scalar>& ray, const Point& furthest);
  // Like `cast`, for a ray that is approximately the normal of a portal on the surface.
  Exit cast_along_normal(const Vec3<Scalar>& ray, const Point& furthest);

  // Returns the point of C that is furthest in a direction.
  Point support(const Vec3<Scalar>& direction);
  // True if all of C was beyond a support plane; normal() is then its direction.
  bool separated() const { return separated_; }

  const Point& start() const { return start_; }
  const Portal& portal() const { return portal_; }
  void set_portal(const Portal& portal) { portal_ = portal; }
  // The point where the ray passes through the portal, as points of the two bodies.
  Point passage() const;
  const Vec3<Scalar>& normal() const { return normal_; }
  Scalar depth() const { return depth_; }  // along the normal: of C, or at least of the portal
  int iterations() const { return iterations_; }

 private:
  enum class Goal : std::uint8_t { origin, surface };

  Vec3<Scalar> from_start(const Point& point) const { return point.difference - start_.difference; }
  // Positive if the ray is on the positive side of the plane through start, p and q.
  Scalar side(const Point& p, const Point& q) const {
    return from_start(p).cross(from_start(q)).dot(ray_);
  }
  Exit discover(const Point& furthest);
  Exit close();
  Exit refine(Goal goal);
  bool is_portal_of(const Vec3<Scalar>& ray);
  Exit turn();
  bool is_touching(Exit exit, Task task, Outcome& outcome);
  void move_start();
  bool origin_is_surely_inside(Exit exit) const;

  // The number of starts from which `decide` tries to prove an overlap.
  static constexpr int most_starts = 4;

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
