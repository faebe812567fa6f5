// Tried are the normals of faces and the way between the centres, as short integers.
#include "algorithms/oracle/concave/group_plane.h"

#include <algorithm>
#include <cmath>

namespace touchstone::oracle {
namespace {

constexpr double finest = 0x1p20;           // of the integers of a direction
constexpr double share_of_rounding = 1e-9;  // of the sizes; a million times what rounding can be

double shadow(const Vec3d& n, const RoundedGroup& group) {
  return (n.transpose() * group.ways).cwiseAbs().sum();
}

// The direction as short integers, and nothing if it has none.
std::optional<Vec3d> shortened(const Vec3d& n) {
  const double greatest = n.lpNorm<Eigen::Infinity>();
  if (!(greatest > 0 && std::isfinite(greatest))) return {};
  const Vec3d whole = (n / greatest * finest).array().round();
  return whole;
}

}  // namespace

RoundedGroup::RoundedGroup(const RationalBox& box, const Pose& pose) {
  Vec3d middle, half;
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = box.low[k].get_d(), high = box.high[k].get_d();
    middle[static_cast<Eigen::Index>(k)] = low / 2 + high / 2;
    half[static_cast<Eigen::Index>(k)] = high / 2 - low / 2;
  }
  centre = pose(middle);
  ways = pose.rotation * half.asDiagonal();
  for (Eigen::Index k = 0; k < 3; ++k) {
    across.col(k) = pose.rotation.col((k + 1) % 3).cross(pose.rotation.col((k + 2) % 3));
  }
  const Vec3d most =
      pose.rotation.cwiseAbs() * (middle.cwiseAbs() + half) + Vec3d(pose.translation.cwiseAbs());
  size = most.maxCoeff();
}

RoundedGroup::RoundedGroup(const Vec3d& from, const Vec3d& to, const RoundedGroup& other)
    : centre(from / 2 + to / 2),
      ways(Mat3d::Zero()),
      size(std::max(from.lpNorm<Eigen::Infinity>(), to.lpNorm<Eigen::Infinity>())) {
  ways.col(0) = to / 2 - from / 2;
  for (Eigen::Index k = 0; k < 3; ++k) {
    across.col(k) = ways.col(0).normalized().cross(Vec3d(other.ways.col(k)).normalized());
  }
}

std::optional<IntegerVector> plane_between(const RoundedGroup& a, const RoundedGroup& b,
                                           double apart_by) {
  const Vec3d way = b.centre - a.centre;
  const double least = apart_by + share_of_rounding * (a.size + b.size + apart_by);
  std::optional<Vec3d> best;
  double widest = least;
  const auto attempt = [&](const Vec3d& along) {
    auto n = shortened(along.dot(way) < 0 ? Vec3d(-along) : along);
    if (!n) return;
    const double apart = (n->dot(way) - shadow(*n, a) - shadow(*n, b)) / n->norm();
    if (!(apart > widest && std::isfinite(apart))) return;
    widest = apart;
    best = n;
  };
  for (Eigen::Index k = 0; k < 3; ++k) {
    attempt(a.across.col(k));
    attempt(b.across.col(k));
  }
  attempt(way);
  if (!best) return {};
  IntegerVector direction;
  for (std::size_t k = 0; k < 3; ++k) {
    direction[k] = static_cast<long long>((*best)[static_cast<Eigen::Index>(k)]);
  }
  return direction;
}

}  // namespace touchstone::oracle
