// The test of one triangle: in doubles, and exactly where they prove nothing.
//
// Steps: 1. See the vertices from the ray's origin, and shear them so that the ray is the third
//           axis. The areas of the origin with each edge are the vertices' weights.
//        2. If a bound on the rounding leaves their signs no doubt, they decide, and give t with a
//           bound of its own.
//        3. Otherwise, and where t is as near to 0, to t_max or to the best so far as its bound,
//           expansions decide.
#include "algorithms/kernels/rays/ray_query.h"
#include "algorithms/core/nearest_float.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

constexpr double unit = 0x1p-53;
constexpr double least_normal = std::numeric_limits<double>::min();

}  // namespace

bool is_proper(const Ray& ray) {
  return ray.origin.allFinite() && ray.direction.allFinite() && !ray.direction.isZero(0) &&
         !std::isnan(ray.t_max);
}

RayHit improper_hit() {
  RayHit hit;
  hit.status = Status::degenerate;
  return hit;
}

Ray rounded_to_float(const Ray& ray) {
  return {nearest_float(ray.origin), nearest_float(ray.direction), nearest_float(ray.t_max)};
}

RayQuery::RayQuery(const Ray& ray) : ray_(ray), t_end_(ray.t_max) {
  Eigen::Index greatest = 0;
  ray.direction.cwiseAbs().maxCoeff(&greatest);
  const int z = static_cast<int>(greatest);
  axes_ = {(z + 1) % 3, (z + 2) % 3, z};
  inverse_ = 1 / ray.direction[z];
  shear_x_ = ray.direction[axes_[0]] * inverse_;
  shear_y_ = ray.direction[axes_[1]] * inverse_;
}

bool RayQuery::offer(std::uint32_t triangle, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  if (!(ray_.t_max >= 0)) return false;
  std::array<double, 3> x, y, z;
  double reach = 0, side = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d seen = (k == 0 ? a : k == 1 ? b : c) - ray_.origin;
    z[k] = seen[axes_[2]];
    x[k] = seen[axes_[0]] - shear_x_ * z[k];
    y[k] = seen[axes_[1]] - shear_y_ * z[k];
    reach = std::max(reach, std::max({std::abs(seen[0]), std::abs(seen[1]), std::abs(seen[2])}));
    side = std::max(side, std::abs(x[k]) + std::abs(y[k]));
  }
  const std::array<double, 3> w = {x[2] * y[1] - y[2] * x[1], x[0] * y[2] - y[0] * x[2],
                                   x[1] * y[0] - y[1] * x[0]};
  // Of x and y: a rounding of the difference, four of shear times z (of the difference, of the
  // shear's two steps, of the product) and two of the sum, of numbers up to `reach` each, are 7
  // units. Each weight is two products of such numbers. 8 and 3 leave room for what these bounds
  // leave out: products of roundings, and the roundings of the bound itself.
  const double off = 8 * unit * reach;
  const double error = 2 * off * side + 2 * off * off + 3 * unit * side * side + 4 * least_normal;
  const double least = std::min({w[0], w[1], w[2]}), most = std::max({w[0], w[1], w[2]});
  if (least < -error && most > error) return false;
  Candidate candidate;
  candidate.triangle = triangle;
  candidate.a = a;
  candidate.b = b;
  candidate.c = c;
  const double sum = w[0] + w[1] + w[2];
  const double far = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
  const double spread = std::max({z[0], z[1], z[2]}) - std::min({z[0], z[1], z[2]});
  // The weights' errors move the mean of z by at most their part of its spread.
  const double t_error =
      1.01 * (3 * error * spread / std::abs(sum) + 16 * unit * far) * std::abs(inverse_);
  if (!(least > error || most < -error) || !(3 * error <= 0x1p-24 * std::abs(sum)) ||
      !(t_error <= 0x1p-40 * far * std::abs(inverse_) && t_error >= least_normal)) {
    return offer_exactly(candidate);
  }
  candidate.t = (w[0] * z[0] + w[1] * z[1] + w[2] * z[2]) / sum * inverse_;
  candidate.error = t_error;
  if (candidate.t + t_error < 0 || candidate.t - t_error > ray_.t_max) return false;
  if (candidate.t - t_error < 0 || candidate.t + t_error > ray_.t_max) {
    return offer_exactly(candidate);
  }
  candidate.u = w[1] / sum;
  candidate.v = w[2] / sum;
  if (is_before_best(candidate)) keep(candidate);
  return true;
}

RayTriangle RayQuery::pair_of(const Candidate& candidate) const {
  return {ray_.origin, ray_.direction, candidate.a, candidate.b, candidate.c};
}

bool RayQuery::offer_exactly(Candidate candidate) {
  const RayTriangle pair = pair_of(candidate);
  if (!is_safe(pair, ray_.t_max)) {
    undecided_ = true;
    return false;
  }
  const std::optional<ExactHit> hit = first_hit(pair);
  if (!hit || (ray_.t_max < 0x1p121 && hit->t.compare(ray_.t_max) > 0)) return false;
  candidate.exact = hit->t;
  candidate.t = hit->t.value();
  candidate.error = 8 * unit * candidate.t + least_normal;
  candidate.u = hit->u;
  candidate.v = hit->v;
  if (is_before_best(candidate)) keep(candidate);
  return true;
}

bool RayQuery::is_before_best(Candidate& candidate) {
  if (!is_hit()) return true;
  const double errors = candidate.error + best_.error;
  if (candidate.t + errors < best_.t * (1 - 2 * unit)) return true;
  if (candidate.t - errors > best_.t * (1 + 2 * unit)) return false;
  for (Candidate* c : {&candidate, &best_}) {
    if (c->exact) continue;
    if (!is_safe(pair_of(*c), ray_.t_max)) {
      undecided_ = true;
      return false;
    }
    c->exact = first_hit(pair_of(*c)).value_or(ExactHit{}).t;  // there is one: it was hit
  }
  const int order = candidate.exact->compare(*best_.exact);
  return order < 0 || (order == 0 && candidate.triangle < best_.triangle);
}

void RayQuery::keep(const Candidate& candidate) {
  best_ = candidate;
  t_end_ = std::min(ray_.t_max, (candidate.t + candidate.error) * (1 + 4 * unit) + least_normal);
}

RayHit RayQuery::hit() const {
  RayHit hit;
  hit.status = undecided_ ? Status::degenerate : Status::ok;
  if (!is_hit()) return hit;
  hit.hit = true;
  hit.triangle = best_.triangle;
  hit.t = std::clamp(best_.t, 0.0, std::max(ray_.t_max, 0.0));
  hit.u = best_.u;
  hit.v = best_.v;
  return hit;
}

}  // namespace touchstone
