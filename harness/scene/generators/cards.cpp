// Generator `cards`: decks of thin cards that are dealt in one frame.
#include <cmath>

#include "harness/base/plain_math.h"
#include "harness/base/reproducible_math.h"
#include "harness/scene/generators/generators.h"

namespace touchstone::scene {
namespace {

constexpr std::int64_t deck = 52;
constexpr double length = 0.088, width = 0.063, thickness = 0.0003;  // metres
constexpr double hand_distance = 0.3;                                // from the deck, metres

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
  card.half_extents = {length / 2, width / 2, thickness / 2};
  scene.shapes = {card};
  const std::int64_t decks = (input.count + deck - 1) / deck;
  std::int64_t row = 1;
  while (row * row < decks) ++row;
  const double space = 4 * hand_distance;
  made.side = space * static_cast<double>(row);
  base::Random velocities = input.random(GeneratorInput::velocity_stream);
  const double level = thickness + gap;
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

}  // namespace touchstone::scene
