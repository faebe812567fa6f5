// Exact: the oracle behind the narrow phase's contract, to be asked like any other algorithm.
// Paper:   see exact_gjk.h and expander.h; the answer is that of the exact problem in README.md
// here. Departs: distances are rounded once, at the end; tolerance and iteration cap have nothing
// to cut. Fails:   curved cores (cylinder, cone, ellipsoid) have an enclosure, about 1e-18 of the
// size wide
//          apart and 1e-12 deep; where zero is in it the answer is unknown, not_converged.
// Cost:    10 to 100 us a query for polytopes, up to some ms for curved cores; allocates.
#include <algorithm>
#include <limits>
#include <vector>

#include "algorithms/narrow_phase.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone {
namespace {

using oracle::Body;
using oracle::Certificate;

// The two points of the cores whose difference is one point of the difference, in the world.
struct Witnesses {
  Vec3d a = Vec3d::Zero(), b = Vec3d::Zero();

  Vec3d difference() const { return a - b; }
};

class Exact final : public NarrowPhase {
 public:
  void bind(std::span<const Shape> shapes) override {
    solids_.clear();
    solids_.reserve(shapes.size());
    for (const Shape& shape : shapes) solids_.emplace_back(shape);
  }

  void solve(const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const auto body = [&](std::uint32_t k) {
        return Body(solids_[batch.shape_of[k]], batch.poses[k]);
      };
      const Body a = body(batch.first[i]), b = body(batch.second[i]);
      Outcome& outcome = outcomes[i];
      if (batch.task == Task::intersect) {
        outcome.answer = oracle_.verdict(a, b);
      } else {
        measure(a, b, batch.task, outcome);
      }
      outcome.status = outcome.answer == Answer::unknown ? Status::not_converged : Status::ok;
    }
  }

 private:
  void measure(const Body& a, const Body& b, Task task, Outcome& outcome) {
    Certificate certificate;
    const oracle::Measure measure = oracle_.prove(a, b, certificate);
    outcome.answer = measure.answer;
    const bool asked = task == Task::distance ? measure.answer != Answer::overlapping
                                              : measure.answer != Answer::separated;
    if (!asked) return;
    outcome.distance = measure.middle();
    outcome.lower = measure.lower;
    outcome.upper = measure.upper;
    outcome.normal = measure.normal;
    const Witnesses nearest = witnesses(certificate, a, b, measure.normal);
    outcome.witness_a = nearest.a + a.solid->radius * measure.normal;
    outcome.witness_b = nearest.b - b.solid->radius * measure.normal;
  }

  static Vec3d in_world(const oracle::Generator& generator, const Body& body) {
    const Vec3d local = generator.vertex >= 0 ? body.solid->vertices[generator.vertex]
                                              : Vec3d(static_cast<double>(generator.point[0]),
                                                      static_cast<double>(generator.point[1]),
                                                      static_cast<double>(generator.point[2]));
    return body.matrix * local + body.translation;
  }

  static Witnesses at(const Certificate& certificate, const oracle::DifferencePoint& point,
                      const Body& a, const Body& b) {
    return {in_world(certificate.a[point.a], a), in_world(certificate.b[point.b], b)};
  }

  // Of the point of the difference that is the shortest connection, or translation, away.
  static Witnesses witnesses(const Certificate& certificate, const Body& a, const Body& b,
                             const Vec3d& normal) {
    if (certificate.a.empty() || certificate.b.empty()) {
      return on_plane(certificate, a, b, normal);
    }
    if (!certificate.closest.empty()) {
      Witnesses sum;
      oracle::Integer whole = 0;
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

  // Where the ray from the origin along the normal leaves the surface.
  static Witnesses pierced(const Certificate& certificate, const Body& a, const Body& b,
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
      // Not negative in the triangle that is hit, but for rounding.
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

  // One of the bodies is a half-space: the other's nearest point, and below it the plane's.
  static Witnesses on_plane(const Certificate& certificate, const Body& a, const Body& b,
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

  static Vec3d in_world_plane_point(const Body& body) {
    const Vec3d& n = body.solid->normal;
    return body.matrix * (body.solid->offset / n.squaredNorm() * n) + body.translation;
  }

  static double ratio(const oracle::Integer& part, const oracle::Integer& whole) {
    const long drop = static_cast<long>(msb(whole)) - 900;
    if (drop <= 0) return part.convert_to<double>() / whole.convert_to<double>();
    return oracle::Integer(part >> drop).convert_to<double>() /
           oracle::Integer(whole >> drop).convert_to<double>();
  }

  std::vector<oracle::Solid> solids_;
  oracle::Oracle oracle_;
};

}  // namespace
}  // namespace touchstone

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {{.info = {.name = "exact",
                    .citation = "Touchstone's oracle: GJK and EPA in integers, each answer with a "
                                "certificate",
                    .origin = Origin::oracle},
           .tasks = {Task::intersect, Task::distance, Task::penetration},
           .scalars = {Precision::float64},
           .make = [](const NarrowPhaseSettings&) { return std::make_unique<Exact>(); }}};
}
