// Walks down the trees of both bodies, as far as it needs to find planes, and asks the oracle about pairs of parts.
//
// Poses of parts within bodies are multiplied in doubles for the oracle. Its planes and points are then tried
// on the exact product, as the check will do, and where they fail there the pair is open.
#include "algorithms/oracle/concave/exact_parts_proofs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "algorithms/concave_phase.h"
#include "algorithms/oracle/certificates/parts/part_pair_check.h"
#include "algorithms/oracle/concave/group_plane.h"
#include "algorithms/oracle/concave/inside.h"
#include "algorithms/oracle/concave/rounded_part.h"
#include "algorithms/oracle/oracle.h"

namespace touchstone::entries {
std::vector<ConcaveEntry> oracle_exact_concave();
}  // namespace touchstone::entries

namespace touchstone::oracle {
namespace {

using Kind = PartsCertificate::Step::Kind;
using Proofs = PartsCertificate;

// One of the two bodies.
struct ProvenBody {
  const ConcaveBody& given;
  const Pose& pose;
  PlacedParts parts;
  std::vector<std::uint32_t> order;
  PartTree tree;

  ProvenBody(const ConcaveBody& body, const Pose& placed)
      : given(body),
        pose(placed),
        parts(body, placed),
        order(spatial_order(parts.boxes())),
        tree(order, parts.boxes()) {}

  Body rounded(std::uint32_t part) const { return rounded_part(parts, given, pose, part); }
};

class Walk {
 public:
  Walk(Proofs& proofs, const ProvenBody& a, const ProvenBody& b, double least_distance)
      : proofs_(proofs), a_(a), b_(b), least_(least_distance) {}

  void from(const PartNode& a, const PartNode& b) {
    if (is_done_) return;
    const auto &box_a = a_.tree.box(a), &box_b = b_.tree.box(b);
    if (box_a && box_b) {
      const RoundedGroup group_a(*box_a, a_.pose), group_b(*box_b, b_.pose);
      const double radii = a_.parts.greatest_radius().get_d() + b_.parts.greatest_radius().get_d();
      if (const auto n = plane_between(group_a, group_b, radii + least_)) {
        proofs_.cover.push_back({Kind::plane, *n});
        return;
      }
      if (!a.is_leaf() && (b.is_leaf() || !(spread(group_a) < spread(group_b)))) {
        return halve(true, a, b);
      }
    } else if (!a.is_leaf() && (b.is_leaf() || !box_a)) {
      return halve(true, a, b);
    }
    if (!b.is_leaf()) return halve(false, a, b);
    pair(a_.tree.part(a), b_.tree.part(b));
  }

  // The parts that are nearest, of a distance, and at most how far they are apart.
  const std::optional<Proofs::Met>& nearest() const { return nearest_; }
  double upper() const { return upper_; }

 private:
  static double spread(const RoundedGroup& group) {
    return group.ways.cwiseAbs().rowwise().sum().maxCoeff();
  }

  void halve(bool of_a, const PartNode& a, const PartNode& b) {
    proofs_.cover.push_back({of_a ? Kind::halve_a : Kind::halve_b, {}});
    from(of_a ? a.first_half() : a, of_a ? b : b.first_half());
    from(of_a ? a.second_half() : a, of_a ? b : b.second_half());
  }

  // Not the half-space of a singular matrix.
  static bool has_set(const RationalCore& core) { return !core.is_singular_halfspace(); }

  // False where the proof has a fault.
  template <class Claim>
  static bool holds(const Claim& claim) {
    try {
      return claim();
    } catch (const Fault&) {
      return false;
    }
  }

  void pair(std::uint32_t i, std::uint32_t j) {
    const RationalCore core_a = a_.parts.core(i), core_b = b_.parts.core(j);
    const ApartBy by{a_.parts.radius(i) + b_.parts.radius(j), oracle::rational(least_)};
    Certificate found;
    double upper = HUGE_VAL;
    const Body rounded_a = a_.rounded(i), rounded_b = b_.rounded(j);
    if (rounded_a.is_finite() && rounded_b.is_finite()) {
      upper = oracle_.prove(rounded_a, rounded_b, found).upper;
    }
    const Proofs::Met met{{i, j}, found.a, found.b, found.closest, found.surface};
    if (has_set(core_a) && has_set(core_b)) {
      if (proofs_.claim == Proofs::Claim::distance) {
        holds([&] { return consider(met, upper, core_a, core_b, by.radii); });
      }
      if (core_a.is_halfspace() || core_b.is_halfspace()) {
        if (holds([&] { return is_parted(own_normal(core_a, core_b), core_a, core_b, by); })) {
          proofs_.cover.push_back({Kind::own_plane, {}});
          return;
        }
      } else if (holds([&] {
                   return is_parted(rational_vector(found.direction), core_a, core_b, by);
                 })) {
        proofs_.cover.push_back({Kind::plane, found.direction});
        return;
      }
      const SignedSquare within{0, by.radii * by.radii};
      if (holds([&] { return greatest_distance(met, core_a, core_b) <= within; })) {
        proofs_.met.push_back(met);
        proofs_.cover.push_back({Kind::meet, {}});
        is_done_ = proofs_.claim != Proofs::Claim::contacts;
        return;
      }
    }
    proofs_.cover.push_back({Kind::open, {}});
    ++proofs_.undecided;
  }

  // Heeds how far the two parts are apart at most, if that is less than all others are. True if it is.
  bool consider(const Proofs::Met& met, double upper, const RationalCore& a, const RationalCore& b,
                const mpq_class& radii) {
    if (!(upper >= 0 && upper < upper_)) return false;
    const SignedSquare square = greatest_distance(met, a, b);
    const auto is_bound = [&](double bound) {
      const mpq_class whole = radii + oracle::rational(bound);
      return square <= SignedSquare{0, whole * whole};
    };
    // The rounding of composed poses may have hidden a little of the distance.
    for (double by = std::nextafter(upper, HUGE_VAL) - upper; !is_bound(upper); by *= 2) {
      upper += by;
      if (!(upper < upper_)) return false;
    }
    nearest_ = met;
    upper_ = upper;
    return true;
  }

  Proofs& proofs_;
  const ProvenBody &a_, &b_;
  double least_, upper_ = HUGE_VAL;
  std::optional<Proofs::Met> nearest_;
  bool is_done_ = false;
  Oracle oracle_;
};

// A part of one body that the solver says is inside of the other, and the surface that winds around it.
std::optional<Proofs::Inside> find_inside(const ProvenBody& inner, const ProvenBody& outer,
                                          bool a_is_inside, bool only_exact) {
  const std::vector<Piece> pieces = pieces_of(inner.given);
  if (!is_inside(inner.given, pieces, inner.pose, outer.given, outer.pose, only_exact)) return {};
  for (std::uint32_t surface = 0; surface < outer.parts.surface_count(); ++surface) {
    if (!outer.parts.is_solid(surface)) continue;
    const RationalMesh placed = outer.parts.placed_surface(surface);
    for (const std::uint32_t part : inner.parts.one_of_each_piece()) {
      if (placed.winding(inner.parts.point_of(part)) == 0) continue;
      return Proofs::Inside{a_is_inside, part, surface};
    }
  }
  return {};
}

void leave_open(Proofs& proofs, const ProvenBody& a, const ProvenBody& b) {
  proofs.answer = Answer::unknown;
  proofs.met.clear();
  proofs.cover = {{Kind::open, {}}};
  proofs.undecided = std::uint64_t{a.parts.size()} * b.parts.size();
}

void prove(Proofs& proofs, const ProvenBody& a, const ProvenBody& b, double least_distance) {
  Walk walk(proofs, a, b, least_distance);
  const bool has_pairs = a.parts.size() > 0 && b.parts.size() > 0;
  if (has_pairs && (a.parts.is_rounded() || b.parts.is_rounded())) return leave_open(proofs, a, b);
  if (has_pairs) walk.from(a.tree.root(), b.tree.root());
  if (proofs.met.empty()) {
    proofs.inside = find_inside(a, b, true, proofs.undecided > 0);
    if (!proofs.inside) proofs.inside = find_inside(b, a, false, proofs.undecided > 0);
  }
  if (!proofs.met.empty() || proofs.inside) {
    proofs.answer = Answer::overlapping;
    if (proofs.claim == Proofs::Claim::contacts) return;
    proofs.cover.clear();
    proofs.order_a.clear();
    proofs.order_b.clear();
    proofs.undecided = 0;
    return;
  }
  proofs.answer = proofs.undecided > 0 ? Answer::unknown : Answer::separated;
  if (proofs.claim != Proofs::Claim::distance || proofs.undecided > 0 || !has_pairs) return;
  if (!walk.nearest()) return leave_open(proofs, a, b);
  proofs.bounds = {least_distance, walk.upper()};
  proofs.met = {*walk.nearest()};
}

// The lower bound of the solver, and 0 where it has none.
double solved_distance(const ConcaveBody& a, const Pose& pose_a, const ConcaveBody& b,
                       const Pose& pose_b) {
  const std::unique_ptr<ConcavePhase> solver = entries::oracle_exact_concave().front().make({});
  const std::array<ConcaveBody, 2> bodies = {a, b};
  solver->bind(bodies);
  Outcome outcome;
  std::vector<IndexPair> pairs;
  solver->solve(ConcaveTask::distance, {0, pose_a}, {1, pose_b}, outcome, pairs);
  const bool is_known = outcome.answer == Answer::separated && std::isfinite(outcome.lower);
  return is_known ? std::max(0.0, outcome.lower) : 0.0;
}

}  // namespace

PartsCertificate prove_parts(PartsCertificate::Claim claim, const ConcaveBody& a,
                             const Pose& pose_a, const ConcaveBody& b, const Pose& pose_b) {
  Proofs proofs;
  proofs.claim = claim;
  const ProvenBody body_a(a, pose_a), body_b(b, pose_b);
  proofs.order_a = body_a.order;
  proofs.order_b = body_b.order;
  prove(proofs, body_a, body_b,
        claim == Proofs::Claim::distance ? solved_distance(a, pose_a, b, pose_b) : 0);
  return proofs;
}

}  // namespace touchstone::oracle
