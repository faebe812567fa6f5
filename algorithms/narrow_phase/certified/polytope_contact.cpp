// Part of certified: the guesses of GJK and EPA at contact, and what is proven of them.
#include "algorithms/narrow_phase/certified/polytope_contact.h"

#include <span>

#include "algorithms/narrow_phase/certified/enclosure.h"

namespace touchstone {
namespace {

using Pair = SupportPair<double>;

// A guess with these corners of the simplex.
ContactGuess guess_of(const Vec3d& normal, const Pair& pair, const Simplex<double>& simplex,
                      std::span<const std::size_t> corners, const PlacedBody& a) {
  const Vec3d centre_a = a.pose.rotation * a.shape.support().centre;
  ContactGuess guess{normal, corners.size()};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const DifferencePoint<double>& corner = simplex.points[corners[k]];
    guess.a[k] = pair.unit() * corner.a + centre_a;
    guess.b[k] = pair.unit() * corner.b + centre_a;
  }
  return guess;
}

// Writes an exact verdict and bounds on the signed distance that did not know of it.
bool write_side(Answer answer, DistanceBounds gap, double size, Task task, Outcome& outcome) {
  if (answer == Answer::unknown) return false;
  if (answer != Answer::overlapping) gap.lower = 0;
  if (answer != Answer::separated) gap.upper = 0;
  return write_answer(answer, gap, size, task, outcome);
}

}  // namespace

bool PolytopeContact::decide_exactly(Pair& pair, const Vec3d& direction, const PlacedPair& bodies,
                                     Task task, Outcome& outcome) {
  Vec3d normal = direction.stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) normal = pair.centre_b().stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) normal = Vec3d::UnitX();
  const ExactContact contact = find({normal}, pair, bodies, task != Task::intersect);
  if (contact.answer == Answer::unknown) return false;
  if (is_asked(task, contact.answer)) {
    outcome.normal = contact.normal;
    outcome.witness_a = contact.on_a;
    outcome.witness_b = contact.on_b;
  }
  return write_answer(contact.answer, {contact.lower, contact.upper}, bodies.size(), task, outcome);
}

bool PolytopeContact::encloses(Pair& pair, const Simplex<double>& simplex, Outcome& outcome) {
  const Expansion<double> depth =
      polytope_.expand(pair, simplex, {.tolerance = Pair::rounding, .enough = nearly});
  outcome.iterations += depth.iterations;
  return depth.has_surface && surely_encloses_origin(polytope_.surface()) &&
         write_verdict(Answer::overlapping, outcome);
}

bool PolytopeContact::find_depth(Pair& pair, const Simplex<double>& simplex,
                                 const PlacedPair& bodies, DistanceBounder& bounder,
                                 Outcome& outcome) {
  const Expansion<double> depth = polytope_.expand(pair, simplex, {.tolerance = Pair::rounding});
  outcome.iterations += depth.iterations;
  if (depth.upper <= nearly &&
      decide_exactly(pair, depth.normal, bodies, Task::penetration, outcome)) {
    return true;
  }
  if (depth.end != ExpansionEnd::converged || !depth.has_surface) return false;
  outcome.normal = depth.normal;
  outcome.witness_a = pair.to_world(depth.a);
  outcome.witness_b = pair.to_world(depth.b);
  const DistanceBounds bounds =
      bounder.inside(bodies.a.shape.proven, bodies.a.pose, bodies.b.shape.proven, bodies.b.pose,
                     pair, polytope_.surface(), depth.normal);
  return write_bounds(bounds, bodies.size(), Task::penetration, outcome);
}

bool PolytopeContact::decide_rounded(Pair& pair, const Simplex<double>& simplex,
                                     const Vec3d& normal, DistanceBounds gap,
                                     const PlacedPair& bodies, Task task, Outcome& outcome) {
  if (simplex.size > 3 || gap.lower > 0 || gap.upper < 0) return false;
  static constexpr std::array<std::size_t, 3> all = {0, 1, 2};
  const auto corners = std::span(all).first(static_cast<std::size_t>(simplex.size));
  const Answer answer =
      find(guess_of(normal, pair, simplex, corners, bodies.a), pair, bodies, false).answer;
  return write_side(answer, gap, bodies.size(), task, outcome);
}

bool PolytopeContact::decide_over_plane(DistanceBounds gap, double unit, const PlacedPair& bodies,
                                        Task task, Outcome& outcome) {
  const auto& [a, b] = bodies;
  if (!a.shape.has_polytope() || gap.lower > 0 || gap.upper < 0) return false;
  if (!(unit < greatest_unit)) return false;
  const Answer answer = finder_.find_over_plane(a.shape.solid, a.pose, b.shape.solid, b.pose, unit);
  return write_side(answer, gap, a.shape.size(), task, outcome);
}

ExactContact PolytopeContact::find(const ContactGuess& guess, Pair& pair, const PlacedPair& bodies,
                                   bool close) {
  return finder_.find(bodies.a.shape.solid, bodies.a.pose, bodies.b.shape.solid, bodies.b.pose,
                      guess, pair, close);
}

}  // namespace touchstone
