// The placement of a pair of bodies in its own unit, and the test of its bounding balls.
#include "algorithms/kernels/minkowski/support.h"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

// A sum that also adds up its rounding errors, as if it had twice the digits. Source: Ogita, Rump,
// Oishi, "Accurate sum and dot product", SIAM J. Scientific Computing 26(6), 2005. Factors beyond
// 2^996 make it NaN.
class CarefulSum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    const double part = sum - sum_;
    dropped_ += (sum_ - (sum - part)) + (x - part);
    sum_ = sum;
  }
  void add_product(double x, double y) {
    const double product = x * y;
    const Halves a = halves(x), b = halves(y);
    dropped_ += a.low * b.low - (((product - a.high * b.high) - a.low * b.high) - a.high * b.low);
    add(product);
  }
  double value() const { return sum_ + dropped_; }

 private:
  struct Halves {
    double high, low;
  };
  static Halves halves(double x) {
    const double shifted = 0x1.0000002p27 * x;
    const double high = shifted - (shifted - x);
    return {high, x - high};
  }

  double sum_ = 0, dropped_ = 0;
};

}  // namespace

template <class Scalar>
CentreOffset centre_offset(const SupportShape<Scalar>& a, const Pose& pose_a,
                           const SupportShape<Scalar>& b, const Pose& pose_b) {
  if (a.is_centred && b.is_centred) {
    return {pose_b.translation - pose_a.translation, 0};
  }
  if (a.is_near_origin && b.is_near_origin) {
    return {(pose_b.rotation * b.centre - pose_a.rotation * a.centre) +
                (pose_b.translation - pose_a.translation),
            0};
  }
  // If the vertices of a hull are far from its origin, its rotated centre needs more digits than a
  // double has. The remaining error is sixteen roundings of the terms' sum, squared: 2^-98 of it.
  CentreOffset offset;
  double terms = 0;
  for (int row = 0; row < 3; ++row) {
    CarefulSum sum;
    sum.add(pose_b.translation[row]);
    sum.add(-pose_a.translation[row]);
    for (int k = 0; k < 3; ++k) {
      sum.add_product(pose_b.rotation(row, k), b.centre[k]);
      sum.add_product(-pose_a.rotation(row, k), a.centre[k]);
      terms += std::abs(pose_b.rotation(row, k) * b.centre[k]) +
               std::abs(pose_a.rotation(row, k) * a.centre[k]);
    }
    terms += std::abs(pose_b.translation[row]) + std::abs(pose_a.translation[row]);
    offset.vector[row] = sum.value();
  }
  offset.doubt = 0x1p-98 * terms;
  return offset;
}

namespace {

template <bool with_margin, class Scalar>
bool are_apart([[maybe_unused]] double margin, const CentreOffset& offset,
               const SupportShape<Scalar>& a, const Pose& pose_a, const SupportShape<Scalar>& b,
               const Pose& pose_b) {
  // A matrix lengthens a vector by at most its Frobenius norm. Rounding is a dozen units in the
  // last place of the norms, the sizes and the squares; for the offset it is as much of the greater
  // of itself and the reach. Overflow makes the result false; squares that nearly underflow are not
  // used.
  constexpr double beyond_rounding = 1 + 1e-12;
  constexpr double least_square = 1e-280;
  const double stretch_a = pose_a.rotation.squaredNorm();
  const double stretch_b = pose_b.rotation.squaredNorm();
  const double reach_a = a.size * std::sqrt(stretch_a) + a.radius;
  const double reach_b = b.size * std::sqrt(stretch_b) + b.radius;
  double reach = (reach_a + reach_b) * beyond_rounding + 2 * offset.doubt;
  if constexpr (with_margin) reach += margin * beyond_rounding;
  const double square = offset.vector.squaredNorm();
  return square > reach * reach && square > least_square && stretch_a > least_square &&
         stretch_b > least_square && reach < std::numeric_limits<double>::infinity();
}

}  // namespace

template <class Scalar>
bool balls_are_apart(const CentreOffset& offset, const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b) {
  return are_apart<false>(0, offset, a, pose_a, b, pose_b);
}

template <class Scalar>
bool balls_are_apart_by(double margin, const CentreOffset& offset, const SupportShape<Scalar>& a,
                        const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b) {
  return are_apart<true>(margin, offset, a, pose_a, b, pose_b);
}

template <class Scalar>
SupportPair<Scalar>::SupportPair(const SupportShape<Scalar>& a, const Pose& pose_a,
                                 const SupportShape<Scalar>& b, const Pose& pose_b)
    : SupportPair(centre_offset(a, pose_a, b, pose_b), a, pose_a, b, pose_b) {}

// The doubt of the offset must be less than a rounding of the unit.
template <class Scalar>
SupportPair<Scalar>::SupportPair(const CentreOffset& offset, const SupportShape<Scalar>& a,
                                 const Pose& pose_a, const SupportShape<Scalar>& b,
                                 const Pose& pose_b)
    : SupportPair(
          offset,
          power_of_two_above(std::max({offset.vector.cwiseAbs().maxCoeff(), 0x1p54 * offset.doubt,
                                       a.reach(pose_a.rotation), b.reach(pose_b.rotation)})),
          a, pose_a, b, pose_b) {}

template <class Scalar>
SupportPair<Scalar>::SupportPair(const CentreOffset& offset, double unit,
                                 const SupportShape<Scalar>& a, const Pose& pose_a,
                                 const SupportShape<Scalar>& b, const Pose& pose_b)
    : unit_(unit),
      a_(a, pose_a.rotation, unit_),
      b_(b, pose_b.rotation, unit_),
      centre_b_((offset.vector * (1 / unit_)).template cast<Scalar>()),
      pose_a_(&pose_a),
      is_polytope_(a.is_polytope() && b.is_polytope()),
      is_smooth_(!is_polytope_ && a.is_smooth() && b.is_smooth()) {}

template bool balls_are_apart(const CentreOffset&, const SupportShape<float>&, const Pose&,
                              const SupportShape<float>&, const Pose&);
template bool balls_are_apart(const CentreOffset&, const SupportShape<double>&, const Pose&,
                              const SupportShape<double>&, const Pose&);
template bool balls_are_apart_by(double, const CentreOffset&, const SupportShape<float>&,
                                 const Pose&, const SupportShape<float>&, const Pose&);
template bool balls_are_apart_by(double, const CentreOffset&, const SupportShape<double>&,
                                 const Pose&, const SupportShape<double>&, const Pose&);
template class SupportPair<float>;
template class SupportPair<double>;
template CentreOffset centre_offset(const SupportShape<float>&, const Pose&,
                                    const SupportShape<float>&, const Pose&);
template CentreOffset centre_offset(const SupportShape<double>&, const Pose&,
                                    const SupportShape<double>&, const Pose&);

}  // namespace touchstone
