// The loops of moved_block.cpp, once for each level of vector instructions.

#include "algorithms/kernels/triangles/lane_points.inl"

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector load_doubles(const double* from) {
  return Lanes::load(from);
}
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector load_doubles(const float* from) {
  using Narrow = float __attribute__((vector_size(Lanes::width * sizeof(float))));
  Narrow x;
  __builtin_memcpy(&x, from, sizeof x);
  return __builtin_convertvector(x, Vector);
}

TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN inline void widen_block(const FloatTriangleBlock& block,
                                                             TriangleBlock& wide) {
  for (std::size_t row = 0; row < block.at.size(); ++row) {
    for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
      Lanes::store(&wide.at[row][at], load_doubles(&block.at[row][at]));
    }
  }
}

template <class Block>
TOUCHSTONE_TARGET TOUCHSTONE_FLATTEN void move_block(const Block& block, const Pose& pose,
                                                     TriangleBlock& moved) {
  for (std::size_t at = 0; at < TriangleBlock::size; at += Lanes::width) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Points p = {load_doubles(&block.at[3 * k][at]), load_doubles(&block.at[3 * k + 1][at]),
                        load_doubles(&block.at[3 * k + 2][at])};
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
