// Bullet's box-box test: separating axes, then clipping of the faces against each other.
// Paper:   none; Bullet 3.24, btBoxBoxDetector: dBoxBox of R. Smith's ODE.
// Departs: bullet_bodies.h states how bodies and poses are converted.
// Fails:   the depth is that of the deepest contact. All thresholds are absolute lengths, up to
//          1e-5 in either build, so smaller gaps are reported as overlaps in double too.
// Cost:    O(1).
#include "algorithms/narrow_phase.h"
#include "algorithms/peers/bullet_double.h"
#if TOUCHSTONE_BUILT
#include <BulletCollision/CollisionDispatch/btBoxBoxDetector.h>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

struct BoxBox {
  static void prepare(Body&) {}

  static void answer(Query& query, Outcome& outcome) {
    btBoxBoxDetector detector(static_cast<const btBoxShape*>(query.a.shape.get()),
                              static_cast<const btBoxShape*>(query.b.shape.get()));
    Deepest deepest;
    detector.getClosestPoints(query.input, deepest, nullptr);
    if (deepest.contact) {
      outcome.status = Status::ok;
      report(*deepest.contact, query, outcome);
    } else {
      // The clipping may also have removed all contacts of an overlap.
      outcome.status = Status::not_reported;
      outcome.answer = Answer::separated;
    }
  }
};

}  // namespace
}  // namespace touchstone::bullet
#endif

TOUCHSTONE_NARROW_PHASE {
  using namespace touchstone;
  return {{.info = {.name = "bullet-box-box",
                    .citation = "Bullet 3.24, btBoxBoxDetector",
                    .origin = Origin::peer,
                    .known_defect =
                        "depth of the deepest contact point, which may be less than the boxes'",
                    .lacking = bullet::lacking()},
           .tasks = {Task::intersect, Task::penetration},
           .scalars = bullet::scalars(),
           .supports = [](ShapeKind a, ShapeKind b,
                          Task) { return a == ShapeKind::box && b == ShapeKind::box; },
           .encoding = TOUCHSTONE_IF_BUILT(touchstone::bullet::encoding),
           .make = TOUCHSTONE_IF_BUILT([](const NarrowPhaseSettings& settings) {
             return bullet::make<bullet::BoxBox>("bullet-box-box", settings);
           })}};
}
