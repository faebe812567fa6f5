// The tree of 16 children a node, changed at random, against going through all bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/wide_tree.h"

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
    BoxArrays& arrays = tree_.start(count);
    for (std::uint32_t id = 0; id < count; ++id) {
      bodies_[id] = box(1, side);
      arrays.set(id, bodies_[id], id);
    }
    next_ = static_cast<std::uint32_t>(count);
    Executor executor(2);
    tree_.load(executor, std::max<std::size_t>(count, 1));
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
  WideTree tree_;
  WideTreeScratch scratch_;
  std::map<std::uint32_t, Aabb> bodies_;
  std::uint32_t next_ = 0;
  int hits_ = 0, queries_ = 0;
};

TEST_F(WideTrees, FindWhatOverlapsWhateverIsChanged) {
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 300u, 4'000u}) {
    SCOPED_TRACE(count);
    for (const float side : {0.0f, 0.02f, 0.5f}) {
      for (const int insertions :
           {1, 5, 9}) {  // in ten changes, as many removals as there are left
        load(count, side);
        int changes = 0;
        for (; changes < 3'000 && tree_.has_room_for(1); ++changes) {
          const auto dice = static_cast<int>(random_() % 10);
          const Aabb fresh = box(1, side);
          if (bodies_.empty() || dice < insertions) {
            tree_.make_room_for_ids(next_ + 1);
            tree_.insert(next_, fresh);
            bodies_[next_++] = fresh;
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
          if (changes % 50 == 0) expect_found(box(1, 0.2f));
        }
        for (int i = 0; i < 20; ++i) expect_found(box(1, 0.2f));
        for (const auto& [id, body] : bodies_) ASSERT_EQ(tree_.box_at(tree_.place_of(id)), body);
      }
    }
  }
  EXPECT_GT(hits_, queries_ / 4);
  EXPECT_LT(hits_, queries_);
}

// Room is for at least as many insertions as the loader's rule counts on, in the worst place too.
TEST_F(WideTrees, HaveRoomForWhatTheyPromise) {
  for (const std::size_t count : {0u, 16u, 256u, 4'096u}) {
    for (const bool one_place : {false, true}) {
      load(count, 0.01f);
      std::size_t promised = 0;
      while (tree_.has_room_for(promised + 1)) ++promised;
      EXPECT_GE(promised, count / 16 / 2);
      for (std::size_t i = 0; i < promised; ++i) {
        // Into each leaf once, or all into one.
        const std::size_t leaf = i % std::max<std::size_t>(1, count / 16);
        const Aabb body = one_place || count == 0 ? box(0.01f, 0.01f)
                                                  : bodies_[static_cast<std::uint32_t>(leaf * 16)];
        tree_.make_room_for_ids(next_ + 1);
        tree_.insert(next_, body);
        bodies_[next_++] = body;
      }
      EXPECT_TRUE(tree_.has_room_for(0));
      for (int i = 0; i < 10; ++i) expect_found(box(1, 0.2f));
    }
  }
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
    if (tree_.has_room_for(1)) {
      tree_.make_room_for_ids(next_ + 1);
      tree_.insert(next_, body);
      bodies_[next_++] = body;
    }
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
