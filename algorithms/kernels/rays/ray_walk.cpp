// The ray in the tree's frame, and the choice of the instruction level.
#include "algorithms/kernels/rays/ray_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone::ray_tree {
namespace {

constexpr double unit = 0x1p-53;        // a double's rounding
constexpr double float_unit = 0x1p-24;  // a float's

// A child whose box is met at tau = near.
struct Met {
  std::int32_t child;
  float near;
};

// A float that is not less than x, and one that is not greater; off by less than two of its digits.
float widened_up(double x) {
  const auto f = static_cast<float>(x);
  return f + std::abs(f) * 0x1p-23F + 0x1p-100F;
}
float widened_down(double x) { return -widened_up(-x); }

// 2^exponent, for exponents of normal numbers.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}
int exponent_of(double normal) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(normal) >> 52 & 0x7ff) - 1023;
}

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/rays/ray_walk.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

template <class Query>
void dispatch(const RayMesh& mesh, const LocalRay& local, RayTask task, Query& query) {
  switch (isa()) {
    case Isa::avx512: return avx512::walk_tree(mesh, local, task, query);
    case Isa::avx2: return avx2::walk_tree(mesh, local, task, query);
    case Isa::baseline: return baseline::walk_tree(mesh, local, task, query);
  }
}

}  // namespace

float LocalRay::tau_end(double t) const {
  return widened_up((t * per_t) * (1 + 0x1p-40) - moved * (1 - 0x1p-40) +
                    static_cast<double>(tau_off));
}

bool localise(const RayMesh& mesh, const Ray& ray, LocalRay& local) {
  const Frame& frame = mesh.frame();
  const Vec3d from = (ray.origin - frame.centre) * frame.scale;
  const double reach = from.cwiseAbs().maxCoeff();
  if (!(reach < 0x1p30)) return false;
  Eigen::Index z = 0;
  const double greatest = ray.direction.cwiseAbs().maxCoeff(&z);
  const int exponent = exponent_of(greatest);
  if (std::abs(exponent) > 900) return false;
  const Vec3d direction = ray.direction * power_of_two(-exponent);
  local.per_t = frame.scale * power_of_two(exponent);

  // The tree lies within 1 of the frame's centre on each axis. The ray comes that near at `enter` at
  // the soonest; the margin is far more than the rounding.
  double enter = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double gap = std::abs(from[axis]) - 1;
    if (gap > 0 && from[axis] * direction[axis] < 0) {
      enter = std::max(enter, gap / std::abs(direction[axis]));
    }
  }
  // A ray that comes near after so long a way misses the mesh, or comes nearer on another axis.
  local.moved = enter < 0x1p31 ? std::max(0.0, enter * (1 - 0x1p-40) - 0x1p-10) : 0.0;
  const Vec3d origin = from + local.moved * direction;
  const double off_double = 8 * unit * (reach + 2 * local.moved);
  const double origin_reach = origin.cwiseAbs().maxCoeff();

  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    const double along = std::abs(direction[k]) < 0x1p-60 ? 0.0 : direction[k];
    const bool forward = along >= 0;
    // 2^-50 is more than a component that was left out moves the ray over the whole way.
    const double off = off_double + 0x1p-50;
    const double ahead = origin[k] + off, behind = origin[k] - off;
    local.near_origin[axis] = forward ? widened_up(ahead) : widened_down(behind);
    local.far_origin[axis] = forward ? widened_down(behind) : widened_up(ahead);
    // Zero counts as positive, whatever its sign.
    local.inverse[axis] = 1 / static_cast<float>(along == 0 ? 0.0 : along);
    local.near[axis] = forward ? axis : axis + 3;
    local.far[axis] = forward ? axis + 3 : axis;
  }
  local.axes = {static_cast<std::size_t>((z + 1) % 3), static_cast<std::size_t>((z + 2) % 3),
                static_cast<std::size_t>(z)};
  for (std::size_t k = 0; k < 3; ++k) {
    local.origin[k] = static_cast<float>(origin[static_cast<Eigen::Index>(local.axes[k])]);
  }
  const auto along = [&](std::size_t k) {
    return direction[static_cast<Eigen::Index>(local.axes[k])];
  };
  const double inverse = 1 / along(2);
  local.shear_x = static_cast<float>(along(0) * inverse);
  local.shear_y = static_cast<float>(along(1) * inverse);
  local.inverse_z = static_cast<float>(inverse);
  // A vertex seen from the origin is up to `seen` long. Its coordinate is off by the vertex's own
  // rounding (none if the leaves are exact), the origin's in doubles and in floats, and one of the
  // difference. The sheared one has two such errors, the shear's rounding, a product's and a sum's.
  const double seen = 1 + origin_reach;
  const double coordinate = (mesh.is_exact() ? 0 : float_unit) + off_double +
                            float_unit * origin_reach + float_unit * seen;
  local.off = widened_up(1.01 * (2 * coordinate + 4 * float_unit * seen));
  local.tau_off = widened_up(1.01 * (coordinate + 3 * float_unit * seen));
  return true;
}

void walk(const RayMesh& mesh, const LocalRay& local, RayTask task, RayQuery& query) {
  dispatch(mesh, local, task, query);
}
void walk(const RayMesh& mesh, const LocalRay& local, RayTask task, WindingQuery& query) {
  dispatch(mesh, local, task, query);
}

}  // namespace touchstone::ray_tree
