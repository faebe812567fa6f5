// Plays a scene in Bullet's world of rigid bodies.
#include "harness/simulate/simulate.h"

#include <fmt/format.h>

#include "harness/base/error.h"
#ifdef TOUCHSTONE_HAS_BULLET_DYNAMICS
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "harness/base/reproducible_math.h"
#include "harness/simulate/bullet_shape.h"
#include "harness/simulate/bullet_vectors.h"
#endif

namespace touchstone::simulate {

#ifndef TOUCHSTONE_HAS_BULLET_DYNAMICS

std::string lacking() { return TOUCHSTONE_NO_BULLET_DYNAMICS; }

Simulated simulate(const scene::Scene&, const std::filesystem::path&, const Settings&,
                   const Sink&) {
  throw base::InputError("bodies cannot fall: " + lacking());
}

#else

namespace {

constexpr double density = 1000;            // kg per cubic metre
constexpr double longest_step = 1.0 / 120;  // seconds
constexpr double usual_gravity = 9.81;

void expect_free(const scene::Scene& scene, const std::filesystem::path& file) {
  const auto fail = [&](const std::string& message) {
    throw base::InputError(file.string(), 0, message);
  };
  if (!scene.recording.empty() || !scene.pairs.empty()) {
    fail("has boxes or pairs alone; expected bodies that fall");
  }
  if (!scene.tracks.bodies.empty()) {
    fail("bodies follow a robot or a log of poses; expected bodies that nothing else moves");
  }
  if (scene.motion.teleports > 0 || scene.motion.churn > 0) {
    fail("bodies jump, arrive or leave; expected bodies that stay");
  }
  if (scene.motion.kind == scene::MotionKind::brownian) {
    fail("the motion is brownian; expected inertial, free_fall or rotating_gravity");
  }
  if (std::ranges::none_of(scene.bodies, &scene::Body::moving)) {
    fail("no body may move; expected moving = true of some");
  }
}

std::string name_of(const scene::Scene& scene, std::size_t body) {
  const bool is_named = body < scene.names.size() && !scene.names[body].empty();
  return is_named ? fmt::format("body {} (\"{}\")", body, scene.names[body])
                  : fmt::format("body {}", body);
}

// Pairs that the scene ignores are none.
class Filter final : public btOverlapFilterCallback {
 public:
  explicit Filter(const std::vector<IndexPair>& ignored) : ignored_(ignored) {}
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    if ((a->m_collisionFilterGroup & b->m_collisionFilterMask) == 0 ||
        (b->m_collisionFilterGroup & a->m_collisionFilterMask) == 0) {
      return false;
    }
    const auto number = [](const btBroadphaseProxy* proxy) {
      return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
    };
    const int first = std::min(number(a), number(b)), second = std::max(number(a), number(b));
    if (first < 0) return true;  // a wall
    const IndexPair pair = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)};
    return !std::ranges::binary_search(ignored_, pair, [](const IndexPair& x, const IndexPair& y) {
      return std::pair(x.a, x.b) < std::pair(y.a, y.b);
    });
  }

 private:
  const std::vector<IndexPair>& ignored_;
};

class World {
 public:
  World(const scene::Scene& scene, const std::filesystem::path& file, const Settings& settings)
      : scene_(scene),
        file_(file),
        settings_(settings),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broad_phase_, &solver_, &configuration_),
        filter_(scene.filter.ignored) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    broad_phase_.getOverlappingPairCache()->setOverlapFilterCallback(&filter_);
    turns_ = !settings.gravity && scene.motion.kind == scene::MotionKind::rotating_gravity;
    set_gravity(0);
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) add(i);
    add_walls();
  }
  ~World() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::size_t free() const { return free_.size(); }

  void play(int steps, double step) {
    for (int i = 0; i < steps; ++i) {
      set_gravity(static_cast<double>(played_++) * step);
      world_.stepSimulation(static_cast<btScalar>(step), 0);
    }
  }

  // A body that may move, where `moved` saw it.
  const scene::LoggedPose& first() const { return last_.front(); }

  // The bodies that are elsewhere than when it was called before.
  std::span<const scene::LoggedPose> moved() {
    moved_.clear();
    last_.resize(free_.size());
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const scene::LoggedPose pose = pose_of(free_[i]);
      if (pose == last_[i]) continue;
      last_[i] = pose;
      moved_.push_back(pose);
    }
    return moved_;
  }

 private:
  void set_gravity(double seconds) {
    const scene::Motion& motion = scene_.motion;
    const bool has_own = motion.kind != scene::MotionKind::inertial;
    const double size = settings_.gravity.value_or(has_own ? motion.acceleration : usual_gravity);
    btVector3 gravity(0, 0, static_cast<btScalar>(-size));
    if (turns_) {
      const base::SinCos turn = base::sin_cos_turns(seconds / motion.period);
      gravity = to_bullet(Vec3d(size * turn.sin, 0, -size * turn.cos));
    }
    if (gravity != world_.getGravity()) world_.setGravity(gravity);
  }

  const BulletShape& shape_of(const scene::Body& body) {
    const auto [at, is_new] = shapes_.try_emplace({body.shape, body.moving});
    if (is_new) at->second = bullet_shape(scene_, body.shape, body.moving);
    return at->second;
  }

  void add(std::uint32_t number) {
    const scene::Body& given = scene_.bodies[number];
    const auto fail = [&](const char* message) {
      throw base::InputError(file_.string(), 0, name_of(scene_, number) + message);
    };
    if (given.moving && scene_.shapes[given.shape].kind == ShapeKind::halfspace) {
      fail(" is a half-space that may move; expected moving = false");
    }
    const BulletShape& made = shape_of(given);
    const auto mass = static_cast<btScalar>(given.moving ? density * made.volume : 0);
    if (given.moving && !(mass > 0 && std::isfinite(mass))) {
      fail(" has no volume, so no mass; expected one that has, or moving = false");
    }
    btVector3 inertia(0, 0, 0);
    if (given.moving) made.shape->calculateLocalInertia(mass, inertia);
    btRigidBody& body =
        add(*made.shape, mass, inertia, {given.pose.rotation, given.pose(made.centre)},
            static_cast<int>(number));
    if (!given.moving) return;
    const Vec3d arm = given.pose.rotation * made.centre;
    body.setLinearVelocity(to_bullet(given.velocity + given.angular_velocity.cross(arm)));
    body.setAngularVelocity(to_bullet(given.angular_velocity));
    // What sleeps does not notice that gravity turns.
    if (turns_) body.setActivationState(DISABLE_DEACTIVATION);
    free_.push_back(number);
  }

  btRigidBody& add(btCollisionShape& shape, btScalar mass, const btVector3& inertia,
                   const Pose& pose, int number) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform = to_bullet(pose);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setUserIndex(number);
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  void add_walls() {
    const scene::Motion& motion = scene_.motion;
    if (!(motion.wall_min.x() <= motion.wall_max.x())) return;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {1.0, -1.0}) {
        const double at = side > 0 ? motion.wall_min[axis] : -motion.wall_max[axis];
        walls_.push_back(std::make_unique<btStaticPlaneShape>(to_bullet(side * Vec3d::Unit(axis)),
                                                              static_cast<btScalar>(at)));
        add(*walls_.back(), 0, {0, 0, 0}, {}, -1);
      }
    }
  }

  scene::LoggedPose pose_of(std::uint32_t number) const {
    const btTransform& at = bodies_[number]->getWorldTransform();
    const btQuaternion turn = at.getRotation();
    const Vec3d& centre = shapes_.at({scene_.bodies[number].shape, true}).centre;
    const std::array<double, 4> wxyz = {turn.w(), turn.x(), turn.y(), turn.z()};
    const auto rotation = base::rotation_of_any(wxyz);
    const Vec3d origin =
        from_bullet(at.getOrigin()) - base::times(rotation.value_or(Mat3d::Identity()), centre);
    if (!rotation || !rotation->allFinite() || !origin.allFinite()) {
      throw base::InputError(file_.string(), 0,
                             fmt::format("{} is nowhere after {} steps: Bullet's dynamics failed; "
                                         "expected bodies that overlap less, or weigh more alike",
                                         name_of(scene_, number), played_));
    }
    scene::LoggedPose pose{number, {}, {}};
    for (std::size_t i = 0; i < 3; ++i)
      pose.translation[i] = static_cast<float>(origin[static_cast<int>(i)]);
    for (std::size_t i = 0; i < 4; ++i) pose.quaternion_wxyz[i] = static_cast<float>(wxyz[i]);
    return pose;
  }

  const scene::Scene& scene_;
  std::filesystem::path file_;
  Settings settings_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  Filter filter_;
  std::map<std::pair<std::uint32_t, bool>, BulletShape> shapes_;  // by shape, and whether it moves
  std::vector<std::unique_ptr<btStaticPlaneShape>> walls_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  // those of the scene, then walls
  std::vector<std::uint32_t> free_;
  std::vector<scene::LoggedPose> last_, moved_;
  bool turns_ = false;
  std::int64_t played_ = 0;
};

}  // namespace

std::string lacking() { return ""; }

Simulated simulate(const scene::Scene& scene, const std::filesystem::path& file,
                   const Settings& settings, const Sink& sink) {
  expect_free(scene, file);
  World world(scene, file, settings);
  const double frame = 1 / settings.fps;
  const auto steps = static_cast<int>(std::ceil(frame / longest_step - 1e-9));
  const auto frame_at = [&](double seconds) {
    return static_cast<int>(std::floor(seconds * settings.fps + 0.5));
  };
  const int first = frame_at(settings.from), last = frame_at(settings.seconds);
  Simulated done{.frames = last - first + 1, .free = world.free()};
  for (int i = 0; i <= last; ++i) {
    if (i > 0) world.play(steps, frame / steps);
    if (i < first) continue;
    const std::span<const scene::LoggedPose> moved = world.moved();
    if (i > first) done.resting = done.free - moved.size();
    sink(i - first, moved.empty() ? std::span(&world.first(), 1) : moved);
  }
  return done;
}

#endif

}  // namespace touchstone::simulate
