// Writes an outcome from the oracle's measure, with witness points from its certificate.
#include "algorithms/oracle/answer.h"

#include <algorithm>
#include <array>
#include <limits>

#include "algorithms/oracle/certificates/certificate.h"

namespace touchstone::oracle {
namespace {

// Two points of the cores, in the world, whose difference is one point of the difference.
struct Witnesses {
  Vec3d a = Vec3d::Zero(), b = Vec3d::Zero();

  Vec3d difference() const { return a - b; }
};

Vec3d in_world(const Generator& generator, const Body& body) {
  const Vec3d local = generator.vertex >= 0 ? body.solid->vertices[generator.vertex]
                                            : Vec3d(static_cast<double>(generator.point[0]),
                                                    static_cast<double>(generator.point[1]),
                                                    static_cast<double>(generator.point[2]));
  return body.matrix * local + body.translation;
}

Witnesses at(const Certificate& certificate, const DifferencePoint& point, const Body& a,
             const Body& b) {
  return {in_world(certificate.a[point.a], a), in_world(certificate.b[point.b], b)};
}

double ratio(const Integer& part, const Integer& whole) {
  const long drop = static_cast<long>(msb(whole)) - 900;
  if (drop <= 0) return part.convert_to<double>() / whole.convert_to<double>();
  return Integer(part >> drop).convert_to<double>() / Integer(whole >> drop).convert_to<double>();
}

// The witnesses at the point where the ray from the origin along the normal leaves the surface.
Witnesses pierced(const Certificate& certificate, const Body& a, const Body& b,
                  const Vec3d& normal) {
  Witnesses best;
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& triangle : certificate.surface.triangles) {
    std::array<Witnesses, 3> corners;
    for (int i = 0; i < 3; ++i) {
      corners[i] = at(certificate, certificate.surface.points[triangle[i]], a, b);
    }
    const Vec3d p = corners[0].difference(), q = corners[1].difference(),
                r = corners[2].difference();
    std::array<double, 3> weights = {normal.dot(q.cross(r)), normal.dot(r.cross(p)),
                                     normal.dot(p.cross(q))};
    const double sum = weights[0] + weights[1] + weights[2];
    if (!(sum > 0)) continue;
    // Weights in the triangle that is hit are not negative, except for rounding.
    const double inside = std::ranges::min(weights) / sum;
    if (!(inside > most)) continue;
    most = inside;
    best = {};
    for (int i = 0; i < 3; ++i) {
      best.a += weights[i] / sum * corners[i].a;
      best.b += weights[i] / sum * corners[i].b;
    }
  }
  return best;
}

Vec3d in_world_plane_point(const Body& body) {
  const Vec3d& n = body.solid->normal;
  return body.matrix * (body.solid->offset / n.squaredNorm() * n) + body.translation;
}

// If one body is a half-space: the other's nearest point, and its projection on the plane.
Witnesses on_plane(const Certificate& certificate, const Body& a, const Body& b,
                   const Vec3d& normal) {
  const bool plane_is_b = !certificate.a.empty();
  if (!plane_is_b && certificate.b.empty()) {
    return {Vec3d::Constant(Outcome::none), Vec3d::Constant(Outcome::none)};
  }
  const Body& plane = plane_is_b ? b : a;
  const Vec3d point = plane_is_b ? in_world(certificate.a[0], a) : in_world(certificate.b[0], b);
  const Vec3d outward = plane_is_b ? Vec3d(-normal) : normal;
  const Vec3d on = in_world_plane_point(plane);
  const Vec3d below = point - (point - on).dot(outward) * outward;
  return plane_is_b ? Witnesses{point, below} : Witnesses{below, point};
}

// The witnesses of the shortest connection, or of the shortest separating translation.
Witnesses witnesses(const Certificate& certificate, const Body& a, const Body& b,
                    const Vec3d& normal) {
  if (certificate.a.empty() || certificate.b.empty()) {
    return on_plane(certificate, a, b, normal);
  }
  if (!certificate.closest.empty()) {
    Witnesses sum;
    Integer whole = 0;
    for (const auto& term : certificate.closest) whole += term.weight;
    for (const auto& term : certificate.closest) {
      const Witnesses w = at(certificate, term.point, a, b);
      const double part = ratio(term.weight, whole);
      sum.a += part * w.a;
      sum.b += part * w.b;
    }
    return sum;
  }
  return pierced(certificate, a, b, normal);
}

void measure(Oracle& oracle, const Body& a, const Body& b, Task task, Outcome& outcome) {
  Certificate certificate;
  const Measure found = oracle.prove(a, b, certificate);
  outcome.answer = found.answer;
  if (!asks_for_number(task, found.answer)) return;
  outcome.distance = found.middle();
  outcome.lower = found.lower;
  outcome.upper = found.upper;
  outcome.normal = found.normal;
  const Witnesses nearest = witnesses(certificate, a, b, found.normal);
  outcome.witness_a = nearest.a + a.solid->radius * found.normal;
  outcome.witness_b = nearest.b - b.solid->radius * found.normal;
}

}  // namespace

void answer(Oracle& oracle, const Body& a, const Body& b, Task task, Outcome& outcome) {
  if (task == Task::intersect) {
    outcome.answer = oracle.verdict(a, b);
    outcome.lower = outcome.upper = Outcome::none;  // those of an earlier call say nothing here
  } else {
    measure(oracle, a, b, task, outcome);
  }
  outcome.status = outcome.answer == Answer::unknown ? Status::not_converged : Status::ok;
}

}  // namespace touchstone::oracle
