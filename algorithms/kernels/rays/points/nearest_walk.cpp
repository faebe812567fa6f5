// The nearest triangle: the choice of the instruction level, and what doubles decide.
#include "algorithms/kernels/rays/points/nearest_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/kernels/rays/points/closest_of.h"
#include "algorithms/kernels/rays/sorted_children.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone::ray_tree {
namespace {

// The nearest point so far, and how far what is looked at may be, in the tree's frame.
class NearestSearch {
 public:
  NearestSearch(const RayMesh& mesh, const Vec3d& point) : mesh_(mesh), point_(point) {
    const Frame& frame = mesh.frame();
    const Vec3d local = (point - frame.centre) * frame.scale;
    reach_ = 1 + local.cwiseAbs().maxCoeff();
    if (is_far()) return;
    for (std::size_t k = 0; k < 3; ++k) at_[k] = static_cast<float>(local[static_cast<int>(k)]);
  }

  // From there on, floats would overflow, and do not tell triangles from each other.
  bool is_far() const { return !(reach_ < 0x1p40); }
  const std::array<float, 3>& at() const { return at_; }
  float limit() const { return limit_; }

  void offer(std::uint32_t triangle, const RayMesh::Corners& corners) {
    const Vec3d found = closest_of(point_, corners);
    const double square = (point_ - found).squaredNorm();
    if (!(square < best_) && is_any_) return;
    is_any_ = true;
    best_ = square;
    nearest_ = {triangle, found};
    if (is_far()) return;
    // Floats are off by the rounding of the point, of a corner, of their difference, and of at most twelve
    // operations with them, which is less than 2^-20 of the reach in all; of boxes, by less.
    const double distance = std::sqrt(square) * mesh_.frame().scale + reach_ * 0x1p-19;
    limit_ = static_cast<float>(distance * (1 + 0x1p-20));
  }
  void offer(const Leaf& leaf, std::size_t lane) {
    offer(leaf.triangle[lane], mesh_.corners(leaf, lane));
  }

  const Nearest& nearest() const { return nearest_; }

 private:
  const RayMesh& mesh_;
  const Vec3d point_;
  std::array<float, 3> at_ = {};
  double reach_;
  float limit_ = 0x1p60F;
  bool is_any_ = false;
  double best_ = std::numeric_limits<double>::infinity();  // square, in the mesh's units
  Nearest nearest_ = {0, Vec3d::Zero()};
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/rays/points/nearest_walk.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

Nearest nearest_of(const RayMesh& mesh, const Vec3d& point) {
  NearestSearch search(mesh, point);
  if (search.is_far()) {
    for (std::uint32_t k = 0; k < mesh.triangles(); ++k) search.offer(k, mesh.corners(k));
    return search.nearest();
  }
  switch (isa()) {
    case Isa::avx512: avx512::find_nearest(mesh, search); break;
    case Isa::avx2: avx2::find_nearest(mesh, search); break;
    case Isa::baseline: baseline::find_nearest(mesh, search); break;
  }
  return search.nearest();
}

}  // namespace touchstone::ray_tree
