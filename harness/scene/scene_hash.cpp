// The hash of a scene, over its parameters and all poses.
#include <bit>

#include "harness/base/hash.h"
#include "harness/scene/kinematics.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {
namespace {

// A chain of mix(): each word changes all later states.
class Hash {
 public:
  void add(std::uint64_t word) { state_ = base::mix(state_ ^ word); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3d& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Pose& pose) {
    for (int i = 0; i < 9; ++i) add(pose.rotation(i / 3, i % 3));
    add(pose.translation);
  }
  void add(const Aabb& box) {
    for (int i = 0; i < 3; ++i) {
      const auto low = std::bit_cast<std::uint32_t>(box.min[static_cast<std::size_t>(i)]);
      const auto high = std::bit_cast<std::uint32_t>(box.max[static_cast<std::size_t>(i)]);
      add((std::uint64_t{low} << 32) | high);
    }
  }
  // Adds the numbers that the kind uses. A hull is its vertices; the rest follows from them.
  void add(const Shape& shape) {
    add(static_cast<std::uint64_t>(shape.kind));
    switch (shape.kind) {
      case ShapeKind::sphere: add(shape.radius); break;
      case ShapeKind::capsule:
      case ShapeKind::cylinder:
      case ShapeKind::cone:
        add(shape.radius);
        add(shape.half_length);
        break;
      case ShapeKind::box: add(shape.half_extents); break;
      case ShapeKind::ellipsoid: add(shape.radii); break;
      case ShapeKind::hull:
        add(std::uint64_t{shape.hull->vertices.size()});
        for (const Vec3d& vertex : shape.hull->vertices) add(vertex);
        break;
      case ShapeKind::halfspace:
        add(shape.normal);
        add(shape.offset);
        break;
    }
  }
  // Adds the triangles, or the parts with their places.
  void add(const ConcaveBody& body) {
    add(std::uint64_t{body.part_count()} * 4 + (body.mesh == nullptr ? 0
                                                : body.mesh->solid   ? 2
                                                                     : 1));
    if (body.mesh != nullptr) {
      add(std::uint64_t{body.mesh->vertices.size()});
      for (const Vec3d& vertex : body.mesh->vertices) add(vertex);
      for (const auto& [a, b, c] : body.mesh->triangles) {
        add((std::uint64_t{a} << 32) | b);
        add(std::uint64_t{c});
      }
    }
    for (const ConvexPart& part : body.parts) {
      add(part.shape);
      add(part.pose);
    }
    for (const CompoundSurface& surface : body.surfaces) {
      add(std::uint64_t{surface.first} * 2 + (surface.mesh->solid ? 1 : 0));
    }
  }
  void add(const Motion& motion) {
    add(static_cast<std::uint64_t>(motion.kind));
    add(motion.time_step);
    add(motion.acceleration);
    add(motion.period);
    add(motion.speed);
    add(motion.seed);
    add(motion.wall_min);
    add(motion.wall_max);
    if (motion.teleports == 0 && motion.churn == 0) return;
    add(std::uint64_t{motion.teleports});
    add(std::uint64_t{motion.churn});
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace

// The hash includes the parameters and the resulting poses: scenes with different parameters differ
// even if their frames agree, and so do scenes that are played differently.
std::string scene_hash(const Scene& scene) {
  Hash hash;
  if (!scene.recording.empty()) {
    hash.add(std::uint64_t{scene.recording.size()});
    hash.add(std::uint64_t{scene.size()});
    for (const auto& frame : scene.recording) {
      for (const Aabb& box : frame) hash.add(box);
    }
    return base::to_hex(hash.value());
  }
  hash.add(std::uint64_t{scene.shapes.size()});
  for (const Shape& shape : scene.shapes) hash.add(shape);
  for (std::size_t i = 0; i < scene.concave.size(); ++i) {
    if (scene.concave[i] == nullptr) continue;
    hash.add(std::uint64_t{i});
    hash.add(*scene.concave[i]);
  }
  hash.add(std::uint64_t{scene.bodies.size()});
  hash.add(static_cast<std::uint64_t>(scene.frames));
  hash.add(scene.motion);
  for (const Body& body : scene.bodies) {
    hash.add(std::uint64_t{body.shape} * 2 + (body.moving ? 1 : 0));
    hash.add(body.pose);
    hash.add(body.velocity);
    hash.add(body.angular_velocity);
  }
  for (const IndexPair& pair : scene.pairs) hash.add((std::uint64_t{pair.a} << 32) | pair.b);
  for (const IndexPair& pair : scene.filter.ignored) {
    hash.add((std::uint64_t{pair.a} << 32) | pair.b);
  }
  for (const char rests : scene.filter.rests) hash.add(std::uint64_t{rests != 0});
  Kinematics kinematics(scene);
  while (kinematics.frame() + 1 < scene.frames) {
    kinematics.next();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (scene.bodies[i].moving) hash.add(kinematics.poses()[i]);
    }
  }
  return base::to_hex(hash.value());
}

}  // namespace touchstone::scene
