// Part of verlet-list: the displacement of boxes, its mean, and the growth by it.
#include "algorithms/broad_phase/verlet_list/box_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/core/executor/parallel_blocks.h"

namespace touchstone {
namespace {

// Returns twice the greatest displacement of the box's centre on an axis (metres).
float displacement(const Aabb& then, const Aabb& now) {
  float most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    most = std::max(most,
                    std::abs((now.min[axis] - then.min[axis]) + (now.max[axis] - then.max[axis])));
  }
  return most;
}

float longest_side(const Aabb& box) {
  return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
}

// The step between the samples of so many boxes: odd, since what alternates may move alike.
std::size_t stride_of(std::size_t boxes) {
  constexpr std::size_t enough = 128;
  return boxes / enough | 1;
}

class MotionSum {
 public:
  void add(const Aabb& then, const Aabb& now, int age) {
    if (now.is_empty() || then.is_empty()) return;
    const double step = displacement(then, now) / (2.0 * age);
    const double side = (double{now.max[0]} - now.min[0] + (double{now.max[1]} - now.min[1]) +
                         (double{now.max[2]} - now.min[2])) /
                        3;
    steps_ += step;
    shares_ += step > 0 ? std::min(1.0, step / (side + step)) : 0;
    ++bodies_;
  }
  MeanMotion mean() const {
    if (bodies_ == 0) return {};
    return {static_cast<float>(steps_ / bodies_), shares_ / bodies_};
  }

 private:
  double steps_ = 0, shares_ = 0, bodies_ = 0;
};

}  // namespace

MeanMotion mean_motion(std::span<const Aabb> then, std::span<const Aabb> now, int age) {
  const std::size_t count = std::min(now.size(), then.size());
  MotionSum sum;
  for (std::size_t i = 0; i < count; i += stride_of(count)) sum.add(then[i], now[i], age);
  return sum.mean();
}

MeanMotion mean_motion(const AabbSoA& then, std::span<const Aabb> now) {
  MotionSum sum;
  for (std::size_t i = 0; i < then.size(); i += stride_of(then.size())) {
    const Aabb box = then.box(i);
    if (!box.is_empty()) sum.add(box, now[then.ids()[i]], 1);
  }
  return sum.mean();
}

void grow_boxes(Executor& executor, std::span<const Aabb> now, std::vector<Aabb>& reference,
                int age, double frames, const MeanMotion& mean) {
  constexpr std::size_t block_size = 1024;
  const auto growth = static_cast<float>(frames);
  constexpr float most = std::numeric_limits<float>::max();  // finite, as all boxes are
  const auto share = static_cast<float>(mean.share);
  const std::size_t known = std::min(now.size(), reference.size());
  const float step_of = 0.5f / static_cast<float>(age);
  reference.resize(now.size(), Aabb::empty());
  for_each_block(
      executor, now.size(), block_size, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const Aabb& box = now[i];
          if (box.is_empty()) {
            reference[i] = Aabb::empty();
            continue;
          }
          const bool there = i < known && !reference[i].is_empty();
          // Bodies that hardly move may start to, the small ones not as far. The box of one that
          // leapt, or is fast for its size, would reach over many others.
          const float side = longest_side(box);
          const float least = growth * std::min(mean.step, share * side) / 2;
          const float way = there ? growth * (displacement(reference[i], box) * step_of) : 0;
          const float margin = way <= side ? std::max(way, least) : least;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            reference[i].min[axis] = std::max(box.min[axis] - margin, -most);
            reference[i].max[axis] = std::min(box.max[axis] + margin, most);
          }
        }
      });
}

}  // namespace touchstone
