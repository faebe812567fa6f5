// Part of certified: the guesses of GJK and EPA at contact, and what is proven of them.
#include "algorithms/narrow_phase/certified/polytope_contact.h"

#include <algorithm>

#include "algorithms/narrow_phase/certified/double_bounds.h"
#include "algorithms/narrow_phase/certified/enclosure.h"

namespace touchstone {
namespace {

using Pair = SupportPair<double>;

// Writes an exact verdict and bounds on the signed distance that did not know of it.
bool write_side(Answer answer, DistanceBounds gap, double widest, Task task, Outcome& outcome) {
  if (answer == Answer::unknown) return false;
  if (answer != Answer::overlapping) gap.lower = 0;
  if (answer != Answer::separated) gap.upper = 0;
  return write_answer(answer, gap, widest, task, outcome);
}

}  // namespace

bool PolytopeContact::decide_exactly(Pair& pair, const Simplex<double>& simplex,
                                     const Vec3d& direction, const PlacedPair& bodies, Task task,
                                     Outcome& outcome) {
  Vec3d normal = direction.stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) normal = pair.centre_b().stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) normal = Vec3d::UnitX();
  const ExactContact contact = finder_.find(bodies.a, bodies.b, {normal, simplex}, pair, task);
  if (contact.answer == Answer::unknown) return false;
  if (asks_for_number(task, contact.answer)) {
    outcome.normal = contact.normal;
    outcome.witness_a = contact.on_a;
    outcome.witness_b = contact.on_b;
  }
  return write_answer(contact.answer, {contact.lower, contact.upper}, bodies.widest(), task,
                      outcome);
}

bool PolytopeContact::encloses(Pair& pair, const Simplex<double>& simplex, Outcome& outcome) {
  const Expansion<double> depth =
      polytope_.expand(pair, simplex, {.tolerance = Pair::rounding, .enough = nearly});
  outcome.iterations += depth.iterations;
  return depth.has_surface && surely_encloses_origin(polytope_.surface()) &&
         write_verdict(Answer::overlapping, outcome);
}

bool PolytopeContact::find_depth(Pair& pair, const Simplex<double>& simplex,
                                 const PlacedPair& bodies, DistanceBounder& bounder, Task task,
                                 Outcome& outcome) {
  const double tolerance = std::max(Pair::rounding, tolerance_in_doubles(pair, bodies.widest()));
  const Expansion<double> depth = polytope_.expand(pair, simplex, {.tolerance = tolerance});
  outcome.iterations += depth.iterations;
  if (depth.upper <= nearly && decide_exactly(pair, {}, depth.normal, bodies, task, outcome)) {
    return true;
  }
  if (depth.end != ExpansionEnd::converged || !depth.has_surface) return false;
  outcome.normal = depth.normal;
  outcome.witness_a = pair.to_world(depth.a);
  outcome.witness_b = pair.to_world(depth.b);
  if (write_bounds(inside_in_doubles(pair, polytope_.surface(), depth.upper), bodies.widest(), task,
                   outcome)) {
    return true;
  }
  const DistanceBounds bounds =
      bounder.inside(bodies.a.shape.proven, bodies.a.pose, bodies.b.shape.proven, bodies.b.pose,
                     pair, polytope_.surface(), depth.normal);
  return write_bounds(bounds, bodies.widest(), task, outcome);
}

bool PolytopeContact::decide_rounded(Pair& pair, const Simplex<double>& simplex,
                                     const Vec3d& normal, DistanceBounds gap,
                                     const PlacedPair& bodies, Task task, Outcome& outcome) {
  if (simplex.size > 3 || gap.lower > 0 || gap.upper < 0) return false;
  const Answer answer = finder_.find(bodies.a, bodies.b, {normal, simplex}, pair, task).answer;
  return write_side(answer, gap, bodies.widest(), task, outcome);
}

bool PolytopeContact::decide_over_plane(DistanceBounds gap, double unit, const PlacedPair& bodies,
                                        Task task, Outcome& outcome) {
  const PlacedBody &a = bodies.a, &b = bodies.b;
  if (!a.shape.has_polytope() || gap.lower > 0 || gap.upper < 0) return false;
  if (!(unit < greatest_unit)) return false;
  const Answer answer = finder_.find_over_plane(a, b, unit);
  return write_side(answer, gap, bodies.tolerance * a.shape.size(), task, outcome);
}

}  // namespace touchstone
