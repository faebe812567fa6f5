// Bullet's ray test of a triangle mesh.
// Paper:   none; Bullet 3.24, btBvhTriangleMeshShape::performRaycast, in float.
// Departs: Bullet's ray is a segment. It ends at t_max, or behind the mesh's far side if that is
//          sooner. Bullet's hit has no u and v; those here are of its point.
// Fails:   numbers are rounded to float, and its test of a triangle accepts what is a ten-thousandth
//          of its area outside. It has no test for any hit alone.
// Cost:    O(log n) a ray where triangles are small; a binary tree of quantised boxes.
#include "algorithms/ray_cast.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <optional>

#include "algorithms/peers/rays/segment_rays.h"

namespace touchstone {
namespace {

btVector3 to_bullet(const Vec3d& v) {
  return {static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2])};
}

// Keeps the first hit of the segment.
struct FirstHit final : btTriangleRaycastCallback {
  int triangle = -1;

  FirstHit(const btVector3& from, const btVector3& to) : btTriangleRaycastCallback(from, to) {}
  btScalar reportHit(const btVector3&, btScalar fraction, int, int number) override {
    triangle = number;
    m_hitFraction = fraction;
    return fraction;
  }
};

class BulletRayCast final : public RayCast {
 public:
  void bind(const TriangleMesh& mesh) override {
    mesh_ = &mesh;
    shape_.reset();
    vertices_.clear();
    numbers_.clear();
    reach_.emplace(mesh);
    for (const Vec3d& v : mesh.vertices) {
      for (const double x : v) vertices_.push_back(static_cast<btScalar>(x));
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t k : triangle) numbers_.push_back(static_cast<int>(k));
    }
    if (mesh.triangles.empty()) return;
    arrays_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), numbers_.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(mesh.vertices.size()), vertices_.data(),
        static_cast<int>(3 * sizeof(btScalar)));
    shape_ = std::make_unique<btBvhTriangleMeshShape>(arrays_.get(), true);
    shape_->setMargin(0);
  }

  void cast(RayTask, std::span<const Ray> rays, std::span<RayHit> hits) override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
  }

 private:
  RayHit closest(const Ray& ray) const {
    RayHit hit;
    hit.status = Status::not_reported;
    if (!shape_) return hit;
    const double end = reach_->end(ray);
    const btVector3 from = to_bullet(ray.origin);
    const btVector3 to = to_bullet(ray.origin + end * ray.direction);
    FirstHit first(from, to);
    shape_->performRaycast(&first, from, to);
    if (first.triangle < 0) return hit;
    hit.hit = true;
    hit.triangle = static_cast<std::uint32_t>(first.triangle);
    hit.t = static_cast<double>(first.m_hitFraction) * end;
    set_weights(*mesh_, ray, hit);
    return hit;
  }

  const TriangleMesh* mesh_ = nullptr;
  std::optional<RayReach> reach_;
  std::vector<btScalar> vertices_;
  std::vector<int> numbers_;
  std::unique_ptr<btTriangleIndexVertexArray> arrays_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
};

std::unique_ptr<RayCast> make_cast(const RayCastSettings&) {
  return std::make_unique<BulletRayCast>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<RayCastEntry> peers_bullet_ray_cast() {
  return {{.info = {.name = "bullet-mesh",
                    .citation = "Bullet 3.24, btBvhTriangleMeshShape::performRaycast",
                    .origin = Origin::peer,
                    .known_defect = "rounds in floats; accepts points beside a triangle; misses "
                                    "degenerate triangles and triangles seen edge-on"},
           .tasks = {RayTask::closest},
           .scalars = {Precision::float32},
           .make = make_cast}};
}

}  // namespace touchstone::entries
