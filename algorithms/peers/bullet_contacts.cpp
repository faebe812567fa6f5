// Bullet's contact manifolds of boxes and hulls: its collision algorithms and the manifold of four
// points that they fill.
// Paper:   none; Bullet 3.24, btBoxBoxCollisionAlgorithm (dBoxBox of R. Smith's ODE) and
//          btConvexConvexAlgorithm (normal by GJK and EPA, faces by btPolyhedralContactClipping),
//          each into a btPersistentManifold.
// Departs: bullet_bodies.h states how bodies and poses are converted; there are no margins. The
//          threshold of a manifold is 0.02 of the smaller body's size, as in the world's
//          dispatcher: Bullet also reports points that far apart, and merges points that near to
//          each other. The manifold is empty before each query, so it holds no points of an earlier
//          frame.
// Fails:   thresholds are absolute lengths: below 1e-3 m much is lost. The clipping works on
//          vertices that Bullet's hull computer has snapped to a grid: errors of 3e-4 of the size,
//          in either build. It measures depth across a's face, and puts the point on a along the
//          normal, which may have another direction. From the fifth corner on the reduction is
//          incremental, so the area kept depends on the order of the corners.
// Cost:    O(n m) for faces of n and m corners; EPA.
#include "algorithms/contact_manifold.h"
#include "algorithms/peers/bullet_double/bullet_double.h"
#ifdef TOUCHSTONE_HAS_BULLET
#include <BulletCollision/CollisionDispatch/btBoxBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "algorithms/peers/bullet_bodies.h"

namespace touchstone::bullet {
namespace {

using Wrapper = btCollisionObjectWrapper;

constexpr btScalar breaking_threshold = btScalar(0.02);  // gContactBreakingThreshold's default

// Bullet's algorithm for a pair of objects and a manifold, constructed once for all pairs.
struct BoxContacts {
  btBoxBoxCollisionAlgorithm algorithm;

  static bool takes(const Body&) { return true; }
  static void prepare(Body&) {}
  BoxContacts(btPersistentManifold& manifold, const Wrapper& a, const Wrapper& b)
      : algorithm(&manifold, btCollisionAlgorithmConstructionInfo(), &a, &b) {}
};

struct HullContacts {
  btGjkEpaPenetrationDepthSolver depth_solver;
  btConvexConvexAlgorithm algorithm;

  static bool takes(const Body& body) { return body.polyhedron != nullptr; }
  static void prepare(Body& body) { make_polyhedron(body); }
  HullContacts(btPersistentManifold& manifold, const Wrapper& a, const Wrapper& b)
      : algorithm(&manifold, btCollisionAlgorithmConstructionInfo(), &a, &b, &depth_solver, 0, 0) {}
};

template <class Algorithm>
class BulletManifold final : public ContactManifold {
 public:
  BulletManifold() { manifold_.setBodies(&object_a_, &object_b_); }

  void bind(std::span<const Shape> shapes) override {
    bodies_.clear();
    bodies_.reserve(shapes.size());
    for (const Shape& shape : shapes) {
      bodies_.push_back(make_body(shape));
      Algorithm::prepare(bodies_.back());
    }
  }

  void solve(const PairBatch& batch, std::span<Manifold> manifolds) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
      const Body& a = bodies_[batch.pairs.shape_of[first]];
      const Body& b = bodies_[batch.pairs.shape_of[second]];
      manifolds[i] = {};
      if (!Algorithm::takes(a) || !Algorithm::takes(b)) {
        manifolds[i].status = Status::degenerate;
        continue;
      }
      const Pose &at_a = batch.pairs.poses[first], &at_b = batch.pairs.poses[second];
      Vec3d origin;
      const Vec3d offset = offset_between(at_a, a.centre, at_b, b.centre, origin);
      place(object_a_, a, at_a, Vec3d::Zero());
      place(object_b_, b, at_b, offset);
      const btScalar threshold = std::min(a.shape->getContactBreakingThreshold(breaking_threshold),
                                          b.shape->getContactBreakingThreshold(breaking_threshold));
      manifold_.setContactBreakingThreshold(threshold);
      manifold_.clearManifold();
      const Wrapper wrapped_a(nullptr, a.shape.get(), &object_a_, object_a_.getWorldTransform(), -1,
                              -1);
      const Wrapper wrapped_b(nullptr, b.shape.get(), &object_b_, object_b_.getWorldTransform(), -1,
                              -1);
      if (!algorithm_) algorithm_.emplace(manifold_, wrapped_a, wrapped_b);
      btManifoldResult result(&wrapped_a, &wrapped_b);
      algorithm_->algorithm.processCollision(&wrapped_a, &wrapped_b, info_, &result);
      report(origin, manifolds[i]);
    }
  }

 private:
  static void place(btCollisionObject& object, const Body& body, const Pose& pose,
                    const Vec3d& offset) {
    object.setCollisionShape(body.shape.get());
    object.setWorldTransform(btTransform(to_matrix(pose.rotation), to_bullet(offset)));
  }

  void report(const Vec3d& origin, Manifold& manifold) const {
    manifold.status = Status::not_reported;
    manifold.answer = Answer::separated;
    const int count = manifold_.getNumContacts();
    for (int k = 0; k < count; ++k) {
      if (manifold_.getContactPoint(k).getDistance() < 0) manifold.answer = Answer::overlapping;
    }
    if (manifold.answer == Answer::separated) return;
    manifold.normal = -from_bullet(manifold_.getContactPoint(0).m_normalWorldOnB);
    for (int k = 0; k < count; ++k) {
      const btManifoldPoint& point = manifold_.getContactPoint(k);
      ContactPoint& to = manifold.points[static_cast<std::size_t>(manifold.count++)];
      to.on_a = origin + from_bullet(point.getPositionWorldOnA());
      to.on_b = origin + from_bullet(point.getPositionWorldOnB());
      to.depth = 0 - static_cast<double>(point.getDistance());
    }
  }

  btCollisionObject object_a_, object_b_;
  btPersistentManifold manifold_;
  btDispatcherInfo info_;
  std::vector<Body> bodies_;
  std::optional<Algorithm> algorithm_;
};

template <class Algorithm>
std::unique_ptr<ContactManifold> make_manifold(const char* name, const ManifoldSettings& settings) {
  if constexpr (std::is_same_v<btScalar, float>) {
    if (settings.scalar == Precision::float64 && has_double) {
      return make_double<ContactManifold>(name, settings);
    }
  }
  return std::make_unique<BulletManifold<Algorithm>>();
}

std::unique_ptr<ContactManifold> make_box_contacts(const ManifoldSettings& settings) {
  return make_manifold<BoxContacts>("bullet-box-contacts", settings);
}

std::unique_ptr<ContactManifold> make_hull_contacts(const ManifoldSettings& settings) {
  return make_manifold<HullContacts>("bullet-hull-contacts", settings);
}

}  // namespace
}  // namespace touchstone::bullet
#endif

namespace touchstone::entries {

std::vector<ManifoldEntry> peers_bullet_contacts() {
  return {
      {.info = {.name = "bullet-box-contacts",
                .citation = "Bullet 3.24, btBoxBoxCollisionAlgorithm, btPersistentManifold",
                .origin = Origin::peer,
                .lacking = bullet::lacking()},
       .scalars = bullet::scalars(),
       .supports = [](ShapeKind a,
                      ShapeKind b) { return a == ShapeKind::box && b == ShapeKind::box; },
       .make = bullet::make_box_contacts},
      {.info = {.name = "bullet-hull-contacts",
                .citation = "Bullet 3.24, btConvexConvexAlgorithm, btPolyhedralContactClipping, "
                            "btPersistentManifold",
                .origin = Origin::peer,
                .lacking = bullet::lacking()},
       .scalars = bullet::scalars(),
       .supports =
           [](ShapeKind a, ShapeKind b) {
             const auto flat_sided = [](ShapeKind k) {
               return k == ShapeKind::box || k == ShapeKind::hull;
             };
             return flat_sided(a) && flat_sided(b);
           },
       .make = bullet::make_hull_contacts}};
}

}  // namespace touchstone::entries
