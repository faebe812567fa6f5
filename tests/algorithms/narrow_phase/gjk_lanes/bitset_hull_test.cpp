// The faces of a polytope of few vertices: closed and convex whatever is added, and nothing that
// does not see a disc.
#include "algorithms/narrow_phase/gjk_lanes/bitset_hull.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "tests/algorithms/random.h"

namespace touchstone::bitset_hull_test {
namespace {

// A surface with its points; a face that is no more has no corners here.
class Grown {
 public:
  Grown() {
    surface_.start();
    points_ = {{0.3, 0.3, 0.3}, {-0.3, 0.3, -0.3}, {0.3, -0.3, -0.3}, {-0.3, -0.3, 0.3}};
    alive_ = {0, 1, 2, 3};
  }

  double height(std::size_t face, const Vec3d& p) const {
    const auto& [a, b, c] = surface_.corners(face);
    const Vec3d normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    return normal.dot(p - points_[a]) / normal.norm();
  }

  bool add(const Vec3d& p) {
    BitsetHull::Faces seen{};
    std::size_t visible = 0;
    for (const std::size_t face : alive_) {
      if (!(height(face, p) > 1e-12)) continue;
      seen[face / 64] |= std::uint64_t{1} << face % 64;
      ++visible;
    }
    if (!surface_.add(seen)) return false;
    points_.push_back(p);
    const BitsetHull::Cone& cone = surface_.cone();
    EXPECT_EQ(cone.gone, visible > cone.size ? visible - cone.size : 0);
    std::erase_if(alive_,
                  [&](std::size_t face) { return (seen[face / 64] >> face % 64 & 1) != 0; });
    for (std::size_t i = 0; i < cone.size; ++i) {
      EXPECT_TRUE(alive_.insert(cone.places[i]).second) << "a place that is taken";
    }
    return true;
  }

  void expect_sound() const {
    std::set<std::pair<int, int>> edges;
    std::set<int> vertices;
    for (const std::size_t face : alive_) {
      EXPECT_LT(face, surface_.faces());
      const BitsetHull::Corners& c = surface_.corners(face);
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.insert(c[k]);
        EXPECT_TRUE(edges.insert({c[k], c[(k + 1) % 3]}).second) << "an edge twice";
      }
      for (const Vec3d& p : points_) EXPECT_LE(height(face, p), 1e-9);
    }
    for (const auto& [tail, head] : edges) EXPECT_EQ(edges.count({head, tail}), 1u);
    EXPECT_EQ(alive_.size(), 2 * vertices.size() - 4);
  }

  std::size_t vertices() const { return surface_.vertices(); }
  BitsetHull& surface() { return surface_; }

 private:
  BitsetHull surface_;
  std::vector<Vec3d> points_;
  std::set<std::size_t> alive_;
};

TEST(BitsetHull, StaysClosedAndConvex) {
  reference::Random random(21);
  for (int repeat = 0; repeat < 40; ++repeat) {
    // All on a sphere, or such as swallow vertices that came before.
    const double least = repeat % 2 == 0 ? 1 : 0.2;
    Grown grown;
    int in_vain = 0;
    while (grown.vertices() < BitsetHull::most_vertices && in_vain < 200) {
      in_vain += grown.add(random.uniform(least, 1) * random.direction()) ? 0 : 1;
      if (grown.vertices() % 8 == 0) grown.expect_sound();
    }
    grown.expect_sound();
    EXPECT_GT(grown.vertices(), 20u);
  }
}

TEST(BitsetHull, RefusesWhatIsNoDisc) {
  reference::Random random(22);
  Grown grown;
  while (grown.vertices() < 20) grown.add(random.direction());
  BitsetHull start = grown.surface();
  int refused = 0, taken = 0;
  for (int repeat = 0; repeat < 20000; ++repeat) {
    // Any faces: pieces that share nothing, a vertex or two, rings, all of it, none.
    BitsetHull surface = start;
    BitsetHull::Faces seen{};
    const int asked = random.below(8);
    std::vector<BitsetHull::Corners> faces;
    for (int k = 0; k < asked; ++k) {
      const auto face = static_cast<std::size_t>(random.below(static_cast<int>(start.faces())));
      if ((seen[0] >> face & 1) == 0) faces.push_back(start.corners(face));
      seen[0] |= std::uint64_t{1} << face;
    }
    // The edges on the rim, and whether the faces and the rim's vertices are each in one piece.
    std::set<std::pair<int, int>> rim;
    for (const auto& c : faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (rim.erase({c[(k + 1) % 3], c[k]}) == 0) rim.insert({c[k], c[(k + 1) % 3]});
      }
    }
    std::set<int> tails;
    for (const auto& [tail, head] : rim) tails.insert(tail);
    std::size_t walked = 0;
    if (!rim.empty()) {
      int at = rim.begin()->first;
      do {
        at = rim.lower_bound({at, 0})->second;
        ++walked;
      } while (at != rim.begin()->first && walked <= rim.size());
    }
    const bool disc = !rim.empty() && tails.size() == rim.size() && walked == rim.size();
    ASSERT_EQ(surface.add(seen), disc);
    (disc ? taken : refused) += 1;
    if (disc) continue;
    // A failed addition leaves no trace in the next polytope.
    surface.start();
    ASSERT_TRUE(surface.add({1, 0}));
    ASSERT_EQ(surface.cone().size, 3u);
  }
  EXPECT_GT(refused, 5000);
  EXPECT_GT(taken, 1000);
}

}  // namespace
}  // namespace touchstone::bitset_hull_test
