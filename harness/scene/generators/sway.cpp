// Small motions of pairs around their placed poses.
#include "harness/scene/generators/sway.h"

#include <cmath>

#include "harness/base/reproducible_math.h"

namespace touchstone::scene {
namespace {

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

}  // namespace

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

}  // namespace touchstone::scene
