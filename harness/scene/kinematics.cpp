// Advances poses and velocities in plain arithmetic, and makes steps of them.
#include "harness/scene/kinematics.h"

#include <algorithm>
#include <cmath>

#include "harness/base/error.h"
#include "harness/base/random.h"

namespace touchstone::scene {
namespace {

// The acceleration of all bodies from `frame` to the next frame.
Vec3d acceleration(const Motion& motion, int frame) {
  switch (motion.kind) {
    case MotionKind::inertial:
    case MotionKind::brownian: break;
    case MotionKind::free_fall: return {0, 0, -motion.acceleration};
    case MotionKind::rotating_gravity: {
      const base::SinCos turn = base::sin_cos_turns(frame * motion.time_step / motion.period);
      return {motion.acceleration * turn.sin, 0, -motion.acceleration * turn.cos};
    }
  }
  return Vec3d::Zero();
}

// Brings x back between the walls by reflection, and reverses the velocity after an odd number of
// reflections. With an acceleration, the speed becomes that of the height reached.
void reflect(double low, double high, double acceleration, double& x, double& velocity) {
  if (x >= low && x <= high) return;
  const double width = high - low;
  if (!(width > 0)) {
    x = low;
    return;
  }
  const double period = 2 * width;
  double place = (x - low) - period * std::floor((x - low) / period);  // [0, 2 width]
  const bool turned = place > width;
  if (turned) place = period - place;
  const double mirrored = std::clamp(low + place, low, high);
  const double squared = velocity * velocity + 2 * acceleration * (mirrored - x);
  const double speed = std::sqrt(std::max(0.0, squared));
  const bool negative = (velocity < 0) != turned;
  velocity = negative ? -speed : speed;
  x = mirrored;
}

// The rotation vector (radians, world) of the least turn that takes the rotation `from` to `to`.
Vec3d turn_between(const Mat3d& from, const Mat3d& to) {
  const Mat3d turn = base::product(to, from.transpose());
  const Eigen::Quaterniond q(turn);  // of unit length up to rounding
  const double sine = base::length(q.vec());
  if (!(sine > 0)) return Vec3d::Zero();
  const double half = std::atan2(sine, std::abs(q.w()));
  return (2 * half / sine * (q.w() < 0 ? -1 : 1)) * q.vec();
}

}  // namespace

Kinematics::Kinematics(const Scene& scene) : scene_(&scene) {
  poses_.reserve(scene.bodies.size());
  velocities_.reserve(scene.bodies.size());
  for (const Body& body : scene.bodies) {
    poses_.push_back(body.pose);
    velocities_.push_back(body.velocity);
  }
  const Motion& motion = scene.motion;
  if (motion.teleports == 0 && motion.churn == 0) return;
  const std::vector<std::uint32_t>& tracked = scene.tracks.bodies;
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    if (i >= scene.size()) {
      absent_.push_back(i);
    } else if (scene.bodies[i].moving && !std::ranges::binary_search(tracked, i)) {
      movers_.push_back(i);
    }
  }
  if (motion.churn == 0) return;
  present_.assign(scene.size(), 1);
  present_.resize(scene.bodies.size(), 0);
}

void Kinematics::pick_movers(base::Random& random, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(movers_[i], movers_[i + random.below(movers_.size() - i)]);
  }
}

void Kinematics::exchange_places(base::Random& random) {
  const std::size_t count = scene_->motion.teleports;
  pick_movers(random, count);
  const Vec3d first = poses_[movers_[0]].translation;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    poses_[movers_[i]].translation = poses_[movers_[i + 1]].translation;
  }
  poses_[movers_[count - 1]].translation = first;
}

void Kinematics::replace_some(base::Random& random) {
  const std::size_t count = scene_->motion.churn;
  pick_movers(random, count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t &going = movers_[i], &coming = absent_[i];
    poses_[coming].translation = poses_[going].translation;
    present_[going] = 0;
    present_[coming] = 1;
    std::swap(going, coming);
  }
}

// Bodies take turns, as in Broadmark: after a hundred frames each has had a new velocity.
void Kinematics::kick_some() {
  const std::size_t n = poses_.size(), share = (n + 99) / 100;
  base::Random random(scene_->motion.seed, static_cast<std::uint64_t>(frame_));
  const std::size_t first = share * static_cast<std::size_t>(frame_) % n;
  for (std::size_t k = 0; k < share; ++k) {
    velocities_[(first + k) % n] = scene_->motion.speed * random.in_ball();
  }
}

void Kinematics::follow_tracks() {
  const Tracks& tracks = scene_->tracks;
  if (tracks.bodies.empty()) return;
  const std::size_t frame = std::min(static_cast<std::size_t>(frame_), tracks.frames() - 1);
  const std::size_t before = std::min(static_cast<std::size_t>(frame_ - 1), frame);
  for (std::size_t k = 0; k < tracks.bodies.size(); ++k) {
    const std::uint32_t body = tracks.bodies[k];
    const Pose& pose = tracks.poses[frame * tracks.bodies.size() + k];
    const Pose& last = tracks.poses[before * tracks.bodies.size() + k];
    velocities_[body] = (pose.translation - last.translation) / scene_->motion.time_step;
    poses_[body] = pose;
  }
}

void Kinematics::next() {
  const Motion& motion = scene_->motion;
  if (motion.kind == MotionKind::brownian && !poses_.empty()) kick_some();
  const Vec3d a = acceleration(motion, frame_);
  const double dt = motion.time_step;
  ++frame_;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const Body& body = scene_->bodies[i];
    if (!body.moving) continue;
    for (int axis = 0; axis < 3; ++axis) {
      double& x = poses_[i].translation[axis];
      double& v = velocities_[i][axis];
      x += (v + 0.5 * a[axis] * dt) * dt;
      v += a[axis] * dt;
      if (motion.wall_min[axis] <= motion.wall_max[axis]) {
        reflect(motion.wall_min[axis], motion.wall_max[axis], a[axis], x, v);
      }
    }
    const Vec3d& w = body.angular_velocity;
    if (w.x() != 0 || w.y() != 0 || w.z() != 0) {
      poses_[i].rotation = base::product(base::rotation_over(w, frame_ * dt), body.pose.rotation);
    }
  }
  follow_tracks();
  if (movers_.empty()) return;
  // The seed differs from that of the new velocities.
  base::Random random(~motion.seed, static_cast<std::uint64_t>(frame_));
  if (motion.teleports > 0) exchange_places(random);
  if (motion.churn > 0) replace_some(random);
}

std::vector<MotionStep> motion_steps(const Scene& scene, const std::filesystem::path& file) {
  if (!scene.recording.empty() || !scene.pairs.empty()) {
    throw base::InputError(file.string(), 0,
                           "has boxes or pairs alone; expected bodies that move in a step");
  }
  if (scene.motion.teleports > 0 || scene.motion.churn > 0) {
    throw base::InputError(file.string(), 0,
                           "has bodies that jump, arrive or leave; expected bodies that move");
  }
  std::vector<MotionStep> steps;
  Kinematics kinematics(scene);
  for (int frame = 0; frame < scene.frames; ++frame) {
    MotionStep& step = steps.emplace_back();
    step.poses.assign(kinematics.poses().begin(), kinematics.poses().end());
    step.motions.resize(step.poses.size());
    kinematics.next();
    for (std::size_t i = 0; i < step.motions.size(); ++i) {
      const Body& body = scene.bodies[i];
      if (!body.moving) continue;
      step.motions[i].displacement = kinematics.poses()[i].translation - step.poses[i].translation;
      step.motions[i].rotation_vector = scene.motion.time_step * body.angular_velocity;
    }
    for (const std::uint32_t i : scene.tracks.bodies) {
      step.motions[i].rotation_vector =
          turn_between(step.poses[i].rotation, kinematics.poses()[i].rotation);
    }
  }
  return steps;
}

}  // namespace touchstone::scene
