// Computes the boxes of bodies, frame by frame.
#include "harness/trade/pipeline/body_boxes.h"

#include <algorithm>
#include <cstring>

#include "algorithms/core/bounds.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t bodies_a_task = 256;

void include(Aabb& all, const Aabb& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.min[axis] = std::min(all.min[axis], box.min[axis]);
    all.max[axis] = std::max(all.max[axis], box.max[axis]);
  }
}

bool holds(const Aabb& outer, const Aabb& inner) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(outer.min[axis] <= inner.min[axis] && inner.max[axis] <= outer.max[axis])) return false;
  }
  return true;
}

Aabb grown(const Aabb& box, double margin) {
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    longest =
        std::max(longest, static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis]));
  }
  Aabb fat;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fat.min[axis] = round_down(static_cast<double>(box.min[axis]) - margin * longest);
    fat.max[axis] = round_up(static_cast<double>(box.max[axis]) + margin * longest);
  }
  return fat;
}

}  // namespace

BodyBoxes::BodyBoxes(const SceneFrames& frames, const StandIns& stand_ins, BoxChoice choice,
                     Executor& executor)
    : frames_(&frames), stand_ins_(&stand_ins), choice_(choice), executor_(&executor) {}

Aabb BodyBoxes::box_of(const SceneFrame& frame, std::uint32_t body) const {
  const StandIn& stand_in = *stand_ins_->of[body];
  if (stand_in.tree.is_plane()) {
    const auto at = std::ranges::lower_bound(frame.halfspaces, body, {},
                                             [](const auto& halfspace) { return halfspace.first; });
    return at->second;
  }
  const Pose& pose = frame.poses[body];
  if (choice_.kind == BoxChoice::Kind::loose) {
    const bool alone = stand_in.parts.size() == 1;
    return loose_box(stand_in.reach,
                     alone ? pose(stand_in.parts[0].pose.translation) : pose.translation);
  }
  if (stand_in.plain) return tight_box(stand_in.parts[0].shape, pose);
  Aabb all = Aabb::empty();
  for (const proxies::Part& part : stand_in.outline) {
    include(all, tight_box(part.shape, placed(pose, part.pose)));
  }
  return all;
}

Aabb BodyBoxes::next_box(const SceneFrame& frame, std::uint32_t body, const Aabb& before) const {
  if (frame.present[body] == 0) return Aabb::empty();
  const Aabb box = box_of(frame, body);
  if (choice_.kind != BoxChoice::Kind::fat || stand_ins_->of[body]->tree.is_plane()) return box;
  return !before.is_empty() && holds(before, box) ? before : grown(box, choice_.margin);
}

void BodyBoxes::start(std::size_t number) {
  const SceneFrame& frame = frames_->frames[number];
  const std::size_t bodies = frames_->scene->bodies.size();
  std::vector<Aabb>& boxes = boxes_[current_];
  boxes.assign(bodies, Aabb::empty());
  executor_->run((bodies + bodies_a_task - 1) / bodies_a_task, [&](std::size_t task, int) {
    const std::size_t end = std::min(bodies, (task + 1) * bodies_a_task);
    for (std::size_t i = task * bodies_a_task; i < end; ++i) {
      const auto body = static_cast<std::uint32_t>(i);
      boxes[i] = next_box(frame, body, Aabb::empty());
    }
  });
  computed_ += static_cast<std::int64_t>(bodies);
  boxes_[1 - current_] = boxes;
  moved_.clear();
  inserted_.clear();
  removed_.clear();
}

void BodyBoxes::advance(std::size_t number) {
  const SceneFrame& frame = frames_->frames[number];
  const std::vector<std::uint32_t>& movers = frames_->movers;
  const std::vector<Aabb>& before = boxes_[current_];
  current_ = 1 - current_;
  std::vector<Aabb>& now = boxes_[current_];
  executor_->run((movers.size() + bodies_a_task - 1) / bodies_a_task, [&](std::size_t task, int) {
    const std::size_t end = std::min(movers.size(), (task + 1) * bodies_a_task);
    for (std::size_t i = task * bodies_a_task; i < end; ++i) {
      now[movers[i]] = next_box(frame, movers[i], before[movers[i]]);
    }
  });
  computed_ += static_cast<std::int64_t>(movers.size());
  moved_.clear();
  inserted_.clear();
  removed_.clear();
  for (const std::uint32_t body : movers) {
    const bool was = !before[body].is_empty(), is = !now[body].is_empty();
    if (was && !is) removed_.push_back(body);
    if (!was && is) inserted_.push_back(body);
    if (was && is && std::memcmp(&before[body], &now[body], sizeof(Aabb)) != 0) {
      moved_.push_back(body);
    }
  }
}

}  // namespace touchstone::trade
