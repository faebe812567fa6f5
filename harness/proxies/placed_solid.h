// Convex solids in their places, as measured by RepresentationError. Good to rounding.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "harness/geometry/mesh_solid.h"
#include "harness/proxies/representation.h"

namespace touchstone {

class PlacedSolid {
 public:
  // `turn` is applied behind the pose. Throws InputError for a half-space, and for a hull whose
  // faces are not known.
  PlacedSolid(const Shape& shape, const Pose& pose, const Mat3d& turn = Mat3d::Identity());

  double volume() const { return volume_; }
  // Metres: from x to the surface, negative inside. Closed form; of an ellipsoid to 1e-12 of it.
  double signed_distance(const Vec3d& x) const;
  // For x inside a polytope: the point of its nearest face's plane that is nearest, and the normal.
  SurfacePoint way_out(const Vec3d& x) const;
  // Where the line of points (x, y, z) is inside.
  std::optional<std::pair<double, double>> along_z(double x, double y) const;

  // The solid is the convex hull of some set of points, grown by a radius. These are the set itself
  // of balls, capsules, boxes and hulls; of rims 512 points each, and of an ellipsoid 2562.
  const std::vector<Vec3d>& extremes() const { return extremes_; }
  double radius() const { return radius_; }
  // The greatest value over the set of f, which is convex: over the points, and on the rims and the
  // ellipsoid climbed from the best of them, so that what may be missed of a function that changes
  // by at most 1 a metre is 2e-5 of a rim's radius, 1e-3 of an ellipsoid's, where it has other
  // tops.
  template <class Function>
  double greatest(const Function& f) const;

  bool is_polytope() const { return polytope_; }
  bool solid() const { return volume_ > 0; }
  const std::vector<Plane>& planes() const { return planes_; }                   // of polytopes
  const std::vector<Triangle>& surface() const { return surface_.triangles(); }  // near it if round
  Vec3d low() const { return low_; }
  Vec3d high() const { return high_; }

 private:
  double own_volume() const;
  Vec3d local(const Vec3d& x) const { return pose_.rotation.transpose() * (x - pose_.translation); }
  std::optional<std::pair<double, double>> along_line(const Vec3d& from, const Vec3d& by) const;
  // The point of the rim (of the end of that sign) or ellipsoid in a direction.
  Vec3d rounded(const Vec3d& direction, double end) const;

  Shape shape_;
  Pose pose_;
  Vec3d low_, high_;
  std::vector<Vec3d> extremes_;
  double radius_ = 0, volume_ = 0;
  bool polytope_ = false;
  std::vector<Plane> planes_;
  Surface surface_{{}};
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
  if (!(direction.norm() > 0)) return best;  // a cone's tip
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

}  // namespace touchstone
