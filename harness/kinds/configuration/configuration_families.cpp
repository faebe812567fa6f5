// Draws robots of balls, of primitives and of meshes among obstacles, and motions of them.
#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "harness/base/reproducible_math.h"
#include "harness/families/meshes.h"
#include "harness/kinds/configuration/configuration_kind.h"

namespace touchstone::kinds {
namespace {

using families::Draws;

enum class Make : std::uint8_t { balls, primitives, meshes };
constexpr std::array<std::string_view, 3> makes = {"balls", "primitives", "meshes"};
constexpr double link_length = 0.25;  // metres

Make make_of(std::uint32_t family) { return static_cast<Make>(family % makes.size()); }
bool is_near_contact(std::uint32_t family) { return family >= makes.size(); }

ConcaveBody body_of(const Shape& shape) { return {nullptr, {{shape, {}, 0}}}; }

Shape primitive(ShapeKind kind, double size, Draws& draws) {
  Shape shape;
  shape.kind = kind;
  shape.radius = draws.uniform(0.2, 0.5) * size;
  shape.half_length = draws.uniform(0.3, 1) * size;
  shape.half_extents = {draws.uniform(0.1, 1) * size, draws.uniform(0.1, 1) * size,
                        draws.uniform(0.1, 1) * size};
  return shape;
}

Shape any_primitive(double size, Draws& draws) {
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::cylinder};
  return primitive(kinds[static_cast<std::size_t>(draws.below(4))], size, draws);
}

ConcaveBody any_mesh(double size, Draws& draws) {
  TriangleMesh mesh;
  switch (draws.below(3)) {
    case 0: mesh = families::torus(6, 4, 0.75, 0.25, false); break;
    case 1: mesh = families::ellipsoid_mesh({0.5, 0.5, 1}, 6, 4); break;
    default: mesh = families::box_mesh(0.5, 0.75, 1, false);
  }
  return {std::make_shared<const TriangleMesh>(families::moved(mesh, size, {0, 0, 0})), {}};
}

// A turn by less than half a circle, about any axis.
Mat3d some_turn(const Vec3d& by) { return base::rotation_of({1, by.x(), by.y(), by.z()}); }

void add_link(Make make, std::uint32_t link, ConfigurationModel& robot, Draws& draws) {
  const int count = make == Make::balls ? 3 + draws.below(3) : 1 + draws.below(2);
  for (int i = 0; i < count; ++i) {
    ModelPart part;
    part.link = link;
    part.pose.translation = {0, 0, (i + 0.5) * link_length / count};
    if (make == Make::balls) {
      part.body = body_of(primitive(ShapeKind::sphere, 0.2, draws));
    } else {
      part.pose.rotation = draws.below(2) == 0 ? Mat3d::Identity() : draws.rotation();
      part.body = make == Make::meshes && i == 0 ? any_mesh(link_length / 2, draws)
                                                 : body_of(any_primitive(0.1, draws));
    }
    robot.parts.push_back(std::move(part));
  }
}

// Each link at the end of the one before, turned against it.
void add_configuration(const std::vector<Vec3d>& turns, std::vector<Pose>& poses) {
  Pose before;
  for (const Vec3d& turn : turns) {
    before = placed_within(before, {some_turn(turn), Vec3d(0, 0, link_length)});
    poses.push_back(before);
  }
}

}  // namespace

std::vector<Family> configuration_families() {
  std::vector<Family> list;
  for (const char* where : {"", "-near"}) {
    for (const std::string_view make : makes) {
      list.push_back({.name = "configurations-" + std::string(make) + where,
                      .group = "configurations",
                      .one_in = make == makes.front() ? 1 : 4});
    }
  }
  return list;
}

ConfigurationModel drawn_robot(std::uint32_t family, Draws& draws) {
  const Make make = make_of(family);
  ConfigurationModel robot;
  robot.links = 4 + static_cast<std::uint32_t>(draws.below(4));
  for (std::uint32_t link = 0; link < robot.links; ++link) add_link(make, link, robot, draws);
  const int obstacles = 3 + draws.below(4);
  for (int i = 0; i < obstacles; ++i) {
    ModelPart part;
    part.pose.rotation = draws.below(2) == 0 ? Mat3d::Identity() : draws.rotation();
    const double away = draws.uniform(0.4, 1.2);
    part.pose.translation = draws.direction() * away;
    part.body = make == Make::meshes && draws.below(2) == 0 ? any_mesh(0.25, draws)
                                                            : body_of(any_primitive(0.25, draws));
    robot.parts.push_back(std::move(part));
  }
  for (std::uint32_t a = 0; a < robot.parts.size(); ++a) {
    for (std::uint32_t b = a + 1; b < robot.parts.size(); ++b) {
      const std::uint32_t first = robot.parts[a].link, second = robot.parts[b].link;
      if (first == ModelPart::world) continue;
      if (second != ModelPart::world && second < first + 2) continue;
      robot.pairs.push_back({a, b});
    }
  }
  return robot;
}

DrawnMotion drawn_motion(std::uint32_t family, const ConfigurationModel& robot, Draws& draws) {
  std::vector<Vec3d> from(robot.links), by(robot.links);
  const auto draw = [&] {
    for (Vec3d& turn : from) turn = draws.vector(1);
    for (Vec3d& turn : by) turn = draws.vector(0.5);
  };
  const auto at = [&](double s, std::vector<Pose>& poses) {
    std::vector<Vec3d> turns;
    for (std::size_t i = 0; i < from.size(); ++i) turns.push_back(from[i] + s * by[i]);
    add_configuration(turns, poses);
  };
  draw();
  double end = 1;
  if (is_near_contact(family)) {
    constexpr int most_tries = 32;
    ConfigurationTruth truth(robot, PairAnswers::fast);
    const auto touches = [&](double s) {
      std::vector<Pose> poses;
      at(s, poses);
      return truth.answer(ConfigurationTask::free, poses, 1).answer == Answer::overlapping;
    };
    bool begins = touches(0), ends = touches(1);
    for (int i = 0; begins == ends && i < most_tries; ++i) {
      draw();
      begins = touches(0);
      ends = touches(1);
    }
    double low = 0, high = 1;
    // No point moves by more than 20 metres.
    while (begins != ends && high - low > 5e-8) {
      const double middle = (low + high) / 2;
      (touches(middle) == begins ? low : high) = middle;
    }
    end = draws.below(2) == 0 ? low : high;
  }
  DrawnMotion motion;
  for (std::uint32_t step = 0; step < DrawnMotion::steps; ++step) {
    at(end * (step + 1) / DrawnMotion::steps, motion.poses);
  }
  return motion;
}

}  // namespace touchstone::kinds
