// Rays in blocks: their choice of the instruction level, and those that floats do not decide.
#include "algorithms/kernels/rays/ray_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "algorithms/kernels/rays/found_hit.h"
#include "algorithms/kernels/rays/sorted_children.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone::ray_tree {
namespace {

constexpr double unit = 0x1p-53;        // a double's rounding
constexpr double float_unit = 0x1p-24;  // a float's

// A float on that side of x to which `outward` (1 or -1) points; off by less than two of its digits.
inline float widened(double x, float outward) {
  const auto f = static_cast<float>(x);
  return f + outward * (std::abs(f) * 0x1p-23F + 0x1p-100F);
}

constexpr std::size_t rays_in_turn = 2;

struct HitNumbers {
  RayBlock::Each<double> t, u, v;
};

// The hit of a ray that is tested against every triangle.
RayHit hit_of_all(const RayMesh& mesh, RayTask task, const Ray& ray) {
  if (!is_proper(ray)) return improper_hit();
  RayQuery query(ray);
  for (std::uint32_t k = 0; k < mesh.triangles(); ++k) {
    const auto [a, b, c] = mesh.corners(k);
    if (query.offer(k, a, b, c) && task == RayTask::any) break;
  }
  return query.hit();
}

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/rays/ray_levels.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// Rays as arrays. Behind the last one it comes again, so that all lanes have numbers.
void load(std::span<const Ray> rays, RayBlock& block) {
  block.count = rays.size();
  for (std::size_t i = 0; i < RayBlock::most; ++i) {
    const Ray& ray = rays[std::min(i, rays.size() - 1)];
    for (std::size_t k = 0; k < 3; ++k) {
      block.from[k][i] = ray.origin[static_cast<Eigen::Index>(k)];
      block.direction[k][i] = ray.direction[static_cast<Eigen::Index>(k)];
    }
    block.t_max[i] = ray.t_max;
  }
}

}  // namespace

float RayBlock::tau_end_of(std::size_t ray, double t) const {
  return widened((t * per_t[ray]) * (1 + 0x1p-40) - moved[ray] * (1 - 0x1p-40) +
                     static_cast<double>(tau_off[ray]),
                 1);
}

bool DoubtfulRay::offer(const FoundHit& one) {
  const Leaf& leaf = mesh_.leaves()[one.leaf];
  const auto [a, b, c] = mesh_.corners(leaf, one.lane);
  return query_->offer(leaf.triangle[one.lane], a, b, c);
}

bool DoubtfulRay::offer(const FoundHit& found, const FoundHit& other, RayTask task,
                        float& tau_end) {
  if (!query_) {
    const auto at = [&](const auto& of) { return Vec3d(of[0][ray_], of[1][ray_], of[2][ray_]); };
    query_.emplace(Ray{at(block_.from), at(block_.direction), block_.t_max[ray_]});
  }
  if (found.is_found() && found != offered_) {
    offer(found);
    offered_ = found;
  }
  if (offer(other) && task == RayTask::any) return true;
  // A box's near end has four roundings.
  const float end = block_.tau_end_of(ray_, query_->t_end());
  tau_end = std::min(tau_end, end * (1 + 16 * static_cast<float>(float_unit)));
  return false;
}

RayHit DoubtfulRay::hit(const FoundHit& found) {
  if (found.is_found() && found != offered_) offer(found);
  return query_->hit();
}

void cast_each(const RayMesh& mesh, RayTask task, std::span<const Ray> rays,
               std::span<RayHit> hits) {
  if (mesh.triangles() == 0) {
    std::ranges::transform(rays, hits.begin(),
                           [&](const Ray& ray) { return hit_of_all(mesh, task, ray); });
    return;
  }
  RayBlock block;
  load(rays, block);
  switch (isa()) {
    case Isa::avx512: return avx512::cast_block(mesh, task, rays, block, hits);
    case Isa::avx2: return avx2::cast_block(mesh, task, rays, block, hits);
    case Isa::baseline: return baseline::cast_block(mesh, task, rays, block, hits);
  }
}

void wind_each(const RayMesh& mesh, std::span<WindingQuery> queries) {
  std::array<Ray, RayBlock::most> rays;
  for (std::size_t i = 0; i < queries.size(); ++i) rays[i] = queries[i].ray();
  RayBlock block;
  load(std::span(rays).first(queries.size()), block);
  switch (isa()) {
    case Isa::avx512: return avx512::wind_block(mesh, queries, block);
    case Isa::avx2: return avx2::wind_block(mesh, queries, block);
    case Isa::baseline: return baseline::wind_block(mesh, queries, block);
  }
}

}  // namespace touchstone::ray_tree
