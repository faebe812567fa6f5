// How often a surface winds around a point, without an error.
// Papers: Edelsbrunner, Muecke, "Simulation of simplicity", TOG 9, 1990 (points above edges);
//         Shewchuk, DCG 18, 1997 (signs of areas and volumes, filtered).
#pragma once

#include <cstdint>
#include <limits>

#include "algorithms/kernels/rays/ray_query.h"

namespace touchstone {

// Counts the triangles above the point (on z), those that turn up as +1 and those that turn down as
// -1. A point under an edge or a vertex counts as moved by a little on x, and far less on y.
class WindingQuery {
 public:
  // The point is finite.
  explicit WindingQuery(const Vec3d& point) : point_(point) {}

  // The ray along which the triangles are: every one that this ray meets has to be offered.
  Ray ray() const { return {point_, Vec3d::UnitZ()}; }
  double t_end() const { return std::numeric_limits<double>::infinity(); }

  // Returns true if the point is on the triangle, and nothing else matters.
  bool offer(std::uint32_t triangle, const Vec3d& a, const Vec3d& b, const Vec3d& c);

  // The same for triangles that are above the point for certain: those that turn up less the others.
  void count(int turns) { winding_ += turns; }

  bool is_on_surface() const { return is_on_surface_; }
  int winding() const { return winding_; }
  // True if numbers were too small or too great to decide (beyond 2^-120 or 2^120).
  bool is_undecided() const { return undecided_; }

 private:
  int volume_sign(const Vec3d& a, const Vec3d& b, const Vec3d& c);
  int area_sign(const Vec3d& a, const Vec3d& b);

  Vec3d point_;
  int winding_ = 0;
  bool is_on_surface_ = false, undecided_ = false;
};

}  // namespace touchstone
