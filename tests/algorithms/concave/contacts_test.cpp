// Depths and normals of pairs of parts, against the oracle's verdicts on bodies that are moved by them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/hull/convex_hull.h"
#include "tests/algorithms/concave/meshes.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

using reference::Answered;
using reference::ask;
using reference::body_of;
using reference::moved_by;

struct Measured {
  std::vector<IndexPair> pairs;
  std::vector<PartContact> contacts;
};

Measured measured(const char* name, const std::array<ConcaveBody, 2>& bodies, const Pose& a,
                  const Pose& b) {
  const auto phase = registry::find<ConcaveEntry>(name)->make(reference::concave_settings());
  phase->bind(bodies);
  Measured found;
  Outcome outcome;
  phase->solve(ConcaveTask::contacts, {0, a}, {1, b}, outcome, found.pairs);
  std::ranges::sort(found.pairs);
  EXPECT_TRUE(phase->measure({0, a}, {1, b}, found.pairs, found.contacts));
  return found;
}

bool meet(const std::array<ConcaveBody, 2>& bodies, const Pose& a, Pose b, const Vec3d& moved,
          const IndexPair& pair) {
  b.translation += moved;
  const Answered truth = ask("exact", ConcaveTask::contacts, bodies, a, b);
  return std::ranges::find(truth.pairs, pair) != truth.pairs.end();
}

TEST(ConcaveContacts, PartAsFarAsTheirDepthSays) {
  reference::Random random(1);
  const ConcaveBody torus = body_of(reference::torus(6, 4, 1, 0.3));
  int asked = 0;
  for (int i = 0; i < drawn(24, 4); ++i) {
    std::vector<Vec3d> points;
    for (int k = 0; k < 12; ++k) points.push_back(0.3 * random.direction());
    const ConcaveBody body = body_of(i % 4 == 0   ? reference::make_sphere(0.3)
                                     : i % 4 == 1 ? reference::make_capsule(0.2, 0.2)
                                     : i % 4 == 2 ? reference::make_box(0.3, 0.2, 0.25)
                                                  : hull_of(points));
    const Pose a = {random.rotation(), random.vector(1)};
    const Pose b = {random.rotation(), a(Vec3d(random.uniform(0.7, 1.3), 0, 0))};
    const bool first = i % 2 == 0;
    const std::array<ConcaveBody, 2> bodies =
        first ? std::array{torus, body} : std::array{body, torus};
    const Pose &pose_a = first ? a : b, &pose_b = first ? b : a;
    const Measured found = measured(first ? "fused" : "part-pairs", bodies, pose_a, pose_b);
    ASSERT_EQ(found.contacts.size(), found.pairs.size());
    for (std::size_t k = 0; k < found.pairs.size(); k += 3) {
      const PartContact& contact = found.contacts[k];
      EXPECT_EQ(contact.parts, found.pairs[k]);
      EXPECT_EQ(contact.status, Status::ok);
      EXPECT_NEAR(contact.normal.norm(), 1, 1e-12);
      const Vec3d way = contact.depth * contact.normal;
      const double beyond = 1e-7;
      EXPECT_FALSE(meet(bodies, pose_a, pose_b, way + beyond * contact.normal, contact.parts));
      if (contact.depth > 1e-6) {
        EXPECT_TRUE(meet(bodies, pose_a, pose_b, way - beyond * contact.normal, contact.parts));
      }
      ++asked;
    }
  }
  EXPECT_GT(asked, 20 / one_in);
}

// `fused` asks GJK and EPA first, `part-pairs` a narrow phase that proves each depth: of parts deep in each
// other, of parts that touch in a face, an edge or a vertex, of parts whose place is rounded, and of those
// without bounds.
TEST(ConcaveContacts, AreThoseThatAProofHas) {
  reference::Random random(2);
  const ConcaveBody torus = body_of(reference::torus(6, 4, 1, 0.3));
  const ConcaveBody box_of_triangles = body_of(reference::box_mesh(1, 1, 1));
  Shape ground;
  ground.kind = ShapeKind::halfspace;
  int deep = 0, touching = 0;
  for (int i = 0; i < drawn(60, 10); ++i) {
    const Pose turned = {random.rotation(), random.vector(0.3)};
    ConcaveBody compound = body_of(reference::make_box(0.3, 0.2, 0.25), turned);
    compound.parts.push_back({reference::make_capsule(0.2, 0.3), {}, 0});
    compound.parts.push_back({reference::make_sphere(0.35), turned, 0});
    compound.parts.push_back({ground, moved_by({0, 0, -0.5}), 0});
    std::array<ConcaveBody, 2> bodies = {torus, compound};
    Pose a = {random.rotation(), random.vector(0.5)}, b = {random.rotation(), random.vector(0.5)};
    if (i % 3 == 1) bodies[1] = torus;
    if (i % 3 == 2) {
      // On a grid, beside each other or as far in.
      const auto on_grid = [&] { return 0.5 * std::round(random.uniform(-4, 4)); };
      bodies = {box_of_triangles, body_of(reference::make_box(1, 1, 1))};
      a = {};
      b = moved_by({on_grid(), on_grid(), on_grid()});
    }
    const Measured fused = measured("fused", bodies, a, b);
    const Measured proven = measured("part-pairs", bodies, a, b);
    ASSERT_EQ(fused.pairs, proven.pairs);
    for (std::size_t k = 0; k < fused.pairs.size(); ++k) {
      const PartContact &one = fused.contacts[k], &other = proven.contacts[k];
      EXPECT_EQ(one.parts, other.parts);
      EXPECT_EQ(one.status, other.status) << i << " " << k;
      if (other.status != Status::ok) continue;
      EXPECT_NEAR(one.depth, other.depth, 1e-9) << i << " " << k;
      ++(other.depth > 0 ? deep : touching);
    }
  }
  EXPECT_GT(deep, drawn(200, 20));
  EXPECT_GT(touching, drawn(20, 2));
}

TEST(ConcaveContacts, OfABallOnAPlane) {
  const ConcaveBody ground =
      reference::mesh_of({{Vec3d(-4, -4, 0), Vec3d(4, -4, 0), Vec3d(0, 4, 0)}});
  const ConcaveBody ball = body_of(reference::make_sphere(1));
  for (const double height : {0.75, 1.0}) {
    const Measured found = measured("fused", {ground, ball}, {}, moved_by({0, 0, height}));
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_NEAR(found.contacts[0].depth, 1 - height, 1e-14);
    EXPECT_NEAR(found.contacts[0].normal.z(), 1, 1e-14);
    EXPECT_NEAR(found.contacts[0].point.z(), (height - 1) / 2, 1e-14);
  }
}

TEST(ConcaveContacts, ThoseWithoutSaySo) {
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (!is_built(entry.info)) continue;
    const auto phase = entry.make(reference::concave_settings());
    const std::array<ConcaveBody, 2> bodies = {body_of(reference::box_mesh(1, 1, 1)),
                                               body_of(reference::make_sphere(1))};
    if (entry.supports != nullptr && !entry.supports(bodies[0], bodies[1])) continue;
    phase->bind(bodies);
    std::vector<PartContact> contacts;
    EXPECT_EQ(phase->measure({0, {}}, {1, {}}, {}, contacts), entry.measures) << entry.info.name;
  }
}

}  // namespace
}  // namespace touchstone
