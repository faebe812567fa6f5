// The least enclosing ball, by exchange of supporting points; Seidel's linear programme in few
// variables.
#include "harness/geometry/optimal_fits.h"

#include <Eigen/LU>

#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "harness/base/random.h"

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

namespace {

// The constraint a . x <= b.
template <std::size_t D>
struct Row {
  std::array<double, D> a{};
  double b = 0;
};

// Finds the point of {rows, |x| <= bound} that is greatest along c. Returns false if there is none.
// Rows have about unit length and must be in random order.
template <std::size_t D>
bool maximise(std::span<const Row<D>> rows, const std::array<double, D>& c, double bound,
              std::array<double, D>& x) {
  constexpr double tolerance = 1e-13;
  if constexpr (D == 1) {
    double low = -bound, high = bound;
    for (const Row<1>& r : rows) {
      if (r.a[0] > tolerance) {
        high = std::min(high, r.b / r.a[0]);
      } else if (r.a[0] < -tolerance) {
        low = std::max(low, r.b / r.a[0]);
      } else if (r.b < -tolerance * bound) {
        return false;
      }
    }
    if (low > high + tolerance * bound) return false;
    x[0] = c[0] >= 0 ? high : low;
    return true;
  } else {
    for (std::size_t k = 0; k < D; ++k) x[k] = c[k] >= 0 ? bound : -bound;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row<D>& tight = rows[i];
      double at = 0;
      std::size_t k = 0;
      for (std::size_t j = 0; j < D; ++j) {
        at += tight.a[j] * x[j];
        if (std::abs(tight.a[j]) > std::abs(tight.a[k])) k = j;
      }
      if (at <= tight.b + tolerance * bound) continue;
      if (!(std::abs(tight.a[k]) > tolerance)) return false;
      // The row's plane gives x[k] from the other coordinates.
      const auto without = [&](const std::array<double, D>& a, double b) {
        const double factor = a[k] / tight.a[k];
        Row<D - 1> row;
        for (std::size_t j = 0, m = 0; j < D; ++j) {
          if (j != k) row.a[m++] = a[j] - factor * tight.a[j];
        }
        row.b = b - factor * tight.b;
        return row;
      };
      std::vector<Row<D - 1>> lower;
      lower.reserve(i + 2);
      std::array<double, D> axis{};
      axis[k] = 1;
      lower.push_back(without(axis, bound));
      axis[k] = -1;
      lower.push_back(without(axis, bound));
      for (std::size_t j = 0; j < i; ++j) lower.push_back(without(rows[j].a, rows[j].b));
      const Row<D - 1> objective = without(c, 0);
      std::array<double, D - 1> y{};
      if (!maximise<D - 1>(lower, objective.a, bound, y)) return false;
      double rest = tight.b;
      for (std::size_t j = 0, m = 0; j < D; ++j) {
        if (j == k) continue;
        x[j] = y[m++];
        rest -= tight.a[j] * x[j];
      }
      x[k] = rest / tight.a[k];
    }
    return true;
  }
}

template <class T>
void shuffle(std::vector<T>& rows) {
  base::Random random(1);
  for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[random.below(i)]);
}

}  // namespace

Copy greatest_copy(std::span<const Plane> planes,
                   const std::function<double(const Vec3d&)>& support, const Vec3d& start,
                   double bound) {
  std::vector<Row<4>> rows;
  for (const Plane& p : planes) {
    rows.push_back({{p.normal.x(), p.normal.y(), p.normal.z(), support(p.normal)},
                    p.offset - p.normal.dot(start)});
  }
  shuffle(rows);
  std::array<double, 4> x{};
  if (!maximise<4>(rows, {0, 0, 0, 1}, bound, x)) return {start, -1};
  return {start + Vec3d(x[0], x[1], x[2]), x[3]};
}

double least_maximum(std::span<const Vec3d> a) {
  double greatest = 0;
  for (const Vec3d& v : a) greatest = std::max(greatest, v.cwiseAbs().sum());
  if (!(greatest > 0)) return 0;
  std::vector<Row<3>> rows = {{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{1, 1, 0}, 1}};
  for (const Vec3d& v : a) {
    rows.push_back({{v.x() / greatest, v.y() / greatest, -1}, -v.z() / greatest});
  }
  std::array<double, 3> x{};
  maximise<3>(rows, {0, 0, -1}, 4, x);
  return x[2] * greatest;
}

}  // namespace touchstone::geometry
