// Decomposes a mesh into convex parts: pieces, the hulls that would stand for them, and the planes
// that cut them.
#pragma once

#include <memory>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"
#include "harness/proxies/local_body.h"

namespace touchstone::proxies {

struct Piece {
  geometry::Mesh mesh;         // vertices alone if joined from several pieces
  std::vector<Vec3d> corners;  // of its hull
  Vec3d middle = Vec3d::Zero();
  double hull_volume = 0, volume = 0;
  int cuts = 0;        // number of cuts that its points may have come from
  bool whole = false;  // must not be cut

  double concavity() const { return whole ? 0 : hull_volume - volume; }
};

Piece measured(geometry::Mesh mesh, int cuts, bool whole);
Piece joined(const Piece& a, const Piece& b);
// The hull of the points, reduced. If Qhull finds no faces, because cuts left points that almost
// coincide, it is that of the points rounded to a grid as fine as helps, in the local frame.
std::shared_ptr<const Hull> sturdy_hull(const std::vector<Vec3d>& points);
// The volume that the hull of both has more than their hulls.
double price_of_joining(const Piece& a, const Piece& b);

// Puts the surface of each cavity to the surface around it: closed meshes whose volumes have the
// other sign than `sign`, to the smallest one whose box holds theirs. A solid and its cavities make
// one piece, since neither is wound around as the whole is.
std::vector<geometry::Mesh> with_cavities(std::vector<geometry::Mesh> closed, double sign);

// Returns the parts on both sides of the plane that leaves least volume in the hulls of the parts,
// or none if no plane leaves less than the piece's hull has. The planes are perpendicular to `axes`
// and to the piece's principal axes, and those of the faces beside the sharpest concave edges. Where
// the best of them takes away less than a third of the concavity, as a ring's first does, each of
// the better ones and of those through the centre is tried with the best cut of each of its parts.
// `sign` is the sign of the whole mesh's volume. Around a closed cavity two cuts gain nothing, so
// such a piece is not cut.
std::vector<Piece> best_cut(const Piece& piece, const Mat3d& axes, double sign);

// Returns convex parts whose union certainly contains the solid of the mesh, in the body's local
// frame.
//
// The method is approximate convex decomposition by planes, as in Wei, Liu, Su, "Approximate convex
// decomposition for 3D meshes with collision-aware concavity and tree search", SIGGRAPH 2022. Here
// concavity is the volume that the hull adds, the search for a cut looks ahead by one more,
// and parts are joined again while that adds little. A piece that is not closed
// becomes one part, its hull. A sliver that a cut left becomes a box.
//
// The parts contain the solid for this reason: at a point with a nonzero winding number of the
// mesh, one of the pieces has a nonzero winding number (polyhedron.h), so the point is in that
// piece's hull. The error of rounding the cuts is added around each hull.
//
// `most` limits the number of parts. For 0, cuts continue until each hull has at most a hundredth
// of the body's volume too much, with at most 64 parts or as many as the mesh has disconnected
// pieces.
std::vector<Part> decompose(const LocalBody& body, int most);

}  // namespace touchstone::proxies
