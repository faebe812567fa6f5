// Scales moving edges.
#include "algorithms/kernels/features/scaled_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace touchstone {

double scale_of_edges(double reach) {
  if (reach >= 0x1p-1000 && reach < 0x1p1000) {
    // 2^-(e + 1) for a reach of exponent e.
    const std::uint64_t biased = std::bit_cast<std::uint64_t>(reach) >> 52;
    return std::bit_cast<double>((std::uint64_t{2045} - biased) << 52);
  }
  if (!std::isfinite(reach)) return 0;
  return reach == 0 ? 1 : std::ldexp(1, std::clamp(-std::ilogb(reach) - 1, -1022, 1023));
}

bool scale_edges(const std::array<Vec3d, 4>& start, const std::array<Vec3d, 4>& end,
                 ScaledEdges& edges) {
  double* to = edges.at.data();
  Vec3d reaches = Vec3d::Zero();  // by axis, because one maximum of all would wait for each
  for (const std::array<Vec3d, 4>* x : {&start, &end}) {
    for (std::size_t i = 1; i < 4; ++i, to += 3) {
      const Vec3d edge = (*x)[i] - (*x)[0];
      reaches = reaches.cwiseMax(edge.cwiseAbs());
      Eigen::Map<Vec3d>{to} = edge;
    }
  }
  edges.scale = scale_of_edges(reaches.maxCoeff());
  if (edges.scale == 0) return false;
  for (double& x : edges.at) x *= edges.scale;
  return true;
}

}  // namespace touchstone
