// Generators of bodies that lie on each other or hang in each other.
#include <algorithm>
#include <cmath>

#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"
#include "harness/scene/generators/world_size.h"

namespace touchstone::scene {

// Generator `stack`: piles of boxes that rest face to face.

// Makes piles of `height` cubes of side `size` on a square grid with `gap` sides between them; gap
// 0 makes a solid block. Faces touch exactly if size is a power of two. `turned` rotates each pile
// about z.
Generated make_stack(GeneratorInput& input) {
  const double size = input.table.number("size", files::positive, 1.0);
  const std::int64_t height = input.table.integer("height", 1, 1'000'000, 10);
  const double gap = input.table.number("gap", files::not_negative, 0.5);
  const bool turned = input.table.boolean("turned", false);

  Generated made;
  Scene& scene = made.scene;
  Shape cube;
  cube.kind = ShapeKind::box;
  cube.half_extents = Vec3d::Constant(size / 2);
  scene.shapes = {cube};
  const std::int64_t piles = (input.count + height - 1) / height;
  std::int64_t row = 1;
  while (row * row < piles) ++row;
  base::Random poses = input.random(GeneratorInput::pose_stream);
  Mat3d rotation = Mat3d::Identity();
  const double step = size * (1 + gap);
  for (std::int64_t i = 0; i < input.count; ++i) {
    const std::int64_t pile = i / height, level = i % height;
    if (turned && level == 0) {
      const base::SinCos turn = base::sin_cos_turns(poses.unit());
      rotation << turn.cos, -turn.sin, 0, turn.sin, turn.cos, 0, 0, 0, 1;
    }
    Body body;
    body.pose.rotation = rotation;
    body.pose.translation = {static_cast<double>(pile % row) * step,
                             static_cast<double>(pile / row) * step,
                             (static_cast<double>(level) + 0.5) * size};
    scene.bodies.push_back(body);
  }
  set_in_motion(input, {.moving = 0.1, .speed = 0.1 * size, .spin = 0}, 0, scene);
  // The walls leave room for one more cube on every side.
  const double across = static_cast<double>(row) * step;
  made.side = across;
  set_walls(input, {-step, -step, 0}, {across, across, (static_cast<double>(height) + 1) * size},
            scene);
  return made;
}

// Generator `cards`: decks of thin cards that are dealt in one frame.

namespace {

constexpr std::int64_t deck = 52;
constexpr double card_length = 0.088, card_width = 0.063, card_thickness = 0.0003;  // metres
constexpr double hand_distance = 0.3;  // from the deck, metres

}  // namespace

// Each deck of 52 cards lies face on face with `gap` metres between cards. In a frame every card goes
// straight to one of `players` hands around, in turn from the top; the first to come lies lowest
// there. On the way it turns about the vertical by up to `spin` and wobbles by up to `wobble`, both
// in radians a second. With a gap of 0 cards touch and slide.
Generated make_cards(GeneratorInput& input) {
  const double gap = input.table.number("gap", files::not_negative, 0.00005);
  const std::int64_t players = input.table.integer("players", 1, 1000, 4);
  const double spin = input.table.number("spin", files::not_negative, 90.0);
  const double wobble = input.table.number("wobble", files::not_negative, 1.0);
  const double time_step =
      input.table.number("time_step", {.low = 1e-9, .high = 1e6}, Motion{}.time_step);

  Generated made;
  Scene& scene = made.scene;
  Shape card;
  card.kind = ShapeKind::box;
  card.half_extents = {card_length / 2, card_width / 2, card_thickness / 2};
  scene.shapes = {card};
  const std::int64_t decks = (input.count + deck - 1) / deck;
  std::int64_t row = 1;
  while (row * row < decks) ++row;
  const double space = 4 * hand_distance;
  made.side = space * static_cast<double>(row);
  base::Random velocities = input.random(GeneratorInput::velocity_stream);
  const double level = card_thickness + gap;
  for (std::int64_t i = 0; i < input.count; ++i) {
    const std::int64_t in_deck = i % deck, from_top = deck - 1 - in_deck;
    Body body;
    body.pose.translation = {space * static_cast<double>(i / deck % row),
                             space * static_cast<double>(i / deck / row),
                             (static_cast<double>(in_deck) + 0.5) * level};
    const base::SinCos hand =
        base::sin_cos_turns(static_cast<double>(from_top % players) / static_cast<double>(players));
    const double height = (static_cast<double>(from_top / players) + 0.5) * level;
    const Vec3d way = {hand_distance * hand.cos, hand_distance * hand.sin,
                       height - body.pose.translation.z()};
    body.velocity = way / time_step;
    const Vec3d shake = wobble * velocities.in_ball();
    body.angular_velocity = {shake.x(), shake.y(), spin * velocities.uniform(-1, 1)};
    scene.bodies.push_back(body);
  }
  return made;
}

// Generator `chain`: rings that hang in each other.

namespace {

double extent(const Aabb& box, std::size_t axis) {
  return static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis]);
}

}  // namespace

// Chains lie along x, side by side along y. Each link is turned by a quarter about x against the one
// before. A link's length is its width along x, and its thickness that along z: rings of a round tube
// that are pulled taut are length - 2 thickness apart, and `slack` of that nearer here, so that they
// do not touch.
Generated make_chain(GeneratorInput& input) {
  const double slack = input.table.number("slack", {.low = -0.5, .high = 0.5}, 0.05);
  const auto strands = input.table.integer("strands", 1, 1'000'000, 1);
  Generated made{make_bodies(input, {}, false, input.count), 0};
  Scene& scene = made.scene;
  const std::vector<Aabb> boxes = boxes_at_origin(scene);
  double pitch = 0, across = 0;
  for (const Aabb& box : boxes) {
    pitch = std::max(pitch, (extent(box, 0) - 2 * extent(box, 2)) * (1 - slack));
    across = std::max({across, extent(box, 1), extent(box, 2)});
  }
  if (!(pitch > 0)) {
    input.table.fail("shapes",
                     "no link is longer along x than twice its width along z; expected rings "
                     "around z, such as {type = \"torus\"}");
  }
  const std::int64_t links = (input.count + strands - 1) / strands;  // of a chain
  Mat3d quarter;
  quarter << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Vec3d high = Vec3d::Constant(across);
  for (std::int64_t i = 0; i < input.count; ++i) {
    const std::int64_t link = i % links;
    Pose& pose = scene.bodies[static_cast<std::size_t>(i)].pose;
    pose.translation = {static_cast<double>(link) * pitch,
                        static_cast<double>(i / links) * across * 1.1, 0};
    if (link % 2 == 1) pose.rotation = base::product(quarter, pose.rotation);
    high = high.cwiseMax(pose.translation + Vec3d::Constant(across));
  }
  made.side = high.maxCoeff();
  set_in_motion(input, {.speed = 0.1 * pitch, .spin = 0.1}, 0, scene);
  set_walls(input, Vec3d::Constant(-across), high, scene);
  return made;
}

}  // namespace touchstone::scene
