// Derives the polynomial of a feature, and the signs that it has at the polynomial's root.
#include "algorithms/oracle/certificates/exact_time_check.h"

namespace touchstone::oracle {
namespace {

using oracle::cross;
using oracle::dot;

// start + t * rate.
struct Line {
  mpq_class start, rate;
};
struct LineVector {
  RationalVector start, rate;
};

Line dot(const RationalVector& u, const LineVector& v) {
  return {oracle::dot(u, v.start), oracle::dot(u, v.rate)};
}
LineVector cross(const LineVector& u, const RationalVector& v) {
  return {oracle::cross(u.start, v), oracle::cross(u.rate, v)};
}

// A polynomial of degree 2.
struct RationalQuadratic {
  std::array<mpq_class, 3> c;

  mpq_class at(const mpq_class& t) const { return c[0] + t * (c[1] + t * c[2]); }
};

RationalQuadratic square(const Line& x) {
  return {{x.start * x.start, 2 * x.start * x.rate, x.rate * x.rate}};
}
RationalQuadratic square(const LineVector& x) {
  return {{oracle::dot(x.start, x.start), 2 * oracle::dot(x.start, x.rate),
           oracle::dot(x.rate, x.rate)}};
}

// The only root in (lower, upper] of a polynomial.
class FirstRoot {
 public:
  FirstRoot(const RationalQuadratic& polynomial, const mpq_class& lower, const mpq_class& upper)
      : polynomial_(polynomial), lower_(lower), upper_(upper) {
    const mpq_class end = polynomial.at(upper);
    require(polynomial.at(lower) > 0 && end <= 0, "the polynomial has no root between the bounds");
    // If the upper bound is a root, it is the first of them.
    require(end < 0 || polynomial.c[1] + 2 * upper * polynomial.c[2] <= 0,
            "the polynomial has two roots between the bounds");
  }

  int sign(const Line& x) const {
    if (x.rate == 0) return sgn(x.start);
    const mpq_class zero = -x.start / x.rate;
    if (zero <= lower_) return sgn(x.rate);
    if (zero > upper_) return -sgn(x.rate);
    return sgn(polynomial_.at(zero)) * sgn(x.rate);
  }

 private:
  RationalQuadratic polynomial_;
  mpq_class lower_, upper_;
};

// What a feature says, at any time.
struct MovingFeature {
  RationalQuadratic polynomial;  // of the distance from 0, less the radius, times what is positive
  std::vector<Line> weights;     // of its points, times what is positive
  LineVector nearest;            // towards the nearest point, or against it if `side` is negative
  Line side = {1, 0};
};

MovingFeature feature_of(const std::vector<RationalVector>& points, const RationalMotion& motion) {
  std::vector<LineVector> at;
  for (const RationalVector& point : points) at.push_back({point, mpq_class(-1) * motion.velocity});
  const mpq_class radius = motion.radius * motion.radius;
  MovingFeature feature;
  if (points.size() == 1) {
    feature.polynomial = square(at[0]);
    feature.polynomial.c[0] -= radius;
    feature.nearest = at[0];
    return feature;
  }
  if (points.size() == 2) {
    const RationalVector edge = points[1] - points[0];
    const mpq_class whole = dot(edge, edge);
    require(whole > 0, "the feature is no edge");
    feature.polynomial = square(cross(at[0], edge));
    feature.polynomial.c[0] -= radius * whole;
    const Line along = dot(edge, at[0]);
    feature.weights = {{along.start + whole, along.rate}, {-along.start, -along.rate}};
    feature.nearest = {whole * at[0].start - along.start * edge,
                       whole * at[0].rate - along.rate * edge};
    return feature;
  }
  require(points.size() == 3, "a feature has one to three points");
  const RationalVector n = cross(points[1] - points[0], points[2] - points[0]);
  require(!is_zero(n), "the feature is no triangle");
  feature.side = dot(n, at[0]);
  feature.polynomial = square(feature.side);
  feature.polynomial.c[0] -= radius * dot(n, n);
  feature.nearest = {n, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalVector &q = points[(i + 1) % 3], &r = points[(i + 2) % 3];
    // The part of n . (q - t v) x (r - t v) that is linear; there is no other.
    feature.weights.push_back(
        {dot(n, cross(q, r)), dot(n, mpq_class(-1) * cross(q - r, motion.velocity))});
  }
  return feature;
}

}  // namespace

void require_exact_time(const CastCertificate& certificate, const RationalMotion& motion,
                        const Difference& difference) {
  require(motion.radius > 0, "bodies without a radius have a rational time");
  std::vector<RationalVector> points;
  for (const DifferencePoint& point : certificate.feature) points.push_back(difference(point));
  const MovingFeature feature = feature_of(points, motion);
  std::array<mpq_class, 3> claimed;
  for (int k = 0; k < 3; ++k) claimed[k] = rational(certificate.polynomial[k]);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    require(claimed[k] * feature.polynomial.c[next] == claimed[next] * feature.polynomial.c[k],
            "the polynomial is not that of the feature");
  }
  const FirstRoot root({claimed}, motion.lower, motion.upper);
  // The claimed polynomial may not be minus the feature's: both have one sign at the root's two sides.
  const FirstRoot same(feature.polynomial, motion.lower, motion.upper);
  for (const Line& weight : feature.weights) {
    require(root.sign(weight) >= 0, "the nearest point is not in the feature");
  }
  const int side = root.sign(feature.side);
  require(side != 0, "the bodies' cores touch at the feature");
  const mpq_class one = side;
  const auto in_front = [&](const RationalVector& x) {
    return root.sign(dot(one * x, feature.nearest));
  };
  const RationalVector point = points.front();
  for (const RationalVector& vertex : motion.a) {
    for (const RationalVector& other : motion.b) {
      require(in_front(vertex - other - point) >= 0,
              "a point of the difference is in front of the feature");
    }
  }
  require(in_front(motion.velocity) > 0, "the bodies do not close at the exact time");
}

}  // namespace touchstone::oracle
