// Computes the boxes of each frame and lists what changed.
#include "harness/scene/player.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "algorithms/core/bounds.h"
#include "harness/scene/concave_shape.h"

namespace touchstone::scene {
namespace {

bool same_bits(const Aabb& a, const Aabb& b) { return std::memcmp(&a, &b, sizeof(Aabb)) == 0; }

void include(Aabb& region, const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float end : {box.min[axis], box.max[axis]}) {
      if (!std::isfinite(end)) continue;
      region.min[axis] = std::min(region.min[axis], end);
      region.max[axis] = std::max(region.max[axis], end);
    }
  }
}

// The reach must hold for every orientation of a rotating body, although each is orthonormal only
// up to rounding.
double reach_of(const Scene& scene, const Body& body) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  const Shape& shape = scene.shapes[body.shape];
  const ConcaveBody* concave = scene.concave_of(body.shape);
  const double reach = concave != nullptr ? concave_reach(*concave, shape, body.pose.rotation)
                                          : loose_reach(shape, body.pose.rotation);
  return reach * (1 + rounding);
}

}  // namespace

std::string_view to_string(BoxKind kind) { return kind == BoxKind::tight ? "tight" : "loose"; }

ScenePlayer::ScenePlayer(const Scene& scene, BoxKind kind)
    : scene_(&scene), kind_(kind), kinematics_(scene) {
  if (!scene.recording.empty()) {
    boxes_[0] = scene.recording.front();
    return;
  }
  if (kind == BoxKind::loose) {
    reach_.reserve(scene.bodies.size());
    for (const Body& body : scene.bodies) {
      reach_.push_back(reach_of(scene, body));
    }
  }
  fill_world();
  boxes_[0].resize(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) boxes_[0][i] = box_of(i);
}

// Half-spaces need the whole region in advance, so their scenes are played once before; others are
// not.
void ScenePlayer::fill_world() {
  const auto& bodies = scene_->bodies;
  const auto is_halfspace = [&](const Body& body) {
    return scene_->shapes[body.shape].kind == ShapeKind::halfspace;
  };
  if (std::none_of(bodies.begin(), bodies.end(), is_halfspace)) return;
  Aabb region = Aabb::empty();
  for (;;) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].moving || kinematics_.frame() == 0) include(region, box_of(i));
    }
    if (kinematics_.frame() + 1 >= scene_->frames) break;
    kinematics_.next();
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (region.min[axis] > region.max[axis]) region.min[axis] = region.max[axis] = 0;
  }
  world_ = region;
  kinematics_ = Kinematics(*scene_);
}

Aabb ScenePlayer::box_of(std::size_t body) const {
  const std::uint32_t number = scene_->bodies[body].shape;
  const Shape& shape = scene_->shapes[number];
  const Pose& pose = kinematics_.poses()[body];
  if (shape.kind != ShapeKind::halfspace) {
    if (kind_ == BoxKind::loose) return loose_box(reach_[body], pose.translation);
    const ConcaveBody* concave = scene_->concave_of(number);
    return concave != nullptr ? concave_box(*concave, shape, pose) : tight_box(shape, pose);
  }
  Aabb box = tight_box(shape, pose);
  if (world_.is_empty()) return box;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isinf(box.min[axis])) box.min[axis] = world_.min[axis];
    if (std::isinf(box.max[axis])) box.max[axis] = world_.max[axis];
  }
  return box;
}

bool ScenePlayer::next() {
  const bool recorded = !scene_->recording.empty();
  const int frames = recorded ? static_cast<int>(scene_->recording.size()) : scene_->frames;
  if (frame_ + 1 >= frames) return false;
  ++frame_;
  const std::vector<Aabb>& before = boxes_[current_];
  current_ = 1 - current_;
  std::vector<Aabb>& now = boxes_[current_];
  if (recorded) {
    now = scene_->recording[static_cast<std::size_t>(frame_)];
  } else {
    kinematics_.next();
    now.resize(scene_->bodies.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      now[i] = !kinematics_.is_present(i) ? Aabb::empty()
               : scene_->bodies[i].moving ? box_of(i)
                                          : before[i];  // bodies that arrive are moving ones
    }
  }
  list_changes(before, now);
  return true;
}

void ScenePlayer::list_changes(std::span<const Aabb> before, std::span<const Aabb> now) {
  moved_.clear();
  inserted_.clear();
  removed_.clear();
  for (std::uint32_t i = 0; i < now.size(); ++i) {
    const bool was = i < before.size() && !before[i].is_empty();
    const bool is = !now[i].is_empty();
    if (was && !is) removed_.push_back(i);
    if (!was && is) inserted_.push_back(i);
    if (was && is && !same_bits(before[i], now[i])) moved_.push_back(i);
  }
}

}  // namespace touchstone::scene
