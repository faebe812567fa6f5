// A piece of a mesh that is being decomposed, and the hull that would stand for it.
#pragma once

#include <memory>
#include <vector>

#include "algorithms/core/shape.h"
#include "harness/geometry/mesh.h"

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

}  // namespace touchstone::proxies
