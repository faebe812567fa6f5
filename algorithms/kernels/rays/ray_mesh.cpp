// The choice of the frame, and the tree with its leaves.
#include "algorithms/kernels/rays/ray_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/aabb.h"
#include "algorithms/core/double_double.h"
#include "algorithms/core/nearest_float.h"

namespace touchstone::ray_tree {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

// The scale that takes `reach` to 1/2 to 1.
double scale_of(double reach) {
  if (!(reach > 0)) return 1;
  return std::ldexp(1.0, std::clamp(-1 - std::ilogb(reach), -1000, 1000));
}

}  // namespace

Vec3d RayMesh::vertex(std::uint32_t number) const {
  const Vec3d& v = mesh_->vertices[number];
  return scalar_ == Precision::float64 ? v : nearest_float(v);
}

RayMesh::Corners RayMesh::corners(std::uint32_t triangle) const {
  const auto& [a, b, c] = mesh_->triangles[triangle];
  return {vertex(a), vertex(b), vertex(c)};
}

// Takes the frame, and finds out whether all vertices are floats in it.
bool RayMesh::try_frame(const Frame& frame) {
  frame_ = frame;
  exact_ = true;
  size_ = 1 / frame.scale;
  for (const auto& triangle : mesh_->triangles) {
    for (const std::uint32_t number : triangle) {
      const Vec3d v = vertex(number);
      for (int axis = 0; axis < 3; ++axis) {
        const DoubleDouble from_centre = DoubleDouble::sum(v[axis], -frame.centre[axis]);
        const double local = nearest_float(from_centre.high * frame.scale);
        if (from_centre.low == 0 && local * size_ == from_centre.high) continue;
        exact_ = false;
        return false;
      }
    }
  }
  return true;
}

RayMesh::RayMesh(const TriangleMesh& mesh, Precision scalar) : mesh_(&mesh), scalar_(scalar) {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t number : triangle) {
      low = low.cwiseMin(vertex(number));
      high = high.cwiseMax(vertex(number));
    }
  }
  if (mesh.triangles.empty()) return;
  Vec3d middle = nearest_float(Vec3d(low / 2 + high / 2));
  if (!middle.allFinite()) middle = low / 2 + high / 2;
  const double reach = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  const double radius = (low - middle).cwiseAbs().cwiseMax((high - middle).cwiseAbs()).maxCoeff();
  // Where floats are the vertices themselves, nothing is looked up elsewhere. A mesh far from the
  // origin is small there, with few digits left, and needs its own centre.
  if (reach > 8 * radius || !try_frame({Vec3d::Zero(), scale_of(reach)})) {
    try_frame({middle, scale_of(radius)});
  }
  std::vector<Aabb> boxes(mesh.triangles.size(), Aabb::empty());
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    for (const Vec3d& v : corners(k)) {
      for (int axis = 0; axis < 3; ++axis) {
        const double x = (v[axis] - frame_.centre[axis]) * frame_.scale;
        float& least = boxes[k].min[static_cast<std::size_t>(axis)];
        float& most = boxes[k].max[static_cast<std::size_t>(axis)];
        // The difference is off by half of a double's last digit: less than a float's.
        least = std::min(
            least, exact_ ? static_cast<float>(x) : std::nextafter(round_down(x), -unbounded));
        most =
            std::max(most, exact_ ? static_cast<float>(x) : std::nextafter(round_up(x), unbounded));
      }
    }
  }
  tree_ = build_wide_bvh(boxes);
  leaves_.resize(tree_.leaves());
  for (std::size_t n = 0; n < leaves_.size(); ++n) {
    const auto numbers = tree_.leaf(n);
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const std::uint32_t triangle = numbers[std::min(lane, numbers.size() - 1)];
      leaves_[n].triangle[lane] = triangle;
      const Corners at = corners(triangle);
      for (std::size_t k = 0; k < 9; ++k) {
        const auto axis = static_cast<int>(k % 3);
        leaves_[n].corners[k][lane] =
            lane < numbers.size()
                ? static_cast<float>((at[k / 3][axis] - frame_.centre[axis]) * frame_.scale)
                : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

}  // namespace touchstone::ray_tree
