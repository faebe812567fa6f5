// Exact signed distance between a half-space and a body, or between two half-spaces.
#include "algorithms/oracle/half_space.h"

#include <algorithm>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle {
namespace {

Vec3d unit(const IntegerVector& direction) {
  return make_direction(direction).rounded.normalized();
}

// Returns value * 2^exponent / (denominator * |normal|) as a signed root, in metres.
SignedRoot over_length(const Integer& value, long exponent, const Integer& denominator,
                       const IntegerVector& normal) {
  SignedRoot root;
  root.sign = value.sign();
  if (root.sign == 0) return root;
  root.numerator = value * value;
  root.denominator = denominator * denominator * dot(normal, normal);
  if (exponent >= 0) {
    root.numerator <<= 2 * exponent;
  } else {
    root.denominator <<= -2 * exponent;
  }
  return root;
}

// Brings x * 2^e and y * 2^f to one exponent and returns it.
long align(Integer& x, long e, Integer& y, long f) {
  const long least = std::min(e, f);
  x <<= e - least;
  y <<= f - least;
  return least;
}

// Measures from the half-space's plane to the nearest point of the body.
ExactMeasure above_plane(const Body& body, const Body& half_space, GridPair& pair,
                         const Filters& filters, Certificate* certificate) {
  const ExactHalfSpace plane = exact_half_space(half_space);
  ExactMeasure measure;
  if (is_zero(plane.normal)) {
    measure.core_lower = SignedRoot::infinity(-1);
    measure.core_upper = SignedRoot::infinity(1);
    return measure;
  }
  Shape shape;
  const Solid point(shape);  // a point at the half-space's origin
  Pose pose;
  pose.translation = half_space.translation;
  Body origin(point, pose);
  origin.sweep = half_space.sweep;
  pair.place(body, origin);
  pair.place_exactly();
  const Direction down = make_direction(-plane.normal);
  // The height of x over the plane is height(x) * 2^exponent / (pair's denominator * plane's *
  // |normal|).
  const auto height = [&](const Integer& along, int shift) {
    Integer value = along * plane.denominator;
    Integer offset = plane.offset * pair.denominator();
    const long exponent = align(value, pair.exponent() - shift, offset, plane.exponent);
    return over_length(value - offset, exponent, pair.denominator() * plane.denominator,
                       plane.normal);
  };
  const DifferencePoint nearest = pair.exact_support(down, filters.support);
  measure.core_upper = height(dot(plane.normal, pair.exact(nearest)), 0);
  measure.core_lower = measure.core_upper;
  if (pair.is_curved()) {
    const int shift = GridPair::root_shift;
    measure.core_lower = height(-pair.support_above(down, shift, filters.support), shift);
  }
  measure.normal = unit(down.exact);
  if (certificate != nullptr) {
    certificate->a = {pair.a.generator(nearest.a)};
    certificate->direction = down.exact;
    certificate->closest = {{{0, 0}, 1}};
  }
  return measure;
}

// Two half-spaces can be separated, or moved apart, only if their normals are opposite.
ExactMeasure between_planes(const Body& a, const Body& b, Certificate* certificate) {
  const ExactHalfSpace plane_a = exact_half_space(a), plane_b = exact_half_space(b);
  ExactMeasure measure;
  const Integer against = -dot(plane_a.normal, plane_b.normal);
  if (is_zero(plane_a.normal) || is_zero(plane_b.normal)) {
    measure.core_lower = SignedRoot::infinity(-1);
    measure.core_upper = SignedRoot::infinity(1);
    return measure;
  }
  if (certificate != nullptr) certificate->direction = plane_a.normal;
  if (against <= 0 || !is_zero(cross(plane_a.normal, plane_b.normal))) {
    measure.core_lower = measure.core_upper = SignedRoot::infinity(-1);
    return measure;
  }
  // normal_b = -against / square * normal_a. Times |normal_a|, with x relative to a, the gap is
  // normal_a . (t_b - t_a) - offset_b * square / against - offset_a.
  const Integer square = dot(plane_a.normal, plane_a.normal);
  long exponent = Dyadic::of_zero;
  const auto cover = [&](const Vec3d& v) {
    for (const double x : v) exponent = std::min<long>(exponent, dyadic(x).exponent);
  };
  // normal_a . (to - from), times 2^-exponent.
  const auto between = [&](const Vec3d& from, const Vec3d& to) {
    Integer sum = 0;
    for (int k = 0; k < 3; ++k) {
      const int e = static_cast<int>(exponent);
      sum += plane_a.normal[k] * (dyadic(to[k]).over_power(e) - dyadic(from[k]).over_power(e));
    }
    return sum;
  };
  cover(a.translation);
  cover(b.translation);
  for (const Body* body : {&a, &b}) {
    if (body->sweep) std::ranges::for_each(*body->sweep, cover);
  }
  if (exponent == Dyadic::of_zero) exponent = 0;
  Integer along = between(a.translation, b.translation);
  // What a sweep adds on the side of the other body.
  if (a.sweep) along -= std::max(Integer(0), between((*a.sweep)[1], (*a.sweep)[0]));
  if (b.sweep) along += std::min(Integer(0), between((*b.sweep)[1], (*b.sweep)[0]));
  along *= plane_a.denominator * plane_b.denominator * against;
  Integer offset_a = plane_a.offset * plane_b.denominator * against;
  Integer offset_b = plane_b.offset * plane_a.denominator * square;
  const long offsets = align(offset_a, plane_a.exponent, offset_b, plane_b.exponent);
  Integer offset = offset_a + offset_b;
  exponent = align(along, exponent, offset, offsets);
  measure.core_lower = measure.core_upper =
      over_length(along - offset, exponent, plane_a.denominator * plane_b.denominator * against,
                  plane_a.normal);
  measure.normal = unit(plane_a.normal);
  return measure;
}

}  // namespace

ExactHalfSpace exact_half_space(const Body& body) {
  const ExactMatrix matrix = exact_matrix(body);
  std::array<Dyadic, 3> parts;
  int least = Dyadic::of_zero;
  for (int k = 0; k < 3; ++k) {
    parts[k] = dyadic(body.solid->normal[k]);
    least = std::min(least, parts[k].exponent);
  }
  const auto& c = matrix.columns;
  const Integer determinant = dot(c[0], cross(c[1], c[2]));
  const Dyadic offset = dyadic(body.solid->offset);
  ExactHalfSpace plane;
  plane.normal = {0, 0, 0};
  if (determinant.is_zero()) return plane;
  // The plane is n . M^-1 y <= offset, times the determinant of M without its power of two.
  for (int k = 0; k < 3; ++k) {
    plane.normal =
        plane.normal + parts[k].over_power(least) * cross(c[(k + 1) % 3], c[(k + 2) % 3]);
  }
  if (determinant < 0) plane.normal = -plane.normal;
  plane.offset = offset.mantissa * abs(determinant);
  plane.exponent = offset.mantissa.is_zero() ? 0L : matrix.exponent + offset.exponent - least;
  plane.denominator = matrix.denominator;
  return plane;
}

ExactMeasure measure_half_space(const Body& a, const Body& b, GridPair& pair,
                                const Filters& filters, Certificate* certificate) {
  if (is_half_space(a) && is_half_space(b)) return between_planes(a, b, certificate);
  if (is_half_space(b)) return above_plane(a, b, pair, filters, certificate);
  ExactMeasure measure = above_plane(b, a, pair, filters, certificate);
  measure.normal = -measure.normal;
  if (certificate != nullptr) {
    certificate->b.swap(certificate->a);
    certificate->direction = -certificate->direction;
  }
  return measure;
}

}  // namespace touchstone::oracle
