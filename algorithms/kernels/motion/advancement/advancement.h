// The loop of conservative advancement: time grows by steps in which the bodies provably stay apart.
// Used by conservative-advancement, rigid-advancement and bilateral-advancement, which differ in the step.
// Steps:   1. GJK, which starts at the last simplex, finds the plane that parts the bodies; for spheres and
//             capsules a closed form does (round_cores). If planes are to last, it is another for boxes (box_planes)
//             and for round bodies (round_planes).
//          2. If they are within the tolerance, it is a hit. Otherwise the features say how the plane turns
//             (turning_normal), for a step that lets it turn.
//          3. The step says until when that plane proves them apart; if until the end, it is a miss.
//          4. Go there, and repeat.
//          5. Prove contact a little later, for the upper end of the bracket (contact_by).
#pragma once

#include <optional>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/kernels/gjk/warm_start.h"
#include "algorithms/kernels/motion/advancement/contact_by.h"
#include "algorithms/kernels/motion/advancement/pair_motion.h"
#include "algorithms/kernels/motion/advancement/parting_step.h"
#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

struct AdvancementGoal {
  // Metres; without one, 1e-9 of the larger body's size. It is never less than what rounding hides.
  std::optional<double> tolerance;
  int most_steps = 0;
  // Whether planes are those that last, and turn with the features that they part, rather than those of the closest
  // points.
  bool lasting_planes = false;
};

// `Step`: FreeUntil operator()(SupportPair<double>& pair, const PartingPlane& plane), where the pair
// is at the plane's time. The pair is known to be free before the time at which it begins.
template <class Step>
void advance(const RelativeMotion& motion, const AdvancementGoal& goal, double begin, Step&& step,
             CastOutcome& outcome);

// --- the parts that do not depend on the step -----------------------------------------------------

// One look at the pair at a time.
struct Advancement {
  enum class State { apart, hit, open };
  State state = State::open;
  PartingPlane plane{};
};

// How long balls about the bodies' origins are proven to stay apart from time 0 on.
FreeUntil apart_by_balls(const MotionBounds& motion);

class AdvancementSearch {
 public:
  AdvancementSearch(const RelativeMotion& motion, const AdvancementGoal& goal);
  Advancement look(SupportPair<double>& pair, double time, CastOutcome& outcome);
  // Completes the outcome of a hit at the time of the last look.
  void finish(double time, CastOutcome& outcome) const;

 private:
  void prove_contact(double time, CastOutcome& outcome) const;
  // Nothing if GJK must tell.
  std::optional<Advancement> look_at_pair_of_boxes(SupportPair<double>& pair, double time);
  Advancement look_by_gjk(SupportPair<double>& pair, double time, int& iterations);
  // Notes a hit. Points are from their bodies' centres, in the pair's unit; the normal is zero if it is not
  // known.
  Advancement hit(const SupportPair<double>& pair, const NearestPoints& found, const Vec3d& normal);
  // Lets the plane turn if the bodies are near. From afar the way of their origins past it costs more than corners do.
  void let_turn(PartingPlane& plane, const Vec3d& turning) const;
  // `cores_apart` is the gap of the cores along the normal, in the pair's unit.
  Advancement apart(const SupportPair<double>& pair, double time, const Vec3d& normal,
                    double cores_apart);

  const RelativeMotion& motion_;
  PairMotion pair_motion_;
  std::optional<double> asked_tolerance_;
  double hidden_;     // what rounding hides, metres
  double tolerance_;  // metres
  bool lasting_planes_;
  WarmStart kept_;                // the last look's simplex
  Vec3d normal_ = Vec3d::Zero();  // the last plane's
  Vec3d point_ = Vec3d::Zero();
  NearestPoints nearest_{};
};

template <class Step>
void advance(const RelativeMotion& motion, const AdvancementGoal& goal, double begin, Step&& step,
             CastOutcome& outcome) {
  AdvancementSearch search(motion, goal);
  outcome.status = Status::not_converged;
  outcome.iterations = 0;
  double time = begin;
  outcome.lower = time;
  for (int k = 0; k < goal.most_steps; ++k) {
    SupportPair<double> pair = motion.at(time);
    const Advancement found = search.look(pair, time, outcome);
    if (found.state == Advancement::State::open) return;
    if (found.state == Advancement::State::hit) {
      outcome.answer = CastAnswer::hit;
      outcome.status = Status::ok;
      outcome.toi = time;
      search.finish(time, outcome);
      return;
    }
    const FreeUntil free = step(pair, found.plane);
    if (free.to_the_end) {
      outcome.answer = CastAnswer::miss;
      outcome.status = Status::ok;
      outcome.lower = CastOutcome::none;
      return;
    }
    if (!(free.time > time)) return;
    time = free.time < 1 ? free.time : 1;
    outcome.lower = time;
  }
}

}  // namespace touchstone
