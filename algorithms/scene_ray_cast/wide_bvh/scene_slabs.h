// Part of the scene's wide-bvh: a ray at the boxes of a node, in doubles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/kernels/bvh/wide_bvh.h"
#include "algorithms/ray_cast.h"

namespace touchstone {

// A ray on its way through the tree.
struct SceneSlabs {
  std::array<double, 3> origin, inverse;
  std::array<std::size_t, 3> near, far;

  explicit SceneSlabs(const Ray& ray) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      origin[k] = ray.origin[axis];
      // A component of zero would make NaN of a plane at the origin. This one is too small to move
      // the ray from box to box.
      const double size =
          std::max(std::abs(ray.direction[axis]), ray.direction.cwiseAbs().maxCoeff() * 0x1p-80);
      const bool backward = ray.direction[axis] < 0;
      inverse[k] = (backward ? -1 : 1) / size;
      near[k] = backward ? k + 3 : k;
      far[k] = backward ? k : k + 3;
    }
  }

  // The children that the ray meets before t_end, as bits; `begin` gets where.
  unsigned meet(const WideNode& node, double t_end, std::array<double, 8>& begin) const {
    std::array<double, 8> end;
    begin.fill(0);
    end.fill(t_end);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t lane = 0; lane < 8; ++lane) {
        const double first =
            (static_cast<double>(node.planes[near[k]][lane]) - origin[k]) * inverse[k];
        const double last =
            (static_cast<double>(node.planes[far[k]][lane]) - origin[k]) * inverse[k];
        begin[lane] = std::max(begin[lane], first);
        end[lane] = std::min(end[lane], last);
      }
    }
    unsigned bits = 0;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      // Each has three roundings.
      bits |= (begin[lane] <= end[lane] * (1 + 0x1p-49) ? 1U : 0U) << lane;
    }
    return bits;
  }
};

}  // namespace touchstone
