#include "algorithms/broad_phase/verlet_list/rebuild_interval.h"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(RebuildInterval, SlowBodiesGetALongListAndFastOnesNone) {
  RebuildInterval duration;
  EXPECT_GE(duration.choose({.step = 0, .share = 0}, 1000, 2000), 64);
  EXPECT_GE(duration.choose({.step = 0.001f, .share = 0.001}, 1000, 2000), 16);
  EXPECT_EQ(duration.choose({.step = 1, .share = 0.5}, 1000, 2000), 0);
  EXPECT_EQ(duration.choose({.step = 1, .share = 0.5}, 0, 0), 0);
}

TEST(RebuildInterval, ManyPairsGetNoListWhereFewGetOne) {
  RebuildInterval duration;
  for (const std::size_t bodies : {1'000, 100'000}) {
    const MeanMotion motion{.step = 1, .share = 0.016};
    EXPECT_GT(duration.choose(motion, bodies, bodies / 2), 4);
    EXPECT_EQ(duration.choose(motion, bodies, 5 * bodies / 2), 0);
  }
}

TEST(RebuildInterval, SlowerBodiesNeverGetAShorterList) {
  RebuildInterval duration;
  double last = 1e9;
  for (const double share : {0.0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3}) {
    const double frames = duration.choose({.step = 1, .share = share}, 1000, 2000);
    EXPECT_LE(frames, last);
    last = frames;
  }
}

TEST(RebuildInterval, LearnsFromListsThatGrewMoreOrEndedSooner) {
  const MeanMotion motion{.step = 1, .share = 0.02};
  RebuildInterval fresh;
  const double frames = fresh.choose(motion, 1000, 500);
  ASSERT_GT(frames, 2);
  RebuildInterval crowded;
  for (int i = 0; i < 8; ++i) {
    crowded.made(motion, frames, 1000, 12500);
    crowded.ended(static_cast<int>(frames), 1000, 500);
  }
  EXPECT_LT(crowded.choose(motion, 1000, 500), frames);
  RebuildInterval roomy;
  for (int i = 0; i < 8; ++i) {
    roomy.made(motion, frames, 1000, 525);
    roomy.ended(static_cast<int>(frames), 1000, 500);
  }
  EXPECT_GT(roomy.choose(motion, 1000, 500), frames);
}

}  // namespace
}  // namespace touchstone
