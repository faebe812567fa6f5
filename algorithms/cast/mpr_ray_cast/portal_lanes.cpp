// Part of mpr-ray-cast-lanes: selects the level of vector instructions.
#include "algorithms/cast/mpr_ray_cast/portal_lanes.h"

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstring>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/minkowski/hull_scan.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

using simd::Quad;

#define TOUCHSTONE_TARGET_NAMESPACE hull_scan
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/cast/mpr_ray_cast/portal_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

void search_portals(std::span<const PortalQuery> queries, int most_iterations,
                    std::span<PortalAnswer> answers) {
  switch (isa()) {
    case Isa::avx512: return avx512::search_all(queries, most_iterations, answers);
    case Isa::avx2: return avx2::search_all(queries, most_iterations, answers);
    case Isa::baseline: break;
  }
  baseline::search_all(queries, most_iterations, answers);
}

}  // namespace touchstone
