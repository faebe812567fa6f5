// What is certain in spite of rounding: that one convex body holds another.
#pragma once

#include <optional>
#include <vector>

#include "harness/proxies/local_body.h"

namespace touchstone {

// An upper bound on n . (x - a) over the points x of the body (of its hull, for a mesh).
double reach(const LocalBody& body, const Vec3d& n, const Vec3d& a);

// The hull of these points scaled up about its middle by as little as is needed until it certainly
// holds the body. The proof: a closed surface of triangles, each of which has the body on its inner
// side, and all of which are seen from inside by one point, has the body inside it, for a ray from
// that point leaves the half-spaces before it leaves the surface; and the convex hull of the
// surface's corners holds what is inside it. All signs are of sums with a bound on their rounding.
// Nothing where Qhull finds no solid in the points.
std::optional<Shape> hull_that_holds(const LocalBody& body, const std::vector<Vec3d>& points);

// The inside of a convex body without its rim of rounding.
class Inside {
 public:
  explicit Inside(const LocalBody& body);

  // False where the body is too thin for any point to be certainly inside.
  bool has_interior() const { return has_interior_; }
  // A point about as far inside as any.
  const Vec3d& deepest() const { return deepest_; }
  // A lower bound on the distance of x from the outside: a ball of that radius about x is inside
  // the body for certain. Negative where x is not certainly inside.
  double clearance(const Vec3d& x) const;
  // The planes of a polytope's faces, unit normals; of a round body those of a polytope inside it.
  const std::vector<Plane>& planes() const { return planes_; }

 private:
  struct Facet {
    Vec3d normal, point;
    double length, error;  // of the normal; of normal . (x - point), by the distance of x
  };
  double within_facets(const Vec3d& x) const;

  const LocalBody& body_;
  std::vector<Facet> facets_;
  std::vector<Plane> planes_;
  Vec3d deepest_ = Vec3d::Zero();
  bool has_interior_ = false;
};

}  // namespace touchstone
