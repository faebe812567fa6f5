// Bullet's box-box test: separating axes, then clipping of the faces against each other.
// Paper:   none; Bullet 3.24, btBoxBoxDetector: dBoxBox of R. Smith's ODE.
// Departs: bullet_bodies.h states how bodies and poses are converted.
// Fails:   the depth is that of the deepest contact. All thresholds are absolute lengths, up to
//          1e-5 in either build, so smaller gaps are reported as overlaps in double too.
// Cost:    O(1).
#include "algorithms/narrow_phase.h"
#include "algorithms/peers/bullet_double/bullet_double.h"
#ifdef TOUCHSTONE_HAS_BULLET
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

std::unique_ptr<NarrowPhase> make_box_box(const NarrowPhaseSettings& settings) {
  return make<BoxBox>("bullet-box-box", settings);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_bullet_box_box() {
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
           .encoding = bullet::encoding,
           .make = bullet::make_box_box}};
}

}  // namespace touchstone::entries
