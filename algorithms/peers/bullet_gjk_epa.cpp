// Bullet's GJK with EPA.
// Paper:   none; Bullet 3.24, btGjkPairDetector: GJK by G. van den Bergen, JGT 1999, and EPA by N.
//          Presson, btGjkEpa2.
// Departs: bullet_bodies.h states how bodies and poses are converted. Bullet has no boolean GJK:
//          intersect computes the distance with a cut-off at touch. The margin is that cut-off too.
// Fails:   all thresholds are absolute lengths, 1e-2 to 1e-6: overlapping bodies of millimetres are
//          reported as separated, and gaps of 1e-5 between larger ones as overlaps. In double the
//          thresholds are 1e-6 to 1e-14. In either build EPA returns its first tetrahedron if the
//          horizon degenerates.
// Cost:    support calls linear in the vertices.
#include "algorithms/narrow_phase.h"
#include "algorithms/peers/bullet_double/bullet_double.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <limits>
#include <optional>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

class GjkEpa {
 public:
  explicit GjkEpa(const NarrowPhaseSettings& settings) : margin_(settings.margin) {}
  static void prepare(Body&) {}

  void answer(Query& query, Outcome& outcome) {
    const btConvexShape* a = query.a.shape.get();
    const btConvexShape* b = query.b.shape.get();
    btGjkPairDetector detector(a, b, &simplex_, &epa_);
    const bool for_distance = asks_distance(query.task), has_cut_off = !for_distance || margin_;
    if (has_cut_off) {
      // Bullet compares this cut-off with the distance of the cores, without margins. Touching
      // bodies are kept.
      const btScalar reach =
          a->getMargin() + b->getMargin() + static_cast<btScalar>(for_distance ? *margin_ : 0);
      query.input.m_maximumDistanceSquared = reach * reach + std::numeric_limits<btScalar>::min();
    }
    Deepest deepest;
    detector.getClosestPoints(query.input, deepest, nullptr);
    outcome.iterations = detector.m_curIter;
    outcome.status = Status::not_reported;
    if (deepest.contact) {
      report(*deepest.contact, query, outcome);
    } else if (has_cut_off && found_distance(detector.m_lastUsedMethod)) {
      clear_numbers(outcome);
      outcome.answer = Answer::separated;  // beyond the cut-off
    } else {
      clear_numbers(outcome);
      // GJK reached its cap of 1000, or EPA found nothing although GJK reports an overlap.
      constexpr int cap = 1000;
      outcome.answer = Answer::unknown;
      outcome.status = detector.m_curIter > cap ? Status::not_converged : Status::degenerate;
    }
  }

 private:
  // Bullet's numbers of its methods: GJK's distance stands for 1, 5 and 8; EPA's own GJK's for 6.
  static bool found_distance(int method) {
    return method == 1 || method == 5 || method == 6 || method == 8;
  }

  std::optional<double> margin_;  // metres
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver epa_;
};

std::unique_ptr<NarrowPhase> make_gjk_epa(const NarrowPhaseSettings& settings) {
  return make<GjkEpa>("bullet-gjk-epa", settings);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> peers_bullet_gjk_epa() {
  return {
      {.info = {.name = "bullet-gjk-epa",
                .citation = "Bullet 3.24, btGjkPairDetector with btGjkEpaPenetrationDepthSolver",
                .origin = Origin::peer,
                .known_defect = "EPA stops at its first tetrahedron where flat faces meet "
                                "squarely: depth down to 58 %",
                .lacking = bullet::lacking()},
       .tasks = {all_tasks.begin(), all_tasks.end()},
       .scalars = bullet::scalars(),
       .supports = [](ShapeKind, ShapeKind b, Task) { return b != ShapeKind::halfspace; },
       .encoding = bullet::encoding,
       .make = bullet::make_gjk_epa}};
}

}  // namespace touchstone::entries
