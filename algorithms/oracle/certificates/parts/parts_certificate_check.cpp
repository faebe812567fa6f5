// Walks over the cover, checks each plane and each common point, and what follows from them.
#include "algorithms/oracle/certificates/parts/parts_certificate_check.h"

#include <cmath>

#include "algorithms/oracle/certificates/parts/part_pair_check.h"

namespace touchstone::oracle {
namespace {

using PartsClaim = PartsCertificate::Claim;
using CoverStep = PartsCertificate::Step::Kind;

class CheckedParts {
 public:
  CheckedParts(const PartsCertificate& certificate, const PlacedBody& a, const PlacedBody& b)
      : certificate_(certificate), a_(a.body, a.pose), b_(b.body, b.pose) {
    require(certificate.answer == Answer::unknown || !has_pairs() ||
                !(a_.is_rounded() || b_.is_rounded()),
            "the places of parts are rounded, so that nothing is proven");
  }

  void require_proven() {
    require_no_more_than_is_claimed();
    if (needs_cover()) {
      require_cover();
    } else {
      require(certificate_.cover.empty() && certificate_.order_a.empty() &&
                  certificate_.order_b.empty() && certificate_.undecided == 0,
              "a cover is there without need");
    }
    for (const PartsCertificate::Met& met : certificate_.met) require_met(met);
    if (certificate_.inside) require_inside(*certificate_.inside);
    if (certificate_.answer != Answer::separated) return;
    require_outside(a_, b_);
    require_outside(b_, a_);
  }

 private:
  bool has_pairs() const { return a_.size() > 0 && b_.size() > 0; }
  bool needs_cover() const {
    return certificate_.claim == PartsClaim::contacts || certificate_.answer != Answer::overlapping;
  }

  // The answer is one that the kind of proofs can be for, and no proof is there without need.
  void require_no_more_than_is_claimed() const {
    const auto& [claim, answer, bounds, undecided, order_a, order_b, cover, met, inside] =
        certificate_;
    const bool is_distance =
        claim == PartsClaim::distance && answer == Answer::separated && has_pairs();
    require(bounds.has_value() == is_distance, "not exactly a distance has bounds");
    if (answer == Answer::overlapping) {
      require(inside.has_value() == met.empty(),
              "not one of a common point and an inside is there");
      require(claim == PartsClaim::contacts || met.size() <= 1, "one common point is enough");
      return;
    }
    require(answer == Answer::separated || answer == Answer::unknown, "that is no answer");
    require(!inside, "a body is inside of the other");
    require(met.size() == (is_distance ? 1 : 0), "not exactly a distance has its points");
    require((answer == Answer::unknown) == (undecided > 0),
            "not exactly an unknown answer has open pairs");
    if (!is_distance) return;
    require(std::isfinite(bounds->lower) && std::isfinite(bounds->upper), "a bound is no number");
    require(bounds->lower >= 0 && bounds->lower <= bounds->upper, "the bounds are no distances");
  }

  void require_cover() {
    const PartTree tree_a(certificate_.order_a, a_.boxes()),
        tree_b(certificate_.order_b, b_.boxes());
    if (has_pairs()) walk(tree_a, tree_a.root(), tree_b, tree_b.root());
    require(next_ == certificate_.cover.size(), "the cover is too long");
    require(open_ == certificate_.undecided, "another number of pairs is open");
    require(certificate_.claim != PartsClaim::contacts || next_met_ == certificate_.met.size(),
            "a common point is not in the cover");
  }

  void walk(const PartTree& tree_a, const PartNode& a, const PartTree& tree_b, const PartNode& b) {
    require(next_ < certificate_.cover.size(), "the cover is too short");
    const PartsCertificate::Step& step = certificate_.cover[next_++];
    const bool is_pair = a.is_leaf() && b.is_leaf();
    switch (step.kind) {
      case CoverStep::halve_a:
        require(!a.is_leaf(), "a single part is halved");
        walk(tree_a, a.first_half(), tree_b, b);
        return walk(tree_a, a.second_half(), tree_b, b);
      case CoverStep::halve_b:
        require(!b.is_leaf(), "a single part is halved");
        walk(tree_a, a, tree_b, b.first_half());
        return walk(tree_a, a, tree_b, b.second_half());
      case CoverStep::plane:
        if (is_pair) {
          return require_parted(rational_vector_of(step), tree_a.part(a), tree_b.part(b));
        }
        return require_groups_parted(rational_vector_of(step), tree_a.box(a), tree_b.box(b));
      case CoverStep::own_plane: {
        require(is_pair, "a plane of a half-space is for two parts");
        const std::uint32_t i = tree_a.part(a), j = tree_b.part(b);
        return require_parted(own_normal(a_.core(i), b_.core(j)), i, j);
      }
      case CoverStep::meet: {
        require(is_pair && certificate_.claim == PartsClaim::contacts,
                "a common point is for two parts, and for contacts");
        require(next_met_ < certificate_.met.size(), "a common point is missing");
        const IndexPair parts{tree_a.part(a), tree_b.part(b)};
        require(certificate_.met[next_met_++].parts == parts, "a common point is of other parts");
        return;
      }
      case CoverStep::open: open_ += std::uint64_t{a.size()} * b.size(); return;
    }
    throw Fault{"that is no step"};
  }

  static RationalVector rational_vector_of(const PartsCertificate::Step& step) {
    return rational_vector(step.direction);
  }

  mpq_class least_distance() const {
    return certificate_.bounds ? oracle::rational(certificate_.bounds->lower) : mpq_class(0);
  }

  void require_parted(const RationalVector& n, std::uint32_t i, std::uint32_t j) const {
    require(is_parted(n, a_.core(i), b_.core(j), {a_.radius(i) + b_.radius(j), least_distance()}),
            "a plane does not part two parts");
  }

  void require_groups_parted(const RationalVector& n, const std::optional<RationalBox>& a,
                             const std::optional<RationalBox>& b) const {
    require(!is_zero(n), "a plane has no direction");
    require(a && b, "a plane does not part an unbounded group");
    const ApartBy by{a_.greatest_radius() + b_.greatest_radius(), least_distance()};
    const mpq_class gap = -a_.support(n, *a) - b_.support(mpq_class(-1) * n, *b);
    require(by.holds(gap, n), "a plane does not part two groups");
  }

  void require_met(const PartsCertificate::Met& met) const {
    const auto [i, j] = met.parts;
    require(i < a_.size() && j < b_.size(), "a common point is of no part");
    const RationalCore a = a_.core(i), b = b_.core(j);
    mpq_class within = a_.radius(i) + b_.radius(j);
    if (certificate_.bounds) within += oracle::rational(certificate_.bounds->upper);
    require(greatest_distance(met, a, b) <= SignedSquare{0, within * within},
            certificate_.bounds ? "the points are further apart than the distance"
                                : "the points do not prove a common one");
  }

  void require_inside(const PartsCertificate::Inside& inside) const {
    const PlacedParts &inner = inside.a_is_inside ? a_ : b_, &outer = inside.a_is_inside ? b_ : a_;
    require(inside.part < inner.size(), "what is inside is no part");
    require(inside.surface < outer.surface_count(), "what it is inside of is no surface");
    // A point that is on the surface is one of both bodies too.
    require(outer.is_solid(inside.surface), "what it is inside of is not solid");
    const RationalMesh placed = outer.placed_surface(inside.surface);
    require(placed.winding(inner.point_of(inside.part)) != 0,
            "the surface does not wind around the part");
  }

  // No part meets one of the other body, so a piece is outside if one point of it is, and is on no surface.
  static void require_outside(const PlacedParts& inner, const PlacedParts& outer) {
    for (std::uint32_t surface = 0; surface < outer.surface_count(); ++surface) {
      if (!outer.is_solid(surface)) continue;
      const RationalMesh placed = outer.placed_surface(surface);
      for (const std::uint32_t part : inner.one_of_each_piece()) {
        require(placed.winding(inner.point_of(part)) == 0, "a surface winds around a part");
      }
    }
  }

  const PartsCertificate& certificate_;
  PlacedParts a_, b_;
  std::size_t next_ = 0, next_met_ = 0;
  std::uint64_t open_ = 0;
};

}  // namespace

std::string fault(const PartsCertificate& certificate, const PlacedBody& a, const PlacedBody& b) {
  try {
    CheckedParts(certificate, a, b).require_proven();
  } catch (const Fault& found) {
    return found.what();
  }
  return {};
}

}  // namespace touchstone::oracle
