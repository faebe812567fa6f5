// Wide BVH: a tree over the parts of all bodies, and trees within meshes.
// Paper:   Wald, Benthin, Boulos, "Getting rid of packets", RT 2008 (wide nodes); Kay, Kajiya, "Ray
//          tracing complex scenes", SIGGRAPH 1986 (slabs); Parker et al., "OptiX", TOG 29, 2010 (a tree of
//          placed trees).
// Steps:   1. `bind` makes an item of each mesh and of each convex part, with its box in the world, and
//             builds a tree over the boxes. Items without bounds, such as half-spaces, stay outside of it.
//          2. A ray meets a node's eight boxes at once, and walks the children from near to far.
//          3. An item gets the ray in its own coordinates: a convex shape by its stretch of the line, a
//             mesh by the walk of `wide-bvh` (kernels/rays), which loses no ray between triangles.
//          4. `place` computes the items' boxes again and refits the tree.
// Departs: boxes of items are those of a broad phase, in floats and rounded outward.
// Fails:   rounding decides rays that pass a convex shape, or the outline of a turned mesh, within some
//          units of the last place of its size and distance. An item whose matrix has no inverse makes every ray `unsupported`, and a solid
//          hull without faces those `degenerate` that come to it.
// Cost:    O(log n) a ray where bodies are small; 60 bytes an item besides meshes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <vector>

#include "algorithms/core/bounds.h"
#include "algorithms/kernels/bvh/wide_bvh.h"
#include "algorithms/kernels/rays/convex_ray.h"
#include "algorithms/kernels/rays/ray_walk.h"
#include "algorithms/scene_ray_cast.h"
#include "algorithms/scene_ray_cast/wide_bvh/scene_slabs.h"

namespace touchstone {
namespace {

// The box with margins for poses that are multiplied in doubles, and so that a flat box has an inside, in
// which a ray along it is.
Aabb widened(Aabb box) {
  float size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    size = std::max({size, std::abs(box.min[k]), std::abs(box.max[k])});
  }
  const float margin = size * 0x1p-22F + 0x1p-60F;
  for (std::size_t k = 0; k < 3; ++k) {
    box.min[k] -= margin;
    box.max[k] += margin;
  }
  return box;
}

bool is_bounded(const Aabb& box) {
  return std::ranges::all_of(box.min, [](float x) { return std::isfinite(x); }) &&
         std::ranges::all_of(box.max, [](float x) { return std::isfinite(x); });
}

// True for a solid hull without faces: see make_hull.
bool has_no_faces(const Shape& shape) {
  return shape.kind == ShapeKind::hull && shape.hull->dimension == 3 && shape.hull->faces.empty();
}

Aabb box_of(const TriangleMesh& mesh, const Pose& pose) {
  Aabb box = Aabb::empty();
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t number : triangle) {
      const Vec3d at = pose(mesh.vertices[number]);
      for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], round_down(at[static_cast<Eigen::Index>(k)]));
        box.max[k] = std::max(box.max[k], round_up(at[static_cast<Eigen::Index>(k)]));
      }
    }
  }
  return box;
}

// A mesh or a convex part, and how rays come to its coordinates.
struct Item {
  std::uint32_t body = 0, part = 0;
  const Shape* shape = nullptr;  // null: a mesh
  const TriangleMesh* triangles = nullptr;
  std::shared_ptr<const ray_tree::RayMesh> mesh;
  Pose within;  // from the item's coordinates to the body's
  Mat3d to_item = Mat3d::Identity();
  Vec3d origin = Vec3d::Zero();  // of the item in the world
};

class WideBvhSceneCast final : public SceneRayCast {
 public:
  void bind(std::span<const SceneBody> bodies) override {
    items_.clear();
    shapes_of_.clear();
    std::vector<Pose> poses;
    for (std::uint32_t b = 0; b < bodies.size(); ++b) {
      const ConcaveBody& body = bodies[b].body;
      poses.push_back(bodies[b].pose);
      if (body.mesh) {
        Item item;
        item.body = b;
        item.triangles = body.mesh.get();
        item.mesh = tree_of(*body.mesh);
        items_.push_back(item);
      }
      for (std::uint32_t p = 0; p < body.parts.size(); ++p) {
        shapes_of_.push_back(body.parts[p].shape);
        Item item;
        item.body = b;
        item.part = p;
        item.within = body.parts[p].pose;
        items_.push_back(item);
      }
    }
    // The shapes lie still from here on.
    std::size_t next = 0;
    for (Item& item : items_) {
      if (!item.mesh) item.shape = &shapes_of_[next++];
    }
    meshes_.clear();
    set_poses(poses);
    std::vector<Aabb> boxes = boxes_;
    unbounded_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (is_bounded(boxes[i])) continue;
      if (!boxes[i].is_empty()) unbounded_.push_back(i);
      boxes[i] = boxes_[i] = Aabb::empty();
    }
    tree_ = build_wide_bvh(boxes);
  }

  void place(std::span<const Pose> poses) override {
    set_poses(poses);
    std::vector<std::uint32_t> unbounded;
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      if (is_bounded(boxes_[i])) continue;
      if (!boxes_[i].is_empty()) unbounded.push_back(i);
      boxes_[i] = Aabb::empty();
    }
    unbounded_ = std::move(unbounded);
    refit(tree_, boxes_);
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<SceneRayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = answer(task, rays[i]);
  }

 private:
  std::shared_ptr<const ray_tree::RayMesh> tree_of(const TriangleMesh& mesh) {
    for (const auto& [known, tree] : meshes_) {
      if (known == &mesh) return tree;
    }
    meshes_.emplace_back(&mesh, std::make_shared<ray_tree::RayMesh>(mesh, Precision::float64));
    return meshes_.back().second;
  }

  void set_poses(std::span<const Pose> poses) {
    boxes_.resize(items_.size());
    has_inverse_ = true;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      Item& item = items_[i];
      const Pose& body = poses[item.body];
      const Pose pose{body.rotation * item.within.rotation, body(item.within.translation)};
      item.to_item = pose.rotation.inverse();
      item.origin = pose.translation;
      has_inverse_ &= item.to_item.allFinite();
      boxes_[i] = widened(item.mesh ? box_of(*item.triangles, pose) : tight_box(*item.shape, pose));
    }
  }

  SceneRayHit answer(RayTask task, const Ray& ray) const {
    SceneRayHit hit;
    hit.status = !is_proper(ray) ? Status::degenerate
                 : has_inverse_  ? Status::ok
                                 : Status::unsupported;
    if (hit.status != Status::ok || !(ray.t_max >= 0)) return hit;
    Ray left = ray;  // what may still be first
    for (const std::uint32_t i : unbounded_) {
      if (offer(task, i, left, hit) && task == RayTask::any) return hit;
    }
    if (!tree_.nodes.empty()) walk(task, left, hit);
    return hit;
  }

  struct Met {
    double near;
    std::int32_t child;
  };

  void walk(RayTask task, Ray& left, SceneRayHit& hit) const {
    const SceneSlabs slabs(left);
    std::array<Met, WideBvh::most_open> stack;
    std::size_t open = 0;
    stack[open++] = {0, 0};
    std::array<double, 8> begin;
    while (open > 0) {
      const Met now = stack[--open];
      if (now.near > left.t_max * (1 + 0x1p-49)) continue;
      if (WideNode::is_leaf(now.child)) {
        for (const std::uint32_t i : tree_.leaf(WideNode::leaf(now.child))) {
          if (boxes_[i].is_empty()) continue;
          if (offer(task, i, left, hit) && task == RayTask::any) return;
        }
        continue;
      }
      const WideNode& node = tree_.nodes[static_cast<std::size_t>(now.child)];
      const std::size_t first = open;
      for (unsigned bits = slabs.meet(node, left.t_max, begin); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        if (node.child[lane] == WideNode::no_child) continue;
        std::size_t place = open++;
        for (; place > first && stack[place - 1].near < begin[lane]; --place) {
          stack[place] = stack[place - 1];
        }
        stack[place] = {begin[lane], node.child[lane]};
      }
    }
  }

  // Tests an item. A hit becomes the first, and nothing beyond it matters any more.
  bool offer(RayTask task, std::uint32_t number, Ray& left, SceneRayHit& best) const {
    const Item& item = items_[number];
    const Ray local{item.to_item * (left.origin - item.origin), item.to_item * left.direction,
                    left.t_max};
    if (!is_proper(local)) {
      best.status = Status::degenerate;
      return false;
    }
    Vec3d normal;
    std::uint32_t part = item.part;
    double t = 0;
    if (item.mesh) {
      RayHit hit;
      ray_tree::cast_each(*item.mesh, task, {&local, 1}, {&hit, 1});
      if (hit.status != Status::ok) best.status = hit.status;
      if (!hit.hit) return false;
      part = hit.triangle;
      t = hit.t;
      const auto [a, b, c] = item.mesh->corners(part);
      normal = (b - a).cross(c - a);
      if (normal.dot(local.direction) > 0) normal = -normal;
      if (normal.isZero(0)) normal.setConstant(Outcome::none);
    } else {
      if (has_no_faces(*item.shape)) {
        best.status = Status::degenerate;
        return false;
      }
      const auto hit = first_hit(*item.shape, local);
      if (!hit) return false;
      t = hit->t;
      normal = hit->normal;
    }
    if (best.hit && !(t < best.t)) return false;
    best.hit = true;
    best.body = item.body;
    best.part = part;
    best.t = t;
    // Normals go with the inverse's transpose.
    best.normal = (item.to_item.transpose() * normal).stableNormalized();
    left.t_max = t;
    return true;
  }

  std::vector<Item> items_;
  std::vector<Shape> shapes_of_;  // of the convex parts, in the items' order
  std::vector<std::pair<const TriangleMesh*, std::shared_ptr<const ray_tree::RayMesh>>> meshes_;
  std::vector<Aabb> boxes_;               // of the items; empty for those outside of the tree
  std::vector<std::uint32_t> unbounded_;  // the items outside of the tree
  bool has_inverse_ = true;
  WideBvh tree_;
};

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<SceneRayCastEntry> scene_ray_cast_wide_bvh() {
  return {
      {.info = {.name = "wide-bvh",
                .citation = "Wald, Benthin, Boulos, RT 2008; Kay, Kajiya, SIGGRAPH 1986; Parker "
                            "et al., TOG 29, 2010"},
       .tasks = {RayTask::closest, RayTask::any},
       .make = [] { return std::make_unique<WideBvhSceneCast>(); }}};
}

}  // namespace touchstone::entries
