// Bodies that move, come and go at random, for tests of frames that follow each other.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algorithms/broad_phase.h"
#include "tests/algorithms/broad_phase/box_sets.h"

namespace touchstone {

// Shares of the bodies in a frame, and how far those that move do.
struct Unrest {
  std::string name;
  float moved = 0, reach = 0, teleported = 0, inserted = 0, removed = 0;
};

inline const Unrest unrests[] = {
    {.name = "at rest"},
    {.name = "a few move", .moved = 0.03f, .reach = 0.02f},
    {.name = "a few go far", .moved = 0.03f, .reach = 0.2f},
    {.name = "half moves", .moved = 0.5f, .reach = 0.004f},
    {.name = "all move", .moved = 1, .reach = 0.05f},
    {.name = "teleports", .moved = 0.02f, .reach = 0.01f, .teleported = 0.01f},
    {.name = "churn",
     .moved = 0.03f,
     .reach = 0.03f,
     .teleported = 0.005f,
     .inserted = 0.01f,
     .removed = 0.01f},
    {.name = "much churn", .moved = 0.1f, .reach = 0.02f, .inserted = 0.2f, .removed = 0.1f},
};

class UnrestfulBodies {
 public:
  explicit UnrestfulBodies(std::size_t count) : boxes_(uniform_boxes(random_, count, 0.15f)) {}

  std::span<const Aabb> boxes() const { return boxes_; }
  FrameChange next(const Unrest& unrest) {
    moved_.clear(), inserted_.clear(), removed_.clear();
    for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
      const Aabb before = boxes_[id];
      change(boxes_[id], unrest);
      if (boxes_[id] == before) continue;
      (before.is_empty() ? inserted_ : boxes_[id].is_empty() ? removed_ : moved_).push_back(id);
    }
    if (unrest.inserted > 0) {  // and a new id
      inserted_.push_back(static_cast<std::uint32_t>(boxes_.size()));
      boxes_.push_back(uniform_boxes(random_, 1, 0.15f)[0]);
    }
    return {boxes_, moved_, inserted_, removed_};
  }

 private:
  void change(Aabb& box, const Unrest& unrest) {
    float dice = uniform(random_, 0, 1);
    if (box.is_empty()) {
      if (dice < unrest.inserted) box = uniform_boxes(random_, 1, 0.15f)[0];
    } else if ((dice -= unrest.removed) < 0) {
      box = Aabb::empty();
    } else if ((dice -= unrest.teleported) < 0) {
      box = uniform_boxes(random_, 1, 0.15f)[0];
    } else if ((dice -= unrest.moved) < 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float by = uniform(random_, -unrest.reach, unrest.reach);
        box.min[axis] += by;
        box.max[axis] = std::max(box.min[axis], box.max[axis] + by);
      }
    }
  }

  Random random_{61};
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

}  // namespace touchstone
