// The exact test of a line and a triangle.
//
// Steps: 1. With the vertices seen from the ray's origin, the volumes of the direction with each
//           edge are the weights of the vertices at the point where the line meets the plane: it is
//           in the triangle if no two of them differ in sign.
//        2. If their sum is zero, the line lies in the triangle's plane, beside it, or the triangle
//           has no area. What it has in common with the triangle then begins and ends on edges.
#include "algorithms/kernels/rays/exact_ray.h"

namespace touchstone {
namespace {

// What the line has in common with the triangle: from `first` to `last`.
struct Stretch {
  std::optional<ExactHit> first, last;

  void add(const ExactHit& end) {
    if (!first || end.t.compare(first->t) < 0) first = end;
    if (!last || end.t.compare(last->t) > 0) last = end;
  }
};

ExactFraction fraction(const FloatExpansion& top, const FloatExpansion& bottom) {
  return bottom.sign() < 0 ? ExactFraction{-top, -bottom} : ExactFraction{top, bottom};
}

int first_axis(const Expansion3& v) {
  for (int k = 0; k < 3; ++k) {
    if (v[static_cast<std::size_t>(k)].sign() != 0) return k;
  }
  return -1;
}

// An edge of the triangle, and the weights (u, v) of its ends.
struct Edge {
  const Expansion3 &p, &q;
  std::array<double, 2> at_p, at_q;

  // The end of a stretch at the part s of the way from p to q.
  ExactHit end(const ExactFraction& t, double s) const {
    return {t, at_p[0] + s * (at_q[0] - at_p[0]), at_p[1] + s * (at_q[1] - at_p[1])};
  }
};

// Adds the line's points on the edge, whose plane with the line's origin has the line in it if
// `volume`, of the direction and the edge's ends, is zero.
void add_edge(const Edge& edge, const FloatExpansion& volume, const Expansion3& direction,
              Stretch& stretch) {
  if (volume.sign() != 0) return;
  const Expansion3 &p = edge.p, &q = edge.q;
  const Expansion3 beside_p = cross(p, direction), beside_q = cross(q, direction);
  const auto k = static_cast<std::size_t>(first_axis(direction));
  const int axis_p = first_axis(beside_p), axis_q = first_axis(beside_q);
  if (axis_p < 0) stretch.add(edge.end(fraction(p[k], direction[k]), 0));
  if (axis_q < 0) stretch.add(edge.end(fraction(q[k], direction[k]), 1));
  if (axis_p < 0 || axis_q < 0) return;
  // The vectors are parallel. The line is between p and q if they point to different sides.
  const auto i = static_cast<std::size_t>(axis_p);
  if (beside_p[i].sign() == beside_q[i].sign()) return;
  const FloatExpansion sum = beside_p[i] - beside_q[i];
  stretch.add(edge.end(fraction(beside_p[i] * q[k] - beside_q[i] * p[k], direction[k] * sum),
                       beside_p[i].value() / sum.value()));
}

// The first point of the stretch at t >= 0.
std::optional<ExactHit> first_of(const Stretch& stretch) {
  if (!stretch.last || stretch.last->t.top.sign() < 0) return {};
  const ExactHit &first = *stretch.first, &last = *stretch.last;
  if (first.t.top.sign() >= 0) return first;
  const double before = -first.t.value(), behind = last.t.value();
  const double part = before / (before + behind);
  return ExactHit{{}, first.u + part * (last.u - first.u), first.v + part * (last.v - first.v)};
}

}  // namespace

bool is_safe(const RayTriangle& pair, double t_max) {
  for (const Vec3d* v : {&pair.origin, &pair.direction, &pair.a, &pair.b, &pair.c}) {
    for (const double x : *v) {
      if (!is_safe(x)) return false;
    }
  }
  return is_safe(t_max) || t_max > 0x1p120;
}

std::optional<ExactHit> first_hit(const RayTriangle& pair) {
  const Expansion3 a = exact_difference(pair.a, pair.origin);
  const Expansion3 b = exact_difference(pair.b, pair.origin);
  const Expansion3 c = exact_difference(pair.c, pair.origin);
  const Expansion3 direction = exact_vector(pair.direction);
  const Expansion3 bc = cross(b, c);
  const FloatExpansion at_a = dot(direction, bc);
  const FloatExpansion at_b = dot(direction, cross(c, a));
  const FloatExpansion at_c = dot(direction, cross(a, b));
  const FloatExpansion sum = at_a + at_b + at_c;
  if (sum.sign() != 0) {
    for (const FloatExpansion* weight : {&at_a, &at_b, &at_c}) {
      if (weight->sign() == -sum.sign()) return {};
    }
    const ExactFraction t = fraction(dot(a, bc), sum);
    if (t.top.sign() < 0) return {};
    return ExactHit{t, at_b.value() / sum.value(), at_c.value() / sum.value()};
  }
  Stretch stretch;
  constexpr std::array<double, 2> of_a = {0, 0}, of_b = {1, 0}, of_c = {0, 1};
  add_edge({a, b, of_a, of_b}, at_c, direction, stretch);
  add_edge({b, c, of_b, of_c}, at_a, direction, stretch);
  add_edge({c, a, of_c, of_a}, at_b, direction, stretch);
  return first_of(stretch);
}

}  // namespace touchstone
