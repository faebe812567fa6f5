// Tests the lengths that queries of continuous collision are asked with.
#include "harness/kinds/feature/feature_kind.h"

#include <gtest/gtest.h>

#include "algorithms/oracle/ccd/first_within.h"
#include "harness/families/ccd_families.h"
#include "harness/kinds/grading.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

TEST(CcdLengths, EverySixteenthSeparationIsACloseOne) {
  oracle::Oracle oracle;
  std::uint32_t family_number = 0;
  int hits = 0, misses = 0, close = 0;
  for (const families::CcdFamily& family : families::ccd_families()) {
    const int first_count = family.pair == FeaturePair::vertex_face ? 1 : 2;
    for (int index = 0; index < drawn(320, 64); ++index) {
      const auto number = static_cast<std::uint64_t>(index);
      auto draws = kinds::draws_of(kinds::feature_kind(), family_number, 5, number);
      const CcdQuery query = family.draw(draws);
      const kinds::Lengths lengths = kinds::separated_lengths(number, query, first_count, oracle);
      EXPECT_GT(lengths.separation, 0);
      EXPECT_EQ(lengths.tolerance, kinds::ccd_size(number).tolerance);
      if (index % 16 != 0) continue;
      const oracle::ccd::MovingFeatures features{first_count, query.start, query.end};
      // A tolerance less, or more, is the other side of that least distance.
      const auto is_hit = [&](double more) {
        const double separation = lengths.separation + more;
        return separation > 0 && oracle::ccd::impact_within(features, separation).is_hit;
      };
      const bool own = is_hit(0);
      ++(own ? hits : misses);
      close += own != is_hit(own ? -lengths.tolerance : lengths.tolerance) ? 1 : 0;
    }
    ++family_number;
  }
  EXPECT_GT(hits, 20);
  EXPECT_GT(misses, 20);
  // The others come nearer at another time, or were drawn.
  EXPECT_GT(close, (hits + misses) / 2);
}

}  // namespace
}  // namespace touchstone
