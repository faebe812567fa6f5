// The bounds of stretch.h. stretch.cpp includes this file once for each level of vector instructions.
#include "algorithms/kernels/simd/quad_sums.inl"

TOUCHSTONE_TARGET Stretch stretch_at(const Pose& pose) {
  const QuadColumns all = columns_at(pose);
  const Quad<double> x = three_of(all.x), y = three_of(all.y), z = three_of(all.z);
  const Quad<double> squares = sums_of(x * x, y * y, z * z, Quad<double>{});
  const Quad<double> skews = sums_of(x * y, y * z, z * x, Quad<double>{});
  // The greatest eigenvalue of M^T M, which is symmetric, is at most its greatest row sum.
  const Quad<double> sizes = magnitudes(skews);
  const Quad<double> rows = squares + sizes + __builtin_shufflevector(sizes, sizes, 2, 0, 1, 3);
  const double greatest = std::max({rows[0], rows[1], rows[2]});
  // |M x|^2 = x (M^T M) x >= 1 - |M^T M - I|.
  const Quad<double> off = squares - Quad<double>{1, 1, 1, 0};
  const Quad<double> terms = off * off + 2 * (skews * skews);
  const double distance = (1 + 1e-15) * std::sqrt(terms[0] + terms[1] + terms[2]);
  constexpr double rounding = 1e-15;
  return {.most = std::sqrt(greatest) * (1 + 1e-12),
          .least = std::max(0.0, 1 - rounding - distance)};
}
