// Bullet's Minkowski portal refinement.
// Paper:   none; Bullet 3.24, btMprPenetration.h: G. Snethen, Game Programming Gems 7, by way of
//          libccd.
// Departs: bullet_bodies.h states how bodies and poses are converted. The boolean stops after the
//          refined portal. The cap on iterations is ours, since Bullet's search for a portal has
//          none.
// Fails:   all thresholds are absolute, 1e-6 and a float's epsilon in either build. The depth is
//          along the portal, an upper bound. The witness points are a point of the overlap and that
//          point moved by the depth, so they are not on the surfaces.
// Cost:    support calls linear in the vertices.
#include "algorithms/narrow_phase.h"
#include "algorithms/peers/bullet_double/bullet_double.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/NarrowPhaseCollision/btMprPenetration.h>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

class Mpr {
 public:
  explicit Mpr(const NarrowPhaseSettings& settings)
      : cap_(settings.max_iterations.value_or(default_cap)) {}
  static void prepare(Body&) {}

  void answer(Query& query, Outcome& outcome) {
    int calls = 0;
    const View view_a{*query.a.shape, query.input.m_transformA, calls, cap_};
    const View view_b{*query.b.shape, query.input.m_transformB, calls, cap_};
    const btMprCollisionDescription description;
    btMprDistanceInfo found{};
    bool hit = false;
    outcome.status = Status::not_reported;
    try {
      if (query.task == Task::intersect) {
        btMprSimplex_t portal;
        const int portal_found = btDiscoverPortal(view_a, view_b, description, &portal);
        hit = portal_found > 0 ||
              (portal_found == 0 && btRefinePortal(view_a, view_b, description, &portal) == 0);
      } else {
        hit = btComputeMprPenetration(view_a, view_b, description, &found) == 0;
      }
      outcome.answer = hit ? Answer::overlapping : Answer::separated;
    } catch (const TooMany&) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::not_converged;
      clear_numbers(outcome);
    }
    outcome.support_calls = calls;
    outcome.iterations = calls / 2;
    if (hit && query.task == Task::penetration) {
      report({found.m_normalBtoA, found.m_pointOnB, found.m_distance}, query, outcome);
    }
  }

 private:
  // Bullet's search for a portal has no cap, so the support function has one: every step of every
  // loop calls it for both bodies. Bullet's refinement has 1000 steps, and so has its search for
  // the depth.
  struct TooMany {};
  static constexpr int default_cap = 3000;

  struct View {
    const btConvexShape& shape;
    const btTransform& transform;
    int& calls;
    int cap;

    const btTransform& getWorldTransform() const { return transform; }
    const btVector3& getObjectCenterInWorld() const { return transform.getOrigin(); }
    btVector3 getLocalSupportWithMargin(const btVector3& direction) const {
      if (++calls > 2 * cap) throw TooMany{};
      return shape.localGetSupportVertexNonVirtual(direction);
    }
  };

  int cap_;
};

std::unique_ptr<NarrowPhase> make_mpr(const NarrowPhaseSettings& settings) {
  return make<Mpr>("bullet-mpr", settings);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_bullet_mpr() {
  return {
      {.info =
           {.name = "bullet-mpr",
            .citation = "Bullet 3.24, btComputeMprPenetration",
            .origin = Origin::peer,
            .known_defect =
                "depth along the portal, an upper bound; witness points are not on the surfaces",
            .lacking = bullet::lacking()},
       .tasks = {Task::intersect, Task::penetration},
       .scalars = bullet::scalars(),
       .supports = [](ShapeKind, ShapeKind b, Task) { return b != ShapeKind::halfspace; },
       .traits = {.depth_is_bound = true},
       .encoding = bullet::encoding,
       .make = bullet::make_mpr}};
}

}  // namespace touchstone::entries
