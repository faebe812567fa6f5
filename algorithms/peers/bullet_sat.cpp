// Bullet's separating axis test of two polyhedra.
// Paper:   none; Bullet 3.24, btPolyhedralContactClipping, by P. Terdiman.
// Departs: bullet_bodies.h states how bodies and poses are converted. The depth is measured with
//          btConvexPolyhedron::project along the axis found, since findSeparatingAxis does not
//          return it.
// Fails:   works on vertices that Bullet's hull computer has snapped to a grid: errors of 3e-4 of
//          the size, in either build. All thresholds are absolute lengths. If faces meet squarely,
//          two of their edges may win by a rounding, and the witness point is then on those, off
//          the surfaces.
// Cost:    O(E^2 V).
#include "algorithms/narrow_phase.h"
#include "algorithms/peers/bullet_double/bullet_double.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/NarrowPhaseCollision/btPolyhedralContactClipping.h>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

struct PolyhedralSat {
  static void prepare(Body& body) { make_polyhedron(body); }

  void answer(Query& query, Outcome& outcome) {
    if (query.a.polyhedron == nullptr || query.b.polyhedron == nullptr) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::degenerate;
      clear_numbers(outcome);
      return;
    }
    const btConvexPolyhedron& hull_a = *query.a.polyhedron;
    const btConvexPolyhedron& hull_b = *query.b.polyhedron;
    const btTransform& at_a = query.input.m_transformA;
    const btTransform& at_b = query.input.m_transformB;
    outcome.status = Status::ok;
    Deepest deepest;  // holds the edges' contact from here on, or the faces' after clipping
    btVector3 axis;   // points from b to a
    if (!btPolyhedralContactClipping::findSeparatingAxis(hull_a, hull_b, at_a, at_b, axis,
                                                         deepest)) {
      outcome.answer = Answer::separated;
      return;
    }
    if (query.task == Task::intersect) {
      outcome.answer = Answer::overlapping;
      return;
    }
    axis.normalize();
    btScalar low_a, high_a, low_b, high_b;
    btVector3 lowest, highest, unused;
    hull_a.project(at_a, axis, low_a, high_a, lowest, unused);
    hull_b.project(at_b, axis, low_b, high_b, unused, highest);
    const btScalar depth = high_b - low_a;
    if (!deepest.contact) {
      const btScalar all = BT_LARGE_FLOAT;
      btPolyhedralContactClipping::clipHullAgainstHull(axis, hull_a, hull_b, at_a, at_b, -all, 0,
                                                       polygon_, clipped_, deepest);
    }
    const btVector3 point = deepest.contact ? deepest.contact->point_on_b : highest;
    report({axis, point, -depth}, query, outcome);
    if (outcome.answer == Answer::separated) {  // by rounding
      outcome.answer = Answer::touching;
      clear_numbers(outcome);
    }
  }

 private:
  btVertexArray polygon_, clipped_;
};

std::unique_ptr<NarrowPhase> make_sat(const NarrowPhaseSettings& settings) {
  return make<PolyhedralSat>("bullet-sat", settings);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_bullet_sat() {
  return {{.info = {.name = "bullet-sat",
                    .citation = "Bullet 3.24, btPolyhedralContactClipping::findSeparatingAxis",
                    .origin = Origin::peer,
                    .lacking = bullet::lacking()},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = bullet::scalars(),
           .supports =
               [](ShapeKind a, ShapeKind b, Task) {
                 const auto flat_sided = [](ShapeKind k) {
                   return k == ShapeKind::box || k == ShapeKind::hull;
                 };
                 return flat_sided(a) && flat_sided(b);
               },
           .encoding = bullet::encoding,
           .make = bullet::make_sat}};
}

}  // namespace touchstone::entries
