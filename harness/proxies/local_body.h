// A body in a frame where fitting is safe: about unit size, near the origin, with exact
// conversions. Proofs in spite of rounding that one convex body contains another.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "harness/geometry/polyhedron.h"
#include "harness/proxies/representation.h"

namespace touchstone::proxies {

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

// The body is scaled by a power of two. A hull is also moved by exact differences: by one of its
// points along each axis on which it is farther from the origin than it is long. So no digit of a
// distant, tiny or huge body is lost (except for subnormal numbers).
struct LocalBody {
  LocalBody(const Shape& body, const geometry::Mesh* mesh);

  Shape shape;
  std::vector<Vec3d> points;     // of hulls: the vertices, and those of the mesh
  geometry::Mesh mesh;           // empty if the body has none
  Vec3d middle = Vec3d::Zero();  // centre of the box along the body's axes
  Vec3d half = Vec3d::Zero();    // half extents of that box, rounded up
  double size = 0;               // upper bound on the distance of its points from the middle
  bool has_mesh = false;
  bool solid = true;  // has dimension 3

  // The point nearest to `centre` at which a part can be centred exactly.
  Vec3d snap(const Vec3d& centre) const;
  // Converts a part to the original frame. Its translation must be a snapped point, or zero.
  Part placed(Part part) const;
  // The inverse of `placed`, up to rounding, and the original length of a length here in metres.
  Part localised(Part part) const;
  double length_as_given(double length) const;

 private:
  Vec3d shift_ = Vec3d::Zero();  // in the original frame
  int exponent_ = 0;
};

// The shape times 2^exponent.
Shape scaled(Shape shape, int exponent);

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
