// Proofs in spite of rounding that one convex body contains another.
#pragma once

#include <optional>
#include <vector>

#include "harness/proxies/local_body.h"

namespace touchstone::proxies {

// An upper bound on n . (x - a) over the points x of the body (of its hull, for a mesh).
double reach(const LocalBody& body, const Vec3d& n, const Vec3d& a);

// Scales the hull of these points up around its middle, by as little as necessary, until it
// certainly contains the body. Returns nothing if Qhull finds no solid in the points.
//
// Proof: consider a closed surface of triangles that have the body on their inner side and a common
// point that sees all of them from inside. A ray from that point leaves the half-spaces before it
// leaves the surface, so the body is inside the surface, and the convex hull of the surface's
// corners contains everything inside it. All signs are those of sums with a bound on their
// rounding.
std::optional<Shape> hull_that_holds(const LocalBody& body, const std::vector<Vec3d>& points);

// The interior of a convex body, reduced by rounding.
class Inside {
 public:
  explicit Inside(const LocalBody& body);

  // False if the body is too thin for any point to be certainly inside.
  bool has_interior() const { return has_interior_; }
  // A point about as deep inside as any.
  const Vec3d& deepest() const { return deepest_; }
  // A lower bound on the distance of x from the outside: a ball of that radius around x is
  // certainly inside the body. Negative if x is not certainly inside.
  double clearance(const Vec3d& x) const;
  // The planes of a polytope's faces with unit normals; for a round body those of a polytope inside
  // it.
  const std::vector<geometry::Plane>& planes() const { return planes_; }

 private:
  struct Facet {
    Vec3d normal, point;
    double length, error;  // |normal|; error of normal . (x - point) per distance of x
  };
  double within_facets(const Vec3d& x) const;

  const LocalBody& body_;
  std::vector<Facet> facets_;
  std::vector<geometry::Plane> planes_;
  Vec3d deepest_ = Vec3d::Zero();
  bool has_interior_ = false;
};

}  // namespace touchstone::proxies
