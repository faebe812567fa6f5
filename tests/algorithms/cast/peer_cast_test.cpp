// Casts of other libraries: plain questions that each must answer, and the defects that are stated.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/algorithms/cast/moving_bodies.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

std::vector<const CastEntry*> peer_casts() {
  std::vector<const CastEntry*> all;
  for (const CastEntry& entry : registry::entries<CastEntry>()) {
    if (entry.info.origin == Origin::peer && is_built(entry.info)) all.push_back(&entry);
  }
  return all;
}

CastSettings settings_of(const CastEntry& entry) {
  CastSettings settings;
  settings.scalar = entry.scalars[0];
  return settings;
}

TEST(PeerCasts, BallsThatMeetSquarelyAndBallsThatPass) {
  for (const CastEntry* entry : peer_casts()) {
    MovingPairCase c;
    c.a = make_sphere(1);
    c.b = make_sphere(1);
    c.pose_b.translation = {4, 0, 0};
    c.motion_b.displacement = {-4, 0, 0};
    const CastOutcome hit = solve(*entry, c, settings_of(*entry));
    EXPECT_EQ(hit.answer, CastAnswer::hit) << entry->info.name;
    // The naive one tries ten times, and Bullet stops 1 cm early.
    EXPECT_NEAR(hit.toi, 0.5, entry->info.name == "fcl-naive" ? 0.12 : 0.02) << entry->info.name;
    EXPECT_EQ(hit.status, Status::not_reported) << entry->info.name;
    c.motion_b.displacement = {0, 4, 0};
    const CastOutcome miss = solve(*entry, c, settings_of(*entry));
    EXPECT_EQ(miss.answer, CastAnswer::miss) << entry->info.name;
    EXPECT_TRUE(std::isnan(miss.toi)) << entry->info.name;
  }
}

// A rod that turns by more than half a turn reaches a ball on the way.
TEST(PeerCasts, TurnsOfMoreThanHalfATurn) {
  for (const CastEntry* entry : peer_casts()) {
    if (!entry->rotation) continue;
    MovingPairCase c;
    c.a = make_capsule(0.1, 1);
    c.pose_a.rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // along x
    c.motion_a.rotation_vector = {0, 0, 2.5};
    c.b = make_sphere(0.2);
    c.pose_b.translation = {0, 0.9, 0};
    const CastOutcome outcome = solve(*entry, c, settings_of(*entry));
    ASSERT_EQ(outcome.answer, CastAnswer::hit) << entry->info.name;
    const double truth = (std::numbers::pi / 2 - std::asin(0.3 / 0.9)) / 2.5;
    EXPECT_NEAR(outcome.toi, truth, entry->info.name == "fcl-naive" ? 0.12 : 5e-3)
        << entry->info.name;
  }
}

// What they get wrong is not asserted, since another version may be better; only that those without a
// stated defect of this kind find what others find.
TEST(PeerCasts, MeetingsThatEachFinds) {
  Random random(31);
  for (const CastEntry* entry : peer_casts()) {
    int asked = 0, found = 0, late = 0;
    for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box}) {
      for (int i = 0; i < drawn(60, 6); ++i) {
        const MovingPairCase c =
            meeting(kind, kind, ContactFeature::vertices, random.uniform(0.1, 0.9), 3, random);
        if (!c.squarely) continue;
        ++asked;
        const CastOutcome outcome = solve(*entry, c, settings_of(*entry));
        if (outcome.answer != CastAnswer::hit) continue;
        ++found;
        if (outcome.toi > c.toi + 0.15) ++late;
      }
    }
    RecordProperty(entry->info.name, found);
    EXPECT_GE(found, asked / 3) << entry->info.name;
    EXPECT_LE(late, found / 4) << entry->info.name;
  }
}

}  // namespace
}  // namespace touchstone
