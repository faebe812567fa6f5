// Poses of a moving pair, and how far rounding moves them.
#include "algorithms/kernels/motion/relative_motion.h"

#include <cmath>
#include <limits>

namespace touchstone {
namespace {

Mat3d rotation_at(const MovingBody& body, double time) {
  if (!body.motion->turns()) return body.pose->rotation;
  return rotation_by(time * body.motion->rotation_vector) * body.pose->rotation;
}

double reach_of(const MovingBody& body) {
  const double reach = body.shape->centre.stableNorm() + body.shape->size;
  return reach * stretch_of(body.pose->rotation) * (1 + 1e-12);
}

double turning_rounding(const MovingBody& body, double reach) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (!body.motion->turns()) return 0;
  return (4 * body.motion->rotation_vector.norm() + 30) * epsilon * reach;
}

}  // namespace

Mat3d rotation_by(const Vec3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (!(angle > 0)) return Mat3d::Identity();
  const Vec3d axis = rotation_vector / angle;
  const double sine = std::sin(angle);
  const double half = std::sin(angle / 2);
  const double versine = 2 * half * half;  // 1 - cos, without cancellation
  Mat3d across;
  across << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Mat3d::Identity() + sine * across + versine * (across * across);
}

double stretch_of(const Mat3d& matrix) {
  // The greatest eigenvalue of M^T M is at most its greatest row sum.
  const Mat3d square = matrix.transpose() * matrix;
  return std::sqrt(square.cwiseAbs().rowwise().sum().maxCoeff()) * (1 + 1e-12);
}

RelativeMotion::RelativeMotion(const MovingBody& a, const MovingBody& b)
    : a_(a),
      b_(b),
      offset_(b.pose->translation - a.pose->translation),
      displacement_(b.motion->displacement - a.motion->displacement),
      reach_a_(reach_of(a)),
      reach_b_(reach_of(b)) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  placement_rounding_ = 8 * epsilon * (offset_.stableNorm() + displacement_.stableNorm()) +
                        turning_rounding(a, reach_a_) + turning_rounding(b, reach_b_);
}

Vec3d RelativeMotion::centre_a(double time) const {
  return a_.shape->is_centred ? Vec3d(Vec3d::Zero()) : rotation_at(a_, time) * a_.shape->centre;
}
Vec3d RelativeMotion::centre_b(double time) const {
  return b_.shape->is_centred ? Vec3d(Vec3d::Zero()) : rotation_at(b_, time) * b_.shape->centre;
}

SupportPair<double> RelativeMotion::at(double time) const {
  const Pose pose_a = {rotation_at(a_, time), Vec3d::Zero()};
  const Pose pose_b = {rotation_at(b_, time), offset(time)};
  return {*a_.shape, pose_a, *b_.shape, pose_b};
}

}  // namespace touchstone
