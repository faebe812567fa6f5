// Poses of a moving pair, and how far rounding moves them.
#include "algorithms/kernels/motion/relative_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/motion/length.h"

namespace touchstone {
namespace {

constexpr double beyond_rounding = 1 + 1e-12;

double reach_of(const MovingBody& body) {
  const SupportShape<double>& shape = *body.shape;
  const double centre = shape.is_centred ? 0 : shape.centre.stableNorm();
  return (centre + shape.size) * body.stretch.most * beyond_rounding;
}

double extent_of(const MovingBody& body) {
  return body.shape->size * body.stretch.most * beyond_rounding + body.shape->radius;
}

// A bound on the length of a vector, within a factor of two.
double length_bound(const Vec3d& v) { return v.cwiseAbs().sum(); }

double turning_rounding(double angle, double reach) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return angle > 0 ? (4 * angle + 30) * epsilon * reach : 0;
}

// Each column's cross product with a vector.
Mat3d cross_columns(const Vec3d& v, const Mat3d& matrix) {
  Mat3d across;
  for (int k = 0; k < 3; ++k) across.col(k) = v.cross(matrix.col(k));
  return across;
}

struct SineAndVersine {
  double sine, versine;  // versine: 1 - cos, without cancellation
};

SineAndVersine sine_and_versine(double angle) {
  const double sine = std::sin(angle / 2), cosine = std::cos(angle / 2);
  return {2 * sine * cosine, 2 * sine * sine};
}

}  // namespace

Mat3d rotation_by(const Vec3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (!(angle > 0)) return Mat3d::Identity();
  const Vec3d axis = rotation_vector / angle;
  const Mat3d across = cross_columns(axis, Mat3d::Identity());
  const auto [sine, versine] = sine_and_versine(angle);
  return Mat3d::Identity() + sine * across + versine * cross_columns(axis, across);
}

TurningPose::TurningPose(const MovingBody& body, double angle)
    : start_(body.pose->rotation), angle_(angle) {
  if (!(angle_ > 0)) return;
  const Vec3d axis = body.motion->rotation_vector / angle_;
  across_ = cross_columns(axis, start_);
  twice_across_ = cross_columns(axis, across_);
}

Mat3d TurningPose::at(double time) const {
  if (!(angle_ > 0)) return start_;
  const auto [sine, versine] = sine_and_versine(time * angle_);
  return start_ + sine * across_ + versine * twice_across_;
}

MotionBounds::MotionBounds(const MovingBody& a, const MovingBody& b)
    : a_(a),
      b_(b),
      offset_(b.pose->translation - a.pose->translation),
      displacement_(b.motion->displacement - a.motion->displacement),
      speed_(length_of(displacement_)),
      angle_a_(a.motion->rotation_vector.norm()),
      angle_b_(b.motion->rotation_vector.norm()) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  reach_a_ = reach_of(a);
  reach_b_ = reach_of(b);
  extent_ = std::max(extent_of(a), extent_of(b));
  placement_rounding_ = 8 * epsilon * (length_bound(offset_) + length_bound(displacement_)) +
                        turning_rounding(angle_a_, reach_a_) + turning_rounding(angle_b_, reach_b_);
}

Vec3d RelativeMotion::centre_a(double time) const {
  return a().shape->is_centred ? Vec3d(Vec3d::Zero()) : turning_a_.at(time) * a().shape->centre;
}
Vec3d RelativeMotion::centre_b(double time) const {
  return b().shape->is_centred ? Vec3d(Vec3d::Zero()) : turning_b_.at(time) * b().shape->centre;
}

SupportPair<double> RelativeMotion::at(double time) const {
  const Pose pose_a = {turning_a_.at(time), Vec3d::Zero()};
  const Pose pose_b = {turning_b_.at(time), offset(time)};
  const CentreOffset centres = centre_offset(*a().shape, pose_a, *b().shape, pose_b);
  const double unit = power_of_two_above(
      std::max({centres.vector.cwiseAbs().maxCoeff(), 0x1p54 * centres.doubt, extent()}));
  return {centres, unit, *a().shape, pose_a, *b().shape, pose_b};
}

}  // namespace touchstone
