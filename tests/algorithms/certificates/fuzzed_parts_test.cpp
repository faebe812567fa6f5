// Whatever is changed in a certificate: if it is verified, what it claims is true.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/algorithms/certificates/bodies.h"

namespace touchstone {
namespace {

using reference::body_of;
using reference::PartsCertificate;
using reference::PartsClaim;
using reference::ProvenPair;
using Kind = PartsCertificate::Step::Kind;

template <class List>
std::size_t place_in(const List& list, reference::Random& random) {
  return static_cast<std::size_t>(random.below(static_cast<int>(list.size())));
}

template <class List>
void swap_two(List& list, reference::Random& random) {
  if (!list.empty()) std::swap(list[place_in(list, random)], list[place_in(list, random)]);
}

// Changes a few things, mostly to what may well be valid.
void change(PartsCertificate& c, const PartsCertificate& other, reference::Random& random) {
  switch (random.below(13)) {
    case 0: swap_two(c.order_a, random); break;
    case 1: swap_two(c.order_b, random); break;
    case 2: swap_two(c.cover, random); break;
    case 3:
      if (!c.cover.empty())
        c.cover.erase(c.cover.begin() + static_cast<std::ptrdiff_t>(place_in(c.cover, random)));
      break;
    case 4:
      if (!c.cover.empty())
        c.cover[place_in(c.cover, random)].kind = static_cast<Kind>(random.below(6));
      break;
    case 5:
      if (!c.cover.empty()) {
        auto& direction = c.cover[place_in(c.cover, random)].direction;
        direction[static_cast<std::size_t>(random.below(3))] += random.below(3) - 1;
      }
      break;
    case 6: c.claim = static_cast<PartsClaim>(random.below(3)); break;
    case 7: c.answer = static_cast<Answer>(random.below(4)); break;
    case 8: c.met = other.met; break;
    case 9: swap_two(c.met, random); break;
    case 10:
      c.inside = PartsCertificate::Inside{random.below(2) == 0,
                                          static_cast<std::uint32_t>(random.below(4)), 0};
      break;
    case 11: c.bounds = other.bounds; break;
    default: {
      const PartsClaim claim = c.claim;
      c = other;
      c.claim = claim;
    }
  }
}

// A claim that says less may be true where the solver says more, but none that says another thing.
void expect_true(const PartsCertificate& proof, const ProvenPair& pair) {
  const reference::Answered solved = pair.solve(proof.claim);
  if (proof.answer == Answer::unknown || solved.outcome.answer == Answer::unknown) return;
  EXPECT_EQ(proof.answer, solved.outcome.answer);
  if (proof.claim == PartsClaim::contacts) {
    const auto pairs = reference::met_pairs(proof);
    EXPECT_TRUE(std::ranges::includes(solved.pairs, pairs));
    EXPECT_GE(pairs.size() + proof.undecided, solved.pairs.size());
  }
  if (!proof.bounds) return;
  EXPECT_LE(proof.bounds->lower, solved.outcome.upper);
  EXPECT_GE(proof.bounds->upper, solved.outcome.lower);
}

TEST(FuzzedPartsCertificates, WhatIsVerifiedIsTrue) {
  reference::Random random(17);
  std::vector<ProvenPair> pairs;
  const ConcaveBody box = body_of(families::box_mesh(1, 1, 1, true));
  const ConcaveBody small = body_of(families::box_mesh(0.25, 0.25, 0.25));
  for (int i = 0; i < 16; ++i) {
    const Pose place = {i % 2 == 0 ? Mat3d(Mat3d::Identity()) : random.rotation(),
                        random.vector(i % 4 == 0 ? 0.5 : 1.75)};
    pairs.push_back({box, small, {}, place});
    pairs.push_back({reference::compound(random, 2, i % 4 == 0, i % 3 == 0),
                     reference::compound(random, 2, false, false),
                     {},
                     {random.rotation(), random.vector(3)}});
  }
  int verified = 0, refused = 0;
  for (const PartsClaim claim : reference::all_claims) {
    std::vector<PartsCertificate> proofs;
    for (const ProvenPair& pair : pairs) proofs.push_back(pair.prove(claim));
    for (int i = 0; i < drawn(1500, 150); ++i) {
      const std::size_t at = place_in(pairs, random);
      // The other one is of bodies of the same kind, mostly.
      const std::size_t other = (at + 2 * place_in(pairs, random)) % pairs.size();
      PartsCertificate changed = proofs[at];
      for (int k = 0; k <= i % 3; ++k) change(changed, proofs[other], random);
      const bool holds = pairs[at].fault(changed).empty();
      ++(holds ? verified : refused);
      if (holds) expect_true(changed, pairs[at]);
    }
  }
  EXPECT_GT(verified, 300 / one_in);
  EXPECT_GT(refused, 1000 / one_in);
}

}  // namespace
}  // namespace touchstone
