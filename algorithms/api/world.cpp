// World: slots of bodies, their boxes in a broad phase, and the shapes among them in a ray cast.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/api/conversions.h"
#include "algorithms/core/bounds.h"

namespace touchstone::v1 {
namespace {

constexpr int most_threads = 1024;

void check_range(const Aabb& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isfinite(box.min[k]) && std::isfinite(box.max[k])) continue;
    throw Error("found a box beyond the range of floats; a half-space has no other");
  }
}

Aabb box_of(const Shape& shape, const Pose& pose) {
  touchstone::Pose placed;
  write_inner(pose, placed);
  const Aabb box = tight_box(data_of(shape).shape, placed);
  check_range(box);
  return box;
}

Aabb rounded(const Box& box) {
  const std::array<double, 3> min = {box.min.x, box.min.y, box.min.z},
                              max = {box.max.x, box.max.y, box.max.z};
  Aabb inner;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(min[k] <= max[k]))
      throw Error("found a box with NaN, or min > max; expected min <= max on each axis");
    inner.min[k] = round_down(min[k]);
    inner.max[k] = round_up(max[k]);
  }
  check_range(inner);
  return inner;
}

// A pair of slots as the broad phase writes it and as the interface has it.
static_assert(sizeof(IndexPair) == sizeof(touchstone::IndexPair) &&
              offsetof(IndexPair, b) == offsetof(touchstone::IndexPair, b));

}  // namespace

struct [[gnu::visibility("hidden")]] World::Parts {
  struct Slot {
    std::optional<Body> body;  // none: a box alone, or free
    bool is_used = false;
    bool was_used = false;  // at the last update
    bool is_changed = false;
  };

  explicit Parts(const WorldOptions& options)
      : executor(options.threads),
        broad_phase(
            entry_named<BroadPhaseEntry>(options.broad_phase, "broad phase").make(executor)) {}

  std::uint32_t slot_of(Handle handle) const {
    if (handle.slot < slots.size() && slots[handle.slot].is_used &&
        generations[handle.slot] == handle.generation) {
      return handle.slot;
    }
    throw Error("found a handle of no body: it was removed, or is of another world");
  }

  Handle insert(std::optional<Body> body, const Aabb& box) {
    std::uint32_t slot;
    if (free.empty()) {
      if (slots.size() == std::numeric_limits<std::uint32_t>::max())
        throw Error("a world has at most 2^32 - 1 bodies");
      slot = static_cast<std::uint32_t>(slots.size());
      slots.emplace_back();
      generations.push_back(0);
      next.push_back(Aabb::empty());
    } else {
      slot = free.back();
      free.pop_back();
      ++generations[slot];
    }
    slots[slot].body = std::move(body);
    slots[slot].is_used = true;
    ++used;
    change(slot, box);
    rays_stale = true;
    return {slot, generations[slot]};
  }

  void change(std::uint32_t slot, const Aabb& box) {
    next[slot] = box;
    if (slots[slot].is_changed) return;
    slots[slot].is_changed = true;
    changed.push_back(slot);
  }

  void update();
  SceneRayCast& placed_rays();

  Executor executor;
  std::unique_ptr<BroadPhase> broad_phase;
  std::vector<Slot> slots;
  std::vector<std::uint32_t> generations;
  std::size_t used = 0;
  // Free slots. A slot that was freed waits until the broad phase, and changes() where that is called, know that its
  // body went: a pair of its next body is another pair.
  std::vector<std::uint32_t> free, freed, told_free;
  bool tells_changes = false;

  // The boxes of the last update, which the broad phase reads, and those of the next.
  std::vector<Aabb> boxes, next;
  std::vector<std::uint32_t> changed, inserted, moved, removed;
  bool is_built = false;

  bool pairs_found = false;
  PairSink found, began, ended;
  std::vector<std::span<const IndexPair>> chunks;
  std::vector<HandlePair> began_handles, ended_handles;

  std::unique_ptr<SceneRayCast> ray_cast;
  bool rays_stale = true, rays_unplaced = false;  // since the tree was made or refitted
  std::vector<touchstone::SceneBody> ray_bodies;
  std::vector<touchstone::Pose> ray_poses;
  std::vector<touchstone::Ray> asked;
  std::vector<touchstone::SceneRayHit> hits;
};

World::World(const WorldOptions& options) {
  if (options.threads < 1 || options.threads > most_threads) {
    throw Error("found " + std::to_string(options.threads) + " threads; expected 1 to " +
                std::to_string(most_threads));
  }
  parts_ = std::make_unique<Parts>(options);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

World::Parts& World::parts() {
  if (!parts_) throw Error("this world was moved from; expected one that has a value");
  return *parts_;
}
const World::Parts& World::parts() const { return const_cast<World*>(this)->parts(); }

Handle World::insert(const Shape& shape, const Pose& pose) {
  check_pose(pose);
  return parts().insert(Body{shape, pose}, box_of(shape, pose));
}

Handle World::insert(const Box& box) { return parts().insert({}, rounded(box)); }

void World::move(Handle body, const Pose& pose) {
  Parts& parts = this->parts();
  const std::uint32_t slot = parts.slot_of(body);
  std::optional<Body>& moved = parts.slots[slot].body;
  if (!moved) throw Error("found a body without a shape; expected a new box for it");
  check_pose(pose);
  const Aabb box = box_of(moved->shape, pose);
  moved->pose = pose;
  parts.rays_unplaced = true;
  parts.change(slot, box);
}

void World::move(Handle body, const Box& box) {
  Parts& parts = this->parts();
  const std::uint32_t slot = parts.slot_of(body);
  if (parts.slots[slot].body) throw Error("found a body with a shape; expected a new pose for it");
  parts.change(slot, rounded(box));
}

void World::remove(Handle body) {
  Parts& parts = this->parts();
  const std::uint32_t slot = parts.slot_of(body);
  parts.change(slot, Aabb::empty());
  parts.slots[slot].body.reset();
  parts.slots[slot].is_used = false;
  parts.freed.push_back(slot);
  parts.rays_stale = true;
  --parts.used;
}

bool World::contains(Handle body) const noexcept {
  return parts_ && body.slot < parts_->slots.size() && parts_->slots[body.slot].is_used &&
         parts_->generations[body.slot] == body.generation;
}

std::size_t World::size() const noexcept { return parts_ ? parts_->used : 0; }

const Body& World::body(Handle body) const {
  const std::optional<Body>& found = parts().slots[parts().slot_of(body)].body;
  if (!found) throw Error("found a body without a shape; expected one with a shape");
  return *found;
}

void World::update() { parts().update(); }

void World::Parts::update() {
  // A slot that came and went since the last update has no place in the lists of a frame.
  bool from_scratch = !is_built;
  if (!std::ranges::is_sorted(changed)) std::ranges::sort(changed);
  inserted.clear();
  moved.clear();
  removed.clear();
  for (const std::uint32_t slot : changed) {
    Slot& one = slots[slot];
    one.is_changed = false;
    if (one.is_used && one.was_used) {
      moved.push_back(slot);
    } else if (one.is_used) {
      inserted.push_back(slot);
    } else if (one.was_used) {
      removed.push_back(slot);
    } else {
      from_scratch = true;
    }
    one.was_used = one.is_used;
  }
  std::swap(boxes, next);
  if (from_scratch) {
    broad_phase->build(boxes);
  } else {
    broad_phase->update({.boxes = boxes, .moved = moved, .inserted = inserted, .removed = removed});
  }
  is_built = true;
  pairs_found = false;
  next.resize(boxes.size(), Aabb::empty());
  for (const std::uint32_t slot : changed) next[slot] = boxes[slot];
  changed.clear();
  std::vector<std::uint32_t>& waiting = tells_changes ? told_free : free;
  waiting.insert(waiting.end(), freed.begin(), freed.end());
  freed.clear();
}

World::Pairs World::pairs() {
  Parts& parts = this->parts();
  if (parts.is_built && !parts.pairs_found) {
    if (parts.broad_phase->find_pairs(parts.found) != touchstone::Status::ok) {
      throw Error("the broad phase could not find all pairs: its store is full");
    }
    parts.chunks.clear();
    for (const PairBuffer& chunk : parts.found.chunks()) {
      parts.chunks.push_back(
          {reinterpret_cast<const IndexPair*>(chunk.pairs().data()), chunk.size()});
    }
    parts.pairs_found = true;
  }
  return {parts.chunks, parts.generations.data()};
}

World::Changes World::changes() {
  Parts& parts = this->parts();
  parts.began_handles.clear();
  parts.ended_handles.clear();
  if (!parts.is_built) return {};
  if (parts.broad_phase->find_changes(parts.began, parts.ended) != touchstone::Status::ok) {
    throw Error("the broad phase could not find all pairs: its store is full");
  }
  const auto write = [&](const PairSink& sink, std::vector<HandlePair>& handles) {
    for (const PairBuffer& chunk : sink.chunks()) {
      for (const touchstone::IndexPair& pair : chunk.pairs()) {
        handles.push_back(
            {{pair.a, parts.generations[pair.a]}, {pair.b, parts.generations[pair.b]}});
      }
    }
  };
  write(parts.began, parts.began_handles);
  write(parts.ended, parts.ended_handles);
  parts.tells_changes = true;
  parts.free.insert(parts.free.end(), parts.told_free.begin(), parts.told_free.end());
  parts.told_free.clear();
  return {parts.began_handles, parts.ended_handles};
}

SceneRayCast& World::Parts::placed_rays() {
  if (!ray_cast) ray_cast = registry::find<SceneRayCastEntry>("wide-bvh")->make();
  if (rays_stale || rays_unplaced) {
    ray_poses.resize(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) {
      ray_poses[i] = {};
      if (slots[i].body) write_inner(slots[i].body->pose, ray_poses[i]);
    }
  }
  if (rays_stale) {
    // A body of no part has no point.
    ray_bodies.assign(slots.size(), {});
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (!slots[i].body) continue;
      ray_bodies[i].body.parts.push_back(
          {.shape = data_of(slots[i].body->shape).shape, .pose = {}});
      ray_bodies[i].pose = ray_poses[i];
    }
    ray_cast->bind(ray_bodies);
  } else if (rays_unplaced) {
    ray_cast->place(ray_poses);
  }
  rays_stale = rays_unplaced = false;
  return *ray_cast;
}

RayHit World::ray(const Ray& ray) {
  RayHit hit;
  rays({&ray, 1}, {&hit, 1});
  return hit;
}

void World::rays(std::span<const Ray> rays, std::span<RayHit> hits) {
  Parts& parts = this->parts();
  if (hits.size() != rays.size()) {
    throw Error("found room for " + std::to_string(hits.size()) +
                " hits; expected as many as rays, " + std::to_string(rays.size()));
  }
  parts.asked.clear();
  for (const Ray& ray : rays) {
    const Vec3& way = ray.direction;
    if (!is_finite(ray.origin) || !is_finite(way) || (way.x == 0 && way.y == 0 && way.z == 0) ||
        std::isnan(ray.t_max)) {
      throw Error("found a ray with a number that is infinite or NaN, or without a direction");
    }
    parts.asked.push_back(
        {.origin = inner(ray.origin), .direction = inner(way), .t_max = ray.t_max});
  }
  parts.hits.assign(rays.size(), {});
  parts.placed_rays().cast(RayTask::closest, parts.asked, parts.hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const touchstone::SceneRayHit& found = parts.hits[i];
    hits[i] = {.hit = found.hit,
               .status = v1::outer(found.status),
               .body = {},
               .t = found.t,
               .normal = outer(found.normal)};
    if (found.hit) hits[i].body = {found.body, parts.generations[found.body]};
  }
}

}  // namespace touchstone::v1
