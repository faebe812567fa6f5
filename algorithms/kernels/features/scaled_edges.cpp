// Scales moving edges.
#include "algorithms/kernels/features/scaled_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace touchstone {

bool scale_edges(const std::array<Vec3d, 4>& start, const std::array<Vec3d, 4>& end,
                 ScaledEdges& edges) {
  double* to = edges.at.data();
  double reach = 0;
  for (const std::array<Vec3d, 4>* x : {&start, &end}) {
    for (std::size_t i = 1; i < 4; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        *to = (*x)[i][axis] - (*x)[0][axis];
        reach = std::max(reach, std::abs(*to));
        ++to;
      }
    }
  }
  edges.scale = 1;
  if (reach >= 0x1p-1000 && reach < 0x1p1000) {
    // 2^-(e + 1) for a reach of exponent e.
    const std::uint64_t biased = std::bit_cast<std::uint64_t>(reach) >> 52;
    edges.scale = std::bit_cast<double>((std::uint64_t{2045} - biased) << 52);
  } else if (!std::isfinite(reach)) {
    return false;
  } else if (reach != 0) {
    edges.scale = std::ldexp(1, std::clamp(-std::ilogb(reach) - 1, -1022, 1023));
  }
  for (double& x : edges.at) x *= edges.scale;
  return true;
}

}  // namespace touchstone
