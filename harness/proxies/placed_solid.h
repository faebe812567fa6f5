// Convex solids at their poses, and a body as a union of solids, for the measurement of proxies'
// errors. Results are correct to rounding.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/local_body.h"
#include "harness/proxies/representation.h"

namespace touchstone::proxies {

class PlacedSolid {
 public:
  // `turn` is applied after the pose. Throws InputError for a half-space, and for a hull with
  // unknown faces.
  PlacedSolid(const Shape& shape, const Pose& pose, const Mat3d& turn = Mat3d::Identity());

  double volume() const { return volume_; }
  // Distance from x to the surface in metres, negative inside. A closed form, except for an
  // ellipsoid, which is correct to 1e-12 of its size.
  double signed_distance(const Vec3d& x) const;
  // The projection of x, which must be inside a polytope, on the nearest face's plane, and the
  // normal.
  geometry::SurfacePoint way_out(const Vec3d& x) const;
  // The interval of z in which the points (x, y, z) are inside.
  std::optional<std::pair<double, double>> along_z(double x, double y) const;

  // The solid is the convex hull of a set of points, grown by a radius. These are the set itself
  // for balls, capsules, boxes and hulls, 512 points of each rim, and 2562 points of an ellipsoid.
  const std::vector<Vec3d>& extremes() const { return extremes_; }
  double radius() const { return radius_; }
  // Maximum of the convex function f over the solid: exact over vertices; on rims and ellipsoids a
  // local search from the best sample. For a 1-Lipschitz f with several local maxima the result may
  // be low by 2e-5 (rim) or 1e-3 (ellipsoid) of the radius.
  template <class Function>
  double greatest(const Function& f) const;

  bool is_polytope() const { return polytope_; }
  bool solid() const { return volume_ > 0; }
  const std::vector<geometry::Plane>& planes() const { return planes_; }  // of polytopes
  // Triangles of the surface; approximate if the solid is round.
  const std::vector<geometry::Triangle>& surface() const { return surface_.triangles(); }
  Vec3d low() const { return low_; }
  Vec3d high() const { return high_; }

 private:
  double own_volume() const;
  Vec3d local(const Vec3d& x) const { return pose_.rotation.transpose() * (x - pose_.translation); }
  std::optional<std::pair<double, double>> along_line(const Vec3d& from, const Vec3d& by) const;
  // The point of an ellipsoid in a direction, or of the rim at the end with that sign.
  Vec3d rounded(const Vec3d& direction, double end) const;

  Shape shape_;
  Pose pose_;
  Vec3d low_, high_;
  std::vector<Vec3d> extremes_;
  double radius_ = 0, volume_ = 0;
  bool polytope_ = false;
  std::vector<geometry::Plane> planes_;
  geometry::Surface surface_{{}};
};

template <class Function>
double PlacedSolid::greatest(const Function& f) const {
  double best = -std::numeric_limits<double>::infinity();
  const Vec3d* at = nullptr;
  for (const Vec3d& p : extremes_) {
    const double value = f(p);
    if (!(value > best)) continue;
    best = value;
    at = &p;
  }
  const bool rim = shape_.kind == ShapeKind::cylinder || shape_.kind == ShapeKind::cone;
  if (at == nullptr || (!rim && shape_.kind != ShapeKind::ellipsoid)) return best;
  const Vec3d start = local(*at);
  const double end = start.z() >= 0 ? 1 : -1;
  Vec3d direction = rim ? Vec3d(start.x(), start.y(), 0)
                        : Vec3d(start.cwiseQuotient(shape_.radii.cwiseMax(1e-300)));
  if (!(direction.norm() > 0)) return best;  // at a cone's tip
  direction.normalize();
  for (double step = 0.05; step > 1e-9; step /= 2) {
    for (int k = 0; k < (rim ? 2 : 3); ++k) {
      for (double by : {-step, step}) {
        const Vec3d tried = (direction + by * Vec3d::Unit(k)).normalized();
        const double value = f(rounded(tried, end));
        if (!(value > best)) continue;
        best = value;
        direction = tried;
      }
    }
  }
  return best;
}

// Solids in the local frame, rotated by `turn`. The body is the union of the convex ones and of what
// the closed surface winds around.
struct WholeBody {
  WholeBody(const LocalBody& body, const Mat3d& turn);

  std::vector<PlacedSolid> convex;          // hulls of open pieces, or a body without mesh
  std::vector<geometry::Triangle> closed;   // the closed pieces of a mesh
  std::vector<geometry::Triangle> surface;  // approximate if round
  double volume() const;                    // of a mesh as in union_volume.h
};

}  // namespace touchstone::proxies
