// Seeded frames of boxes for the peers' broad phases, the pairs by definition, and the comparison.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "algorithms/registry.h"

namespace touchstone {

inline std::vector<IndexPair> closed_pairs(std::span<const Aabb> boxes) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      if (overlap(boxes[i], boxes[j])) pairs.push_back({i, j});
    }
  }
  return pairs;
}

inline std::vector<IndexPair> sorted_pairs(BroadPhase& algorithm) {
  PairSink sink;
  EXPECT_EQ(algorithm.find_pairs(sink), Status::ok);
  std::vector<IndexPair> found = sink.gather();
  std::ranges::sort(found);
  return found;
}

inline bool only_touch(const Aabb& a, const Aabb& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.min[axis] == b.max[axis] || b.min[axis] == a.max[axis]) return true;
  }
  return false;
}

// How boxes are placed and how they move.
struct Style {
  std::string name;
  std::size_t count = 200;
  float world = 10;    // centres are in [0, world]^3, moved by offset
  float size = 1;      // greatest side
  float speed = 0.3F;  // greatest step of a coordinate in a frame
  float offset = 0;
  float grid = 0;          // coordinates are multiples of this where it is not 0
  bool rigid = false;      // sides stay as they are
  bool flat = false;       // all in the plane z = 0
  double moving = 1;       // part of the bodies that moves in a frame
  double teleporting = 0;  // part that goes anywhere
  double churn = 0;        // part that goes, and comes, in a frame
};

// Boxes that move, come and go. The array of the frame before stays alive.
class Frames {
 public:
  Frames(const Style& style, std::uint64_t seed) : style_(style), random_(seed) {
    for (std::size_t i = 0; i < style_.count; ++i) boxes_[0].push_back(fresh());
  }

  const std::vector<Aabb>& boxes() const { return boxes_[current_]; }

  FrameChange next() {
    std::vector<Aabb>& now = boxes_[1 - current_];
    now = boxes_[current_];
    current_ = 1 - current_;
    moved_.clear();
    inserted_.clear();
    removed_.clear();
    for (std::uint32_t id = 0; id < now.size(); ++id) {
      const Aabb before = now[id];
      if (before.is_empty()) {
        if (chance(style_.churn)) {
          now[id] = fresh();
          inserted_.push_back(id);
        }
      } else if (chance(style_.churn)) {
        now[id] = Aabb::empty();
        removed_.push_back(id);
      } else {
        if (chance(style_.teleporting)) {
          now[id] = fresh();
        } else if (chance(style_.moving)) {
          now[id] = step(before);
        }
        if (!(now[id] == before)) moved_.push_back(id);
      }
    }
    const auto more = static_cast<std::size_t>(std::ceil(style_.churn * 20));
    for (std::size_t i = 0; i < more; ++i) {
      inserted_.push_back(static_cast<std::uint32_t>(now.size()));
      now.push_back(fresh());
    }
    return {now, moved_, inserted_, removed_};
  }

 private:
  bool chance(double p) { return std::uniform_real_distribution<double>(0, 1)(random_) < p; }
  float between(float low, float high) {
    return low == high ? low : std::uniform_real_distribution<float>(low, high)(random_);
  }
  float snap(float x) const {
    return style_.grid > 0 ? style_.grid * std::round(x / style_.grid) : x;
  }
  Aabb fresh() {
    Aabb box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool thin = style_.flat && axis == 2;
      const float at = thin ? 0 : between(0, style_.world);
      box.min[axis] = snap(style_.offset + at);
      box.max[axis] =
          std::max(box.min[axis], snap(style_.offset + at + (thin ? 0 : between(0, style_.size))));
    }
    return box;
  }
  Aabb step(const Aabb& box) {
    Aabb moved = box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (style_.flat && axis == 2) continue;
      const float by = between(-style_.speed, style_.speed);
      const float more = style_.rigid ? by : by + between(-0.1F, 0.1F) * style_.size;
      moved.min[axis] = snap(box.min[axis] + by);
      moved.max[axis] = std::max(moved.min[axis], snap(box.max[axis] + more));
    }
    return moved;
  }

  Style style_;
  std::mt19937_64 random_;
  std::vector<Aabb> boxes_[2];
  int current_ = 0;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

inline std::vector<Style> styles() {
  return {
      {.name = "moving"},
      {.name = "rigid", .rigid = true},
      {.name = "few moving", .moving = 0.02},
      {.name = "touching", .world = 12, .size = 2, .speed = 1, .grid = 1},
      {.name = "touching, rigid", .world = 12, .size = 2, .speed = 1, .grid = 1, .rigid = true},
      {.name = "points", .world = 4, .size = 0, .speed = 1, .grid = 1},
      {.name = "coincident", .count = 60, .world = 0, .size = 1, .speed = 0.6F, .grid = 1},
      {.name = "flat", .size = 1, .flat = true},
      {.name = "mixed sizes", .size = 9, .speed = 2},
      {.name = "far away", .offset = 1e6F},
      {.name = "huge", .world = 1e30F, .size = 2e29F, .speed = 1e29F},
      {.name = "tiny", .world = 1e-30F, .size = 2e-31F, .speed = 1e-31F},
      {.name = "teleporting", .teleporting = 0.5},
      {.name = "drifting away", .speed = 20},
      {.name = "churn", .churn = 0.1},
      {.name = "churn, touching", .world = 12, .size = 2, .speed = 1, .grid = 1, .churn = 0.1},
      {.name = "churn, growing from one", .count = 1, .churn = 0.3},
      {.name = "none", .count = 0},
      {.name = "one", .count = 1},
      {.name = "two", .count = 2, .world = 1},
  };
}

// How many pairs there were, by definition, and how many were missed although they only touch.
struct Tally {
  std::size_t pairs = 0, possible = 0, missed_touching = 0;
};

// Plays the frames and compares every frame's pairs, as a list without repetition, with the
// definition. Pairs that only touch may be missed where `touching_may_be_missed`.
inline void play(const BroadPhaseEntry& entry, const Style& style, std::uint64_t seed,
                 bool touching_may_be_missed, Tally& tally) {
  SCOPED_TRACE(entry.info.name + ", " + style.name + ", seed " + std::to_string(seed));
  Frames frames(style, seed);
  Executor executor(1);
  const std::unique_ptr<BroadPhase> algorithm = entry.make(executor);
  PairSink sink;
  algorithm->build(frames.boxes());
  for (int frame = 0; frame < 15; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    if (frame == 9) {
      frames.next();
      algorithm->build(frames.boxes());
    } else if (frame > 0) {
      algorithm->update(frames.next());
    }
    ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
    std::vector<IndexPair> found = sink.gather();
    std::ranges::sort(found);
    ASSERT_EQ(std::ranges::adjacent_find(found), found.end()) << "a pair comes twice";
    const std::vector<Aabb>& boxes = frames.boxes();
    const std::vector<IndexPair> pairs = closed_pairs(boxes);
    tally.pairs += pairs.size();
    tally.possible += boxes.size() * (boxes.size() - (boxes.empty() ? 0 : 1)) / 2;
    std::vector<IndexPair> missing, extra;
    std::ranges::set_difference(pairs, found, std::back_inserter(missing));
    std::ranges::set_difference(found, pairs, std::back_inserter(extra));
    ASSERT_TRUE(extra.empty()) << extra.size() << " extra, as " << extra[0].a << " " << extra[0].b;
    for (const IndexPair& pair : missing) {
      ASSERT_TRUE(touching_may_be_missed && only_touch(boxes[pair.a], boxes[pair.b]))
          << missing.size() << " missing, as " << pair.a << " " << pair.b;
    }
    tally.missed_touching += missing.size();
  }
}

}  // namespace touchstone
