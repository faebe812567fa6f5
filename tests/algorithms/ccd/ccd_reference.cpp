// The references.
#include "tests/algorithms/ccd/ccd_reference.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace touchstone::reference {
namespace {

template <class Real>
using Point = std::array<Real, 3>;

template <class Real>
Real product(const Point<Real>& u, const Point<Real>& v) {
  return Real(u[0] * v[0] + u[1] * v[1] + u[2] * v[2]);
}
template <class Real>
Point<Real> minus(const Point<Real>& u, const Point<Real>& v) {
  return {Real(u[0] - v[0]), Real(u[1] - v[1]), Real(u[2] - v[2])};
}
template <class Real>
Point<Real> normal_of(const Point<Real>& u, const Point<Real>& v) {
  return {Real(u[1] * v[2] - u[2] * v[1]), Real(u[2] * v[0] - u[0] * v[2]),
          Real(u[0] * v[1] - u[1] * v[0])};
}

template <class Real>
Real square_to_segment(const Point<Real>& p, const Point<Real>& a, const Point<Real>& b,
                       const Real& tiny) {
  const Point<Real> edge = minus(b, a), from = minus(p, a);
  const Real length = product(edge, edge);
  Real s = 0;
  if (length > tiny) s = product(edge, from) / length;
  if (s < 0) s = 0;
  if (s > 1) s = 1;
  Point<Real> rest;
  for (std::size_t i = 0; i < 3; ++i) rest[i] = from[i] - s * edge[i];
  return product(rest, rest);
}

// Squared distances; what is below `tiny` counts as a degenerate edge or face.
template <class Real>
Real square_distance(FeaturePair pair, const std::array<Point<Real>, 4>& x, const Real& tiny) {
  Real best;
  const auto take = [&](const Real& square) {
    if (square < best) best = square;
  };
  if (pair == FeaturePair::vertex_face) {
    best = square_to_segment(x[0], x[1], x[2], tiny);
    take(square_to_segment(x[0], x[2], x[3], tiny));
    take(square_to_segment(x[0], x[3], x[1], tiny));
    const Point<Real> normal = normal_of(minus(x[2], x[1]), minus(x[3], x[1]));
    const Real square = product(normal, normal);
    if (square > tiny) {
      bool inside = true;
      for (std::size_t i = 1; i < 4; ++i) {
        const Point<Real>& a = x[i];
        const Point<Real>& b = x[i % 3 + 1];
        inside = inside && product(normal_of(minus(b, a), minus(x[0], a)), normal) >= 0;
      }
      const Real height = product(normal, minus(x[0], x[1]));
      if (inside) take(Real(height * height / square));
    }
    return best;
  }
  best = square_to_segment(x[0], x[2], x[3], tiny);
  take(square_to_segment(x[1], x[2], x[3], tiny));
  take(square_to_segment(x[2], x[0], x[1], tiny));
  take(square_to_segment(x[3], x[0], x[1], tiny));
  const Point<Real> u = minus(x[1], x[0]), v = minus(x[3], x[2]), w = minus(x[2], x[0]);
  const Point<Real> normal = normal_of(u, v);
  const Real square = product(normal, normal);
  if (square > tiny) {
    const Real s = product(normal_of(w, v), normal) / square;
    const Real t = product(normal_of(w, u), normal) / square;
    const Real height = product(normal, w);
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) take(Real(height * height / square));
  }
  return best;
}

template <class Real>
std::array<Point<Real>, 4> placed(const CcdQuery& query, const Real& time) {
  std::array<Point<Real>, 4> x;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const Real start = query.start[i][axis], end = query.end[i][axis];
      x[i][k] = (1 - time) * start + time * end;
    }
  }
  return x;
}

using Float = mpf_class;
constexpr unsigned bits = 640;

Float number(double x) { return {x, bits}; }
Float threshold() {
  Float small = number(1);
  mpf_div_2exp(small.get_mpf_t(), small.get_mpf_t(), 220);
  return small;
}

using Coefficients = std::array<Float, 4>;  // of 1, t, t^2, t^3

Float value(const Coefficients& p, const Float& t) {
  return Float(((p[3] * t + p[2]) * t + p[1]) * t + p[0]);
}

// From the values at -1, 0, 1 and 2, which are exact.
Coefficients interpolated(const std::array<Float, 4>& y) {
  Coefficients p;
  p[0] = y[1];
  p[2] = (y[0] + y[2]) / 2 - y[1];
  p[3] = (y[3] - 3 * y[2] + 3 * y[1] - y[0]) / 6;
  p[1] = y[2] - p[0] - p[2] - p[3];
  return p;
}

// The roots in [0, 1]: between the roots of the slope the polynomial is monotone.
std::vector<Float> roots_in_unit(const Coefficients& p) {
  std::vector<Float> cuts = {number(0)};
  const Float a = 3 * p[3], b = 2 * p[2], c = p[1];
  std::vector<Float> bends;
  if (abs(a) > threshold()) {
    const Float square = b * b - 4 * a * c;
    if (square >= -threshold()) {
      const Float root = sqrt(Float(square < 0 ? number(0) : square));
      bends = {Float((-b - root) / (2 * a)), Float((-b + root) / (2 * a))};
    }
  } else if (abs(b) > threshold()) {
    bends = {Float(-c / b)};
  }
  std::sort(bends.begin(), bends.end());
  for (const Float& bend : bends) {
    if (bend > 0 && bend < 1) cuts.push_back(bend);
  }
  cuts.push_back(number(1));
  std::vector<Float> roots;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (abs(value(p, cuts[i])) < threshold()) {
      roots.push_back(cuts[i]);
      continue;
    }
    if (i + 1 == cuts.size() || abs(value(p, cuts[i + 1])) < threshold()) continue;
    Float low = cuts[i], high = cuts[i + 1];
    if (sgn(value(p, low)) * sgn(value(p, high)) > 0) continue;
    for (int k = 0; k < 500; ++k) {
      const Float middle = (low + high) / 2;
      (sgn(value(p, middle)) == sgn(value(p, low)) ? low : high) = middle;
    }
    roots.push_back(low);
  }
  return roots;
}

}  // namespace

std::optional<double> first_contact_of_small(FeaturePair pair, const CcdQuery& query) {
  mpf_set_default_prec(bits);
  const auto polynomial = [&](const auto& function) {
    std::array<Float, 4> values;
    for (std::size_t i = 0; i < 4; ++i) {
      values[i] = function(placed<Float>(query, number(static_cast<double>(i) - 1)));
    }
    return interpolated(values);
  };
  const auto is_zero = [](const Coefficients& p) {
    return std::all_of(p.begin(), p.end(), [](const Float& c) { return abs(c) < threshold(); });
  };
  const Coefficients volume = polynomial([](const std::array<Point<Float>, 4>& x) {
    return product(minus(x[3], x[0]), normal_of(minus(x[1], x[0]), minus(x[2], x[0])));
  });
  std::vector<Float> times;
  if (is_zero(volume)) {
    // In one plane, contact begins where three vertices are on a line, or two in one place.
    times.push_back(number(0));
    const auto add = [&](const Coefficients& p) {
      if (is_zero(p)) return;
      for (const Float& root : roots_in_unit(p)) times.push_back(root);
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          add(polynomial([&](const auto& x) { return Float(x[i][axis] - x[j][axis]); }));
          for (std::size_t k = 0; k < j; ++k) {
            add(polynomial([&](const auto& x) {
              return normal_of(minus(x[i], x[k]), minus(x[j], x[k]))[axis];
            }));
          }
        }
      }
    }
    std::sort(times.begin(), times.end());
  } else {
    times = roots_in_unit(volume);
  }
  for (const Float& time : times) {
    if (square_distance<Float>(pair, placed<Float>(query, time), threshold()) < threshold()) {
      return time.get_d();
    }
  }
  return {};
}

double distance_at(FeaturePair pair, const CcdQuery& query, double time) {
  using Real = long double;
  return static_cast<double>(
      std::sqrt(square_distance<Real>(pair, placed<Real>(query, time), Real(0))));
}

}  // namespace touchstone::reference
