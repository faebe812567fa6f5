// The loops of moved_block.cpp, once for each level of vector instructions.

#include "algorithms/kernels/triangles/lane_points.inl"

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN void move_block(const Block& block, const Pose& pose,
                                                     TriangleBlock& moved) {
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Points p = points_at(block, k, at);
      for (int row = 0; row < 3; ++row) {
        const Vector x = Lanes::broadcast(pose.rotation(row, 0)) * p.x +
                         Lanes::broadcast(pose.rotation(row, 1)) * p.y +
                         Lanes::broadcast(pose.rotation(row, 2)) * p.z +
                         Lanes::broadcast(pose.translation[row]);
        Lanes::store(&moved.at[3 * k + static_cast<std::size_t>(row)][at], x);
      }
    }
  }
}
