// The winding number by the crossings of the ray from the point along the world's x axis.
//
// A triangle counts with its winding number in the plane of y and z around the point, if it is
// crossed before the point. In doubles, coordinates are off by `error`: areas and volumes that are
// above their bounds have the sign of the exact ones, which also covers the rounding of their own
// few operations. The rest is decided in integers.
#include "algorithms/kernels/triangles/winding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/core/mesh/common_frame.h"
#include "algorithms/kernels/triangles/exact_triangles.h"

namespace touchstone {
namespace {

// The winding number of a triangle in the plane of y and z around q, if the ray from q crosses it.
int exact_crossing(const ExactTriangle& t, const ExactPoint& q) {
  int turns = 0;
  for (int i = 0; i < 3; ++i) {
    const ExactPoint &u = t[i], &v = t[(i + 1) % 3];
    const bool u_above = u[2] > q[2], v_above = v[2] > q[2];
    if (u_above == v_above) continue;
    const ExactInteger area = (v[1] - u[1]) * (q[2] - u[2]) - (v[2] - u[2]) * (q[1] - u[1]);
    if (v_above && area.sign() > 0) ++turns;
    if (u_above && area.sign() < 0) --turns;
  }
  return turns * volume_sign(t[0], t[1], t[2], q) < 0 ? turns : 0;
}

enum class Crossing { none, forward, backward, open };

// The same in doubles, relative to the point; `error` bounds each coordinate's.
Crossing rough_crossing(const std::array<Vec3d, 3>& t, double error) {
  const Vec3d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  if (low[1] > error || high[1] < -error || low[2] > error || high[2] < -error ||
      high[0] < -error) {
    return Crossing::none;
  }
  const double size = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  const double area_bound = 32 * size * (error + 0x1p-52 * size) + 1e-280;
  int plus = 0, minus = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3d &u = t[i], &v = t[(i + 1) % 3];
    const double area = u[1] * v[2] - u[2] * v[1];
    if (area > area_bound) ++plus;
    if (area < -area_bound) ++minus;
  }
  if (plus > 0 && minus > 0) return Crossing::none;
  if (plus < 3 && minus < 3) return Crossing::open;
  const double volume = t[0].dot(t[1].cross(t[2]));
  const double bound = 128 * size * size * (error + 0x1p-52 * size) + 1e-280;
  if (!(std::abs(volume) > bound)) return Crossing::open;
  // The volume is positive if the point is behind a triangle that turns anticlockwise, so that the
  // ray meets it.
  if (plus == 3) return volume > 0 ? Crossing::forward : Crossing::none;
  return volume < 0 ? Crossing::backward : Crossing::none;
}

}  // namespace

int winding_number(const TriangleMesh& mesh, const Pose& pose, const Vec3d& point,
                   const Pose& pose_of_point, double reach) {
  const Vec3d q = pose_of_point(point);
  const auto norm = [](const Pose& p) { return p.rotation.cwiseAbs().rowwise().sum().maxCoeff(); };
  const double far = norm(pose) * reach + norm(pose_of_point) * point.cwiseAbs().maxCoeff() +
                     pose.translation.cwiseAbs().maxCoeff() +
                     pose_of_point.translation.cwiseAbs().maxCoeff();
  const double error = 0x1p-49 * far;  // two maps and a difference: less than 10 * 2^-53
  int turns = 0;
  for (const auto& corners : mesh.triangles) {
    std::array<Vec3d, 3> t;
    for (int k = 0; k < 3; ++k) t[k] = pose(mesh.vertices[corners[k]]) - q;
    const Crossing crossing = rough_crossing(t, error);
    if (crossing == Crossing::none) continue;
    if (crossing == Crossing::forward) ++turns;
    if (crossing == Crossing::backward) --turns;
    if (crossing != Crossing::open) continue;
    std::array<PlacedPoint, 4> points;
    for (int k = 0; k < 3; ++k) points[k] = {&mesh.vertices[corners[k]], &pose};
    points[3] = {&point, &pose_of_point};
    std::array<ExactPoint, 4> placed;
    place_exactly(points, placed.data());
    turns += exact_crossing({placed[0], placed[1], placed[2]}, placed[3]);
  }
  return turns;
}

}  // namespace touchstone
