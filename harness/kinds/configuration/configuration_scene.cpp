// Makes models of scenes whose bodies follow tracks.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "harness/base/error.h"
#include "harness/kinds/configuration/configuration_kind.h"

namespace touchstone::kinds {
namespace {

// Where `inner` is as seen from `outer`, whose rotation is orthonormal.
Pose seen_from(const Pose& outer, const Pose& inner) {
  return {outer.rotation.transpose() * inner.rotation,
          outer.rotation.transpose() * (inner.translation - outer.translation)};
}

double difference(const Pose& a, const Pose& b) {
  return std::max((a.rotation - b.rotation).cwiseAbs().maxCoeff(),
                  (a.translation - b.translation).cwiseAbs().maxCoeff());
}

// Whether two bodies keep their places relative to each other, up to rounding.
bool move_together(const scene::Tracks& tracks, std::size_t first, std::size_t second) {
  constexpr double greatest = 1e-12;
  const std::size_t count = tracks.bodies.size();
  const auto relative = [&](std::size_t frame) {
    const Pose& outer = tracks.poses[frame * count + first];
    return seen_from(outer, tracks.poses[frame * count + second]);
  };
  const Pose at_first = relative(0);
  for (std::size_t frame = 0; frame < tracks.frames(); ++frame) {
    const Pose& outer = tracks.poses[frame * count + first];
    const double size = 1 + outer.translation.cwiseAbs().maxCoeff();
    const Mat3d product = outer.rotation.transpose() * outer.rotation;
    if (!product.isIdentity(greatest)) return false;
    if (difference(relative(frame), at_first) > greatest * size) return false;
  }
  return true;
}

ConcaveBody body_of(const scene::Scene& scene, std::size_t body) {
  const std::uint32_t shape = scene.bodies[body].shape;
  if (const ConcaveBody* const concave = scene.concave_of(shape)) return *concave;
  return {nullptr, {{scene.shapes[shape], {}, 0}}};
}

}  // namespace

SceneConfigurations scene_configurations(const scene::Scene& scene, const std::string& file) {
  const scene::Tracks& tracks = scene.tracks;
  if (tracks.bodies.empty()) {
    throw base::InputError(file, 0, "no body follows poses; expected a robot, or a log of poses");
  }
  SceneConfigurations made;
  ConfigurationModel& model = made.model;
  std::vector<std::size_t> firsts;  // of each link the place in the tracks of its first body
  const auto name_of = [&](std::size_t body) {
    return scene.names.empty() ? std::string() : scene.names[body];
  };
  std::size_t next = 0;  // among the tracks
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    ModelPart part;
    part.body = body_of(scene, body);
    if (next < tracks.bodies.size() && tracks.bodies[next] == body) {
      const bool continues = !firsts.empty() && next > 0 && tracks.bodies[next - 1] + 1 == body &&
                             !name_of(body).empty() && name_of(body) == name_of(body - 1) &&
                             move_together(tracks, firsts.back(), next);
      if (continues) {
        part.pose = seen_from(tracks.poses[firsts.back()], tracks.poses[next]);
      } else {
        firsts.push_back(next);
      }
      part.link = static_cast<std::uint32_t>(firsts.size() - 1);
      ++next;
    } else {
      const scene::Body& given = scene.bodies[body];
      const bool stands = !given.moving || (given.velocity == Vec3d::Zero() &&
                                            given.angular_velocity == Vec3d::Zero() &&
                                            scene.motion.kind == scene::MotionKind::inertial);
      if (!stands) {
        throw base::InputError(
            file, 0,
            fmt::format("body {} moves by its velocity; expected obstacles that stand still",
                        body));
      }
      part.pose = given.pose;
    }
    model.parts.push_back(std::move(part));
    made.names.push_back(name_of(body).empty() ? fmt::format("body {}", body) : name_of(body));
  }
  model.links = static_cast<std::uint32_t>(firsts.size());
  for (std::uint32_t a = 0; a < model.parts.size(); ++a) {
    for (std::uint32_t b = a + 1; b < model.parts.size(); ++b) {
      if (model.parts[a].link == model.parts[b].link) continue;  // the world is one too
      if (scene.filter.asks({a, b})) model.pairs.push_back({a, b});
    }
  }
  for (std::size_t frame = 0; frame < tracks.frames(); ++frame) {
    for (const std::size_t first : firsts) {
      made.poses.push_back(tracks.poses[frame * tracks.bodies.size() + first]);
    }
  }
  return made;
}

}  // namespace touchstone::kinds
