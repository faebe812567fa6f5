// Selects the instruction level of plane_lanes.inl.
#include "algorithms/kernels/batch/plane_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstring>

#include "algorithms/kernels/batch/pair_lanes.h"
#include "algorithms/kernels/batch/prefetch.h"
#include "algorithms/kernels/gjk/carried_plane.h"

namespace touchstone {
namespace {

using simd::Quad;

// The plane of pair i.
const CarriedPlane& plane_of(const PlaneTable& table, std::size_t i) {
  return carried_plane_at(table.memory + PlaneTable::memory_bytes * table.memory_of[i]);
}

void write_parted(Outcome& outcome) {
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  outcome.iterations = outcome.support_calls = 0;
}

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/batch/plane_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

std::size_t part_one_by_one(const PlaneTable& table, Outcome* outcomes, const PlaneRest& rest) {
  const BodyPairs& pairs = table.pairs;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const Pose &a = pairs.poses[pairs.first[i]], &b = pairs.poses[pairs.second[i]];
    const CarriedPlane& plane = plane_of(table, i);
    if (plane.parts(a, b, table.margin)) {
      write_parted(outcomes[i]);
      continue;
    }
    rest.left[count++] = static_cast<std::uint32_t>(i);
    if (rest.directions == nullptr) continue;
    const Vec3<float> normal = plane.normal(a, b).cast<float>();
    rest.directions[i] = {normal.x(), normal.y(), normal.z(), 0};
  }
  return count;
}

}  // namespace

std::size_t part_by_planes(const PlaneTable& table, Outcome* outcomes, const PlaneRest& rest) {
  // A few pairs fill too little of the lanes.
  constexpr std::size_t few = 2;
  if (table.pairs.first.size() <= few) return part_one_by_one(table, outcomes, rest);
  switch (isa()) {
    case Isa::avx512: return avx512::part_pairs(table, outcomes, rest);
    case Isa::avx2: return avx2::part_pairs(table, outcomes, rest);
    case Isa::baseline: break;
  }
  return baseline::part_pairs(table, outcomes, rest);
}

}  // namespace touchstone
