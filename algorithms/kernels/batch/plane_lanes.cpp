// Selects the instruction level of plane_lanes.inl.
#include "algorithms/kernels/batch/plane_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstring>

#include "algorithms/kernels/batch/prefetch.h"
#include "algorithms/kernels/gjk/carried_plane.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using simd::Quad;

const std::byte* memory_of(const PlaneTable& table, std::size_t i) {
  return table.memory + PlaneTable::memory_bytes * table.memory_of[i];
}

void write_parted(Outcome& outcome) {
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  outcome.iterations = outcome.support_calls = 0;
}

#if defined(__x86_64__)
#define TOUCHSTONE_NO_BASELINE
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/batch/plane_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"
#undef TOUCHSTONE_NO_BASELINE
#endif

std::size_t part_one_by_one(const PlaneTable& table, Outcome* outcomes, const PlaneRest& rest) {
  const BodyPairs& pairs = table.pairs;
  const std::size_t size = pairs.first.size();
  constexpr std::size_t ahead = 8;  // pairs, about as many as it takes to fetch one
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (i + ahead < size) {
      prefetch(&pairs.poses[pairs.first[i + ahead]], sizeof(Pose));
      prefetch(&pairs.poses[pairs.second[i + ahead]], sizeof(Pose));
      prefetch(memory_of(table, i + ahead), 1);
    }
    const Pose &a = pairs.poses[pairs.first[i]], &b = pairs.poses[pairs.second[i]];
    const CarriedPlane& plane = carried_plane_at(memory_of(table, i));
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
#if defined(__x86_64__)
  // A few pairs fill too little of the lanes.
  constexpr std::size_t few = 2;
  const bool is_few = table.pairs.first.size() <= few;
  if (!is_few && isa() == Isa::avx512) return avx512::part_pairs(table, outcomes, rest);
  if (!is_few && isa() == Isa::avx2) return avx2::part_pairs(table, outcomes, rest);
#endif
  // At baseline, vectors of four doubles are two, and take longer than the four numbers of one plane.
  return part_one_by_one(table, outcomes, rest);
}

}  // namespace touchstone
