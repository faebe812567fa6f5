// Generator `pairs`: pairs of bodies at exact distances, for benchmarks of narrow phases.
#include "harness/scene/generators/pairs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "algorithms/core/bounds.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {
namespace {

// Small-amplitude motion of pairs, which keeps them about as far apart as they were placed. Used by
// the generator `pairs`.

struct Sway {
  double share = 0;      // change of the distance relative to the gap, about; 0: nothing moves
  int frames = 1;        // frames of the scene
  double time_step = 0;  // seconds
};

Vec3d cross(const Vec3d& u, const Vec3d& v) {
  return {u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(),
          u.x() * v.y() - u.y() * v.x()};
}

// Moves a body back from the middle frame to the first.
void start(double seconds, Body& body) {
  body.moving = true;
  body.pose.translation -= seconds * body.velocity;
  body.pose.rotation =
      base::product(base::rotation_over(body.angular_velocity, -seconds), body.pose.rotation);
}

// Reads `sway`. Throws if the scene also sets a motion.
Sway read_sway(const GeneratorInput& input) {
  files::TomlTable& table = input.table;
  Sway sway;
  sway.share = table.number("sway", {.low = 0, .high = 1}, 0.0);
  if (sway.share > 0 && table.contains("motion")) {
    table.fail("motion", "given beside sway, which says how bodies move; expected one of the two");
  }
  sway.frames = input.frames;
  sway.time_step = table.number("time_step", {.low = 1e-9, .high = 1e6}, Motion{}.time_step);
  return sway;
}

// Sets the pair in motion so that it passes through the given poses in the middle frame. `normal`
// (unit length) is the direction from a to b there, `gap` the signed distance (metres), and `reach`
// the extent of each body from its origin.
//
// Both bodies rotate together about the origin of a; b also slides and rotates about the normal.
// These motions change the distance only to second order. Finally b tilts a little. Each angle, and
// the length of the slide, is small enough to change the distance at the first and the last frame
// by at most about a quarter of share * |gap|, if the nearest features stay the same. If one slides
// off the other's edge, the bodies are further apart.
void set_swaying(const Sway& sway, const Vec3d& normal, double gap, double reach,
                 base::Random& random, Body& a, Body& b) {
  const int middle = sway.frames / 2;
  if (!(sway.share > 0) || middle == 0) return;
  const double seconds = middle * sway.time_step;
  const double change = sway.share * std::abs(gap);
  const Vec3d between = b.pose.translation - a.pose.translation;
  const double arm = base::length(between) + reach;
  const double angle = std::sqrt(change / (2 * arm));  // arm * angle^2 / 2 is a quarter
  const Vec3d turn = (angle / seconds) * random.in_ball();
  Vec3d slide = (angle * arm / 2 / seconds) * random.in_ball();
  slide -= base::inner(slide, normal) * normal;
  const double spin = (angle / seconds) * (2 * random.unit() - 1);
  const Vec3d tilt = (change / (4 * arm) / seconds) * random.in_ball();
  a.angular_velocity = turn;
  b.angular_velocity = turn + spin * normal + tilt;
  b.velocity = cross(turn, between) + slide;
  start(seconds, a);
  start(seconds, b);
}

// Moves a body until the exact signed distance has a given value, along the shortest way (settle)
// or along a given line (meet). Used by the generator pairs and by bench.

// The precision with which doubles of the size of the translations can place a body.
double tolerance_of(double distance) { return std::max(1e-6 * std::abs(distance), 4e-16); }

}  // namespace

bool settle(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a,
            const oracle::Solid& b, Pose& at_b, double distance) {
  constexpr int most_steps = 30;
  const double tolerance = tolerance_of(distance);
  for (int step = 0; step < most_steps; ++step) {
    const oracle::Measure measure = oracle.measure({a, at_a}, {b, at_b});
    const double off = distance - measure.middle();
    if (std::abs(off) <= tolerance) return true;
    if (measure.normal.isZero()) return false;
    at_b.translation += off * measure.normal.normalized();
  }
  return false;
}

// Takes Newton's steps: along a line the signed distance is convex, so no step goes too far.
bool meet(oracle::Oracle& oracle, const oracle::Solid& a, const Pose& at_a, const oracle::Solid& b,
          Pose& at_b, const Vec3d& way, double distance) {
  constexpr int most_steps = 60;
  const double tolerance = tolerance_of(distance);
  for (int step = 0; step < most_steps; ++step) {
    const oracle::Measure measure = oracle.measure({a, at_a}, {b, at_b});
    const double off = measure.middle() - distance;
    if (std::abs(off) <= tolerance) return true;
    if (measure.normal.isZero()) return false;
    const Vec3d normal = measure.normal.normalized();
    const double slope = -(normal.x() * way.x() + normal.y() * way.y() + normal.z() * way.z());
    if (!(slope > 1e-3)) return false;  // beyond the nearest place, or almost
    at_b.translation += off / slope * way;
  }
  return false;
}

namespace {

// Returns a point of the shape that is farthest along n (unit, local).
Vec3d support_point(const Shape& shape, const Vec3d& n) {
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  const double across = std::sqrt(n.x() * n.x() + n.y() * n.y());
  const auto disc = [&](double z) -> Vec3d {
    if (!(across > 0)) return {0, 0, z};
    return {shape.radius * n.x() / across, shape.radius * n.y() / across, z};
  };
  switch (shape.kind) {
    case ShapeKind::sphere: return shape.radius * n;
    case ShapeKind::capsule: return shape.radius * n + Vec3d(0, 0, sign(n.z()) * shape.half_length);
    case ShapeKind::cylinder: return disc(sign(n.z()) * shape.half_length);
    case ShapeKind::cone: {
      const double tip = n.z() * shape.half_length;
      const double base = shape.radius * across - n.z() * shape.half_length;
      return tip > base ? Vec3d(0, 0, shape.half_length) : disc(-shape.half_length);
    }
    case ShapeKind::box:
      return {sign(n.x()) * shape.half_extents.x(), sign(n.y()) * shape.half_extents.y(),
              sign(n.z()) * shape.half_extents.z()};
    case ShapeKind::ellipsoid: {
      const Vec3d& r = shape.radii;
      const Vec3d scaled(r.x() * n.x(), r.y() * n.y(), r.z() * n.z());
      const double norm = base::length(scaled);
      return {r.x() * (scaled.x() / norm), r.y() * (scaled.y() / norm),
              r.z() * (scaled.z() / norm)};
    }
    case ShapeKind::hull: {
      const auto along = [&](const Vec3d& v) { return base::inner(v, n); };
      const std::vector<Vec3d>& vertices = shape.hull->vertices;
      return *std::ranges::max_element(vertices, {}, along);
    }
    case ShapeKind::halfspace: break;  // no generator makes one
  }
  return Vec3d::Zero();
}

Vec3d world_support(const Scene& scene, const Body& body, const Vec3d& n) {
  const Mat3d& r = body.pose.rotation;
  return base::times(r, support_point(scene.shapes[body.shape], base::transposed_times(r, n)));
}

constexpr std::string_view placement_names[] = {"facing", "settled", "meeting", "stacked",
                                                "turned", "tumbled", "wall",    "floor"};
// From `resting` on in the order of Rest.
enum class Placement : std::uint8_t { facing, settled, meeting, resting };

bool can_rest(const Shape& shape, Rest rest) {
  return shape.kind == ShapeKind::box || (shape.kind == ShapeKind::hull && rest != Rest::wall);
}

std::vector<double> read_gaps(GeneratorInput& input) {
  files::TomlTable& table = input.table;
  std::vector<double> gaps;
  if (const toml::node* node = table.node("gaps")) {
    const toml::array* array = node->as_array();
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      const std::optional<double> gap =
          (*array)[i].is_number() ? (*array)[i].value<double>() : std::nullopt;
      if (gap && std::abs(*gap) <= 1e6) gaps.push_back(*gap);
    }
    if (array == nullptr || array->empty() || gaps.size() != array->size()) {
      table.fail("gaps", "expected an array of signed distances in metres, between -1e6 and 1e6");
    }
  }
  if (input.gap) return {*input.gap};
  if (gaps.empty()) gaps.push_back(0.1);
  return gaps;
}

}  // namespace

// Body 2 i is placed against body 2 i + 1 with the gap gaps[i modulo their number]. Along a random
// direction n, the support points of the two bodies that face each other are placed on a line along
// n with that gap. Nothing lies between the planes through them, so a positive gap is the exact
// distance; a depth is that along n, at most the bodies' depth there.
//
// `settled`: body 2 i + 1 then moves along the shortest connection until the exact distance or
// depth is the gap. If it is already, vertices still face vertices.
//
// `meeting`: body 2 i + 1 moves straight towards the other from a random direction until the exact
// distance or depth is the gap. The nearest features are those of bodies that meet by chance.
//
// `stacked`, `turned`, `tumbled`, `wall`, `floor`: the bodies rest on each other (place_resting).
//
// Pairs stand on a grid, clear of each other. With `sway` they move (set_swaying).
Generated make_pairs(GeneratorInput& input) {
  if (input.count % 2 != 0) {
    throw base::InputError(
        input.table.file(), 0,
        fmt::format("a count of {} was asked for; expected an even one, as the bodies "
                    "come in pairs",
                    input.count));
  }
  const std::vector<double> gaps = read_gaps(input);
  const std::size_t chosen = input.table.choice("placement", placement_names, 0);
  const auto placement =
      static_cast<Placement>(std::min(chosen, static_cast<std::size_t>(Placement::resting)));
  const auto rest = static_cast<Rest>(chosen - static_cast<std::size_t>(placement));
  const Sway sway = read_sway(input);
  Generated made;
  Scene& scene = made.scene;
  scene = make_bodies(input, {}, true, input.count);
  if (placement == Placement::resting) {
    for (const Shape& shape : scene.shapes) {
      if (can_rest(shape, rest)) continue;
      input.table.fail("shapes", rest == Rest::wall
                                     ? "found others than boxes; expected only these in a wall"
                                     : "found others than boxes and hulls; expected only these, "
                                       "as the bodies are to rest");
    }
    snap_boxes(scene);
  }
  double reach = 0;
  for (const Shape& shape : scene.shapes) {
    reach = std::max(reach, loose_reach(shape, Mat3d::Identity()));
  }
  const double widest = *std::ranges::max_element(gaps);
  const double cell = 2.5 * (2 * reach + std::max(widest, 0.0));
  const auto pairs = static_cast<std::uint32_t>(scene.bodies.size() / 2);
  std::uint32_t side = 1;
  while (std::uint64_t{side} * side * side < pairs) ++side;
  base::Random places = input.random(GeneratorInput::place_stream);
  base::Random motions = input.random(GeneratorInput::velocity_stream);
  oracle::Oracle oracle;
  std::uint32_t ground = 0;
  if (placement == Placement::resting && rest == Rest::floor) {
    Shape plane;
    plane.kind = ShapeKind::halfspace;
    ground = scene.add_shape(plane);
  }
  for (std::uint32_t i = 0; i < pairs; ++i) {
    Body& a = scene.bodies[2 * i];
    Body& b = scene.bodies[2 * i + 1];
    const double gap = gaps[i % gaps.size()];
    a.pose.translation = cell * Vec3d(i % side, i / side % side, i / side / side);
    Vec3d n = Vec3d::UnitZ();
    if (placement == Placement::resting) {
      if (rest == Rest::floor) b.shape = ground;
      place_resting(rest, gap, places, scene, a, b);
    }
    const auto face = [&] {
      n = places.on_sphere();
      b.pose.translation =
          a.pose.translation + (world_support(scene, a, n) + gap * n - world_support(scene, b, -n));
    };
    if (placement != Placement::resting) face();
    if (placement == Placement::settled || placement == Placement::meeting) {
      const oracle::Solid solid_a(scene.shapes[a.shape]), solid_b(scene.shapes[b.shape]);
      constexpr int most_tries = 100;
      int tries = 1;
      const auto is_placed = [&] {
        if (placement == Placement::settled) {
          return settle(oracle, solid_a, a.pose, solid_b, b.pose, gap);
        }
        b.pose.translation = a.pose.translation + (3 * reach + std::max(gap, 0.0)) * n;
        return meet(oracle, solid_a, a.pose, solid_b, b.pose, -n, gap);
      };
      while (!is_placed()) {
        if (++tries > most_tries) {
          throw base::InputError(
              input.table.file(), 0,
              fmt::format("no place found for bodies {} and {} at the distance {}: "
                          "expected one that these shapes can have",
                          2 * i, 2 * i + 1, gap));
        }
        face();
      }
      if (sway.share > 0) {
        const Vec3d normal = oracle.measure({solid_a, a.pose}, {solid_b, b.pose}).normal;
        if (base::length(normal) > 0) n = normal / base::length(normal);
      }
    }
    a.moving = b.moving = false;
    set_swaying(sway, n, gap, reach, motions, a, b);
    scene.pairs.push_back({2 * i, 2 * i + 1});
  }
  made.side = cell * side;
  return made;
}

}  // namespace touchstone::scene
