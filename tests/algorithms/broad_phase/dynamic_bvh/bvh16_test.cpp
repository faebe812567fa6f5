// The tree of 16 children a node, changed at random, against going through all bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include "algorithms/broad_phase/dynamic_bvh/bvh16.h"
#include "algorithms/broad_phase/dynamic_bvh/surface_area.h"
#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

using Random = std::mt19937_64;

class WideTrees : public testing::Test {
 protected:
  void TearDown() override { limit_isa(isa_of_machine()); }

  float unit() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
  Aabb box(float reach, float side) {
    Aabb made;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      made.min[axis] = reach * unit();
      made.max[axis] = made.min[axis] + side * unit();
    }
    return made;
  }
  void load(std::size_t count, float side) {
    bodies_.clear();
    tree_.start(count, count, true);
    for (std::uint32_t id = 0; id < count; ++id) {
      bodies_[id] = box(1, side);
      tree_.set(id, bodies_[id], id);
    }
    next_ = static_cast<std::uint32_t>(count);
    Executor executor(2);
    tree_.load(executor);
  }
  void insert(const Aabb& body) {
    tree_.make_room_for_ids(next_ + 1);
    tree_.insert(next_, body);
    bodies_[next_++] = body;
  }
  void expect_found(const Aabb& query) {
    tree_.make_room(scratch_);
    std::vector<std::uint32_t> truth;
    for (const auto& [id, body] : bodies_) {
      if (overlap(body, query)) truth.push_back(id);
    }
    const auto found = tree_.find(query, scratch_);
    std::vector<std::uint32_t> sorted(found.begin(), found.end());
    std::ranges::sort(sorted);
    ASSERT_EQ(sorted, truth);
    hits_ += truth.empty() ? 0 : 1;
    ++queries_;
  }

  Random random_{5};
  Bvh16 tree_;
  Bvh16Scratch scratch_;
  std::map<std::uint32_t, Aabb> bodies_;
  std::uint32_t next_ = 0;
  int hits_ = 0, queries_ = 0;
};

TEST_F(WideTrees, FindWhatOverlapsWhateverIsChanged) {
  std::size_t regrouped = 0, kept = 0;
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 300u, 4'000u}) {
    SCOPED_TRACE(count);
    for (const float side : {0.0f, 0.02f, 0.5f}) {
      for (const int insertions :
           {1, 5, 9}) {  // in ten changes, as many removals as there are left
        load(count, side);
        for (int changes = 0; changes < 3'000; ++changes) {
          const auto dice = static_cast<int>(random_() % 10);
          const Aabb fresh = box(1, side);
          if (bodies_.empty() || dice < insertions) {
            insert(fresh);
          } else {
            auto body = bodies_.lower_bound(static_cast<std::uint32_t>(random_() % next_));
            if (body == bodies_.end()) body = bodies_.begin();
            if (dice % 2 == 0) {
              tree_.remove(body->first);
              bodies_.erase(body);
            } else {
              tree_.move(body->first, fresh);
              body->second = fresh;
            }
          }
          // Not at every other load, for trees that are left to go bad.
          if (changes % 10 == 0 && count % 2 == 0) {
            const std::size_t now = tree_.rebuild_worn(300);
            EXPECT_LT(now, 300 + 256u);
            regrouped += now;
            kept += now == 0 ? 1 : 0;
          }
          if (changes % 50 == 0) expect_found(box(1, 0.2f));
        }
        for (int i = 0; i < 20; ++i) expect_found(box(1, 0.2f));
        for (const auto& [id, body] : bodies_) ASSERT_EQ(tree_.box_at(tree_.place_of(id)), body);
      }
    }
  }
  EXPECT_GT(hits_, queries_ / 4);
  EXPECT_LT(hits_, queries_);
  EXPECT_GT(regrouped, 10'000u);
  EXPECT_GT(kept, 1'000u);
}

// Bodies that wander leave a tree about as good as a new one, and no larger than is to be expected.
TEST_F(WideTrees, StayGoodWhereBodiesWander) {
  load(4'000, 0.02f);
  const auto leaf_surfaces = [&] {
    double sum = 0;
    for (std::size_t node = 0; node < tree_.nodes(); ++node) {
      if (!tree_.is_leaf(node)) continue;
      Aabb bounds = Aabb::empty();
      for (std::size_t place = node * Bvh16::fan; place < (node + 1) * Bvh16::fan; ++place) {
        if (tree_.boxes().ids()[place] != Bvh16::nobody) {
          bounds = united(bounds, tree_.box_at(place));
        }
      }
      sum += bounds.is_empty() ? 0 : surface(bounds);
    }
    return sum;
  };
  // In an order along a curve, as it is to be loaded; the first one is of boxes at random.
  const auto reload = [&] {
    tree_.start(bodies_.size(), bodies_.size(), true);
    std::vector<std::uint32_t> order;
    for (const auto& [id, body] : bodies_) order.push_back(id);
    const auto cell = [&](std::uint32_t id, std::size_t axis) {
      return static_cast<int>(6 * bodies_[id].min[axis]);
    };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      for (const std::size_t axis : {0u, 1u}) {
        if (cell(a, axis) != cell(b, axis)) return cell(a, axis) < cell(b, axis);
      }
      return bodies_[a].min[2] < bodies_[b].min[2];
    });
    for (std::size_t i = 0; i < order.size(); ++i) tree_.set(i, bodies_[order[i]], order[i]);
    Executor executor(1);
    tree_.load(executor);
  };
  reload();
  const double at_first = leaf_surfaces();
  const std::size_t bytes = tree_.held_bytes();
  for (int frame = 0; frame < 1'000; ++frame) {
    for (int i = 0; i < 100; ++i) {
      const auto id = static_cast<std::uint32_t>(random_() % 4'000);
      Aabb& body = bodies_[id];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float by = 0.1f * (unit() - 0.5f);
        if (body.min[axis] + by < 0 || body.max[axis] + by > 1) continue;
        body.min[axis] += by;
        body.max[axis] += by;
      }
      tree_.move(id, body);
    }
    tree_.rebuild_worn(400);
  }
  EXPECT_LT(leaf_surfaces(), 2 * at_first);
  EXPECT_LT(tree_.held_bytes(), 2 * bytes);
  for (int i = 0; i < 100; ++i) expect_found(box(1, 0.2f));
}

TEST_F(WideTrees, BearExtremes) {
  constexpr float most = std::numeric_limits<float>::max();
  load(100, 0.1f);
  for (int i = 0; i < 60; ++i) {
    const float values[] = {-most, -1e30f, -0.0f, 0.0f, 1e-44f, 1, most};
    Aabb body;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax(values[random_() % 7], values[random_() % 7]);
      body.min[axis] = low;
      body.max[axis] = high;
    }
    insert(body);
    if (i % 10 == 0) tree_.rebuild_worn(400);
    expect_found(body);
  }
}

TEST_F(WideTrees, FindTheSameInTheSameOrderAtEveryLevel) {
  load(3'000, 0.1f);
  for (int i = 0; i < 100; ++i) {
    const Aabb query = box(1, 0.3f);
    std::vector<std::vector<std::uint32_t>> found;
    for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      limit_isa(level);
      tree_.make_room(scratch_);
      const auto ids = tree_.find(query, scratch_);
      found.emplace_back(ids.begin(), ids.end());
    }
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
  }
}

}  // namespace
}  // namespace touchstone
