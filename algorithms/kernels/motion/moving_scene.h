// The shapes of a scene as casts need them. Used by linear_cast.h and advancing_cast.h.
#pragma once

#include <span>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/kernels/motion/inner_ball.h"
#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

class MovingScene {
 public:
  void bind(std::span<const Shape> shapes) {
    shapes_ = make_support_shapes<double>(shapes);
    inner_radii_ = inner_radii(shapes, shapes_);
  }
  // Body k of the batch's pairs.
  MovingBody body(const CastBatch& batch, std::uint32_t k) const {
    const std::uint32_t shape = batch.pairs.shape_of[k];
    const Pose& pose = batch.pairs.poses[k];
    return {&shapes_[shape], &pose, &batch.motions[k], inner_radii_[shape], stretch_of(pose)};
  }
  // The greatest distance (metres) of a shape's points from its centre.
  double size(std::uint32_t shape) const { return shapes_[shape].size + shapes_[shape].radius; }

 private:
  std::vector<SupportShape<double>> shapes_;
  std::vector<double> inner_radii_;  // metres, one for each shape
};

}  // namespace touchstone
