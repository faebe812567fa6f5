// The least enclosing ball, by exchange of supporting points.
#include "harness/geometry/enclosing_ball.h"

#include <Eigen/LU>
#include <bit>
#include <optional>

namespace touchstone::geometry {
namespace {

// The least ball with all of the points on its surface; empty if they are affinely dependent.
std::optional<Ball> ball_through(const std::vector<Vec3d>& p) {
  const auto n = static_cast<Eigen::Index>(p.size()) - 1;
  if (n == 0) return Ball{p[0], 0};
  Eigen::MatrixXd edges(3, n);
  for (Eigen::Index i = 0; i < n; ++i) edges.col(i) = p[static_cast<std::size_t>(i) + 1] - p[0];
  const Eigen::MatrixXd gram = edges.transpose() * edges;
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::VectorXd weights = lu.solve(Eigen::VectorXd(0.5 * gram.diagonal()));
  const Vec3d to_centre = edges * weights;
  return Ball{p[0] + to_centre, to_centre.norm()};
}

// The least ball around at most five points. `needed` receives the points on its surface.
Ball least_ball_of_few(const std::vector<Vec3d>& p, std::vector<Vec3d>& needed) {
  std::optional<Ball> best;
  for (unsigned set = 1; set < 1u << p.size(); ++set) {
    if (std::popcount(set) > 4) continue;
    std::vector<Vec3d> chosen;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (set >> i & 1) chosen.push_back(p[i]);
    }
    const std::optional<Ball> ball = ball_through(chosen);
    if (!ball || (best && ball->radius >= best->radius)) continue;
    bool holds = true;
    for (const Vec3d& q : p)
      holds = holds && (q - ball->centre).norm() <= ball->radius * (1 + 1e-12);
    if (!holds) continue;
    best = ball;
    needed = chosen;
  }
  return best.value_or(Ball{p[0], 0});
}

}  // namespace

Ball least_ball(std::span<const Vec3d> points) {
  std::vector<Vec3d> support = {points.front()};
  Ball ball{points.front(), 0};
  for (;;) {
    const Vec3d* farthest = &points.front();
    for (const Vec3d& p : points) {
      if ((p - ball.centre).squaredNorm() > (*farthest - ball.centre).squaredNorm()) farthest = &p;
    }
    const double far = (*farthest - ball.centre).norm();
    if (!(far > ball.radius * (1 + 1e-14))) return ball;
    std::vector<Vec3d> few = support, needed;
    few.push_back(*farthest);
    const Ball next = least_ball_of_few(few, needed);
    if (!(next.radius > ball.radius)) return ball;  // rounding permits no better
    ball = next;
    support = needed;
  }
}

}  // namespace touchstone::geometry
