// Draws moving bodies.
#include "harness/kinds/cast/cast_kind.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "harness/families/grid_touches.h"
#include "harness/families/meshes.h"
#include "harness/families/moving_pairs.h"

namespace touchstone::kinds {
namespace {

using families::ContactFeature;
using families::Draws;
using families::MovingPairCase;
using files::CastCase;

CastCase case_of(const MovingPairCase& c) {
  CastCase out;
  out.shape_a = c.a;
  out.shape_b = c.b;
  out.pose_a = c.pose_a;
  out.pose_b = c.pose_b;
  out.motion_a = c.motion_a;
  out.motion_b = c.motion_b;
  return out;
}

// Every fifth pair has a kind whose exact answer is an enclosure.
ShapeKind any_kind(Draws& draws, std::uint64_t index) {
  constexpr std::array quick = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::hull};
  constexpr std::array smooth = {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid};
  if (index % 5 == 4) return smooth[static_cast<std::size_t>(draws.below(3))];
  return quick[static_cast<std::size_t>(draws.below(4))];
}
ShapeKind quick_kind(Draws& draws) { return any_kind(draws, 0); }

constexpr std::array all_features = {ContactFeature::vertices, ContactFeature::face,
                                     ContactFeature::edges};
ContactFeature any_feature(Draws& draws) {
  return all_features[static_cast<std::size_t>(draws.below(3))];
}

CastCase meet(ContactFeature feature, Draws& draws, std::uint64_t index) {
  const ShapeKind a = any_kind(draws, index), b = quick_kind(draws);
  const double toi = index % 7 == 0 ? 1 : draws.uniform(0, 1);
  return case_of(families::meeting(a, b, feature, toi, draws.uniform(0.1, 10), draws));
}

CastCase pass(double gap, Draws& draws, std::uint64_t index) {
  const ShapeKind a = any_kind(draws, index), b = quick_kind(draws);
  const double path = draws.uniform(0.5, 4);
  const ContactFeature feature = any_feature(draws);
  return case_of(families::passing(a, b, feature, gap, path, draws));
}

// At every size and path: by 2^-20 to 2^20, and 10^-6 to 10^6 of the size.
CastCase every_scale(Draws& draws, std::uint64_t index) {
  const ShapeKind a = quick_kind(draws), b = quick_kind(draws);
  const double scale = std::ldexp(1, draws.below(41) - 20);
  const double path = std::ldexp(1, draws.below(41) - 20);
  const double toi = index % 2 == 0 ? draws.uniform(0, 1) : 0;
  const ContactFeature feature = any_feature(draws);
  const MovingPairCase c = index % 2 == 0 ? families::meeting(a, b, feature, toi, path, draws)
                                          : families::passing(a, b, feature, 1e-6, path, draws);
  return case_of(families::scaled(c, scale));
}

CastCase far_path(Draws& draws, std::uint64_t index) {
  const ShapeKind a = quick_kind(draws), b = quick_kind(draws);
  const ContactFeature feature = any_feature(draws);
  return case_of(index % 2 == 0 ? families::meeting(a, b, feature, draws.uniform(0, 1), 1000, draws)
                                : families::passing(a, b, feature, 1e-3, 1000, draws));
}

CastCase alike(Draws& draws, std::uint64_t index) {
  constexpr std::array gaps = {1e-6, 0.3, -1e-6, -0.2};
  const ShapeKind b = quick_kind(draws), a = any_kind(draws, index);
  MovingPairCase c =
      families::passing(a, b, ContactFeature::face, gaps[index % gaps.size()], 0, draws);
  c.motion_a = c.motion_b = {};
  return case_of(index % 3 == 0 ? c : families::drifting(c, draws.vector(10)));
}

// Boxes on a grid, whose contact is exact: with faces, edges or vertices, at any quarter of the time.
CastCase on_a_grid(Draws& draws, std::uint64_t /*index*/) {
  const auto whole = [&](int reach) {
    return static_cast<double>(draws.below(2 * reach + 1) - reach);
  };
  const auto vector = [&](int reach) {
    const double x = whole(reach), y = whole(reach);
    return Vec3d(x, y, whole(reach));
  };
  MovingPairCase c;
  c.a = families::box_shape({1, 1, 1});
  c.b = draws.below(2) == 0 ? families::box_shape({1, 0.5, 0.25})
                            : families::hull_shape({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const Vec3d velocity = vector(4);
  c.pose_b.translation = vector(3) - velocity;
  c.motion_b.displacement = 2 * velocity;
  return case_of(c);
}

CastCase from_touch(Draws& draws, std::uint64_t index) {
  return case_of(families::touching_on_grid(static_cast<families::AfterTouch>(index % 4), draws));
}

CastCase overlapping(Draws& draws, std::uint64_t index) {
  const ShapeKind b = quick_kind(draws), a = any_kind(draws, index);
  MovingPairCase c = families::passing(a, b, ContactFeature::vertices, -0.1, 1, draws);
  c.pose_b.translation += 0.5 * c.motion_b.displacement;  // it begins in the middle
  return case_of(c);
}

CastCase thin_plate(Draws& draws, std::uint64_t index) {
  MovingPairCase c;
  c.a = families::box_shape({1, 1, 1e-4});
  c.b = index % 2 == 0 ? families::round_shape(ShapeKind::sphere, 0.01, 0)
                       : families::box_shape({0.01, 0.01, 0.01});
  const double x = draws.uniform(-0.9, 0.9), y = draws.uniform(-0.9, 0.9);
  c.pose_b.translation = {x, y, 1};
  c.motion_b.displacement = {0, 0, draws.uniform(-20, -0.5)};
  return case_of(c);
}

MovingPairCase any_turning(double radians, Draws& draws) {
  const ShapeKind a = quick_kind(draws), b = quick_kind(draws);
  return families::turning(a, b, radians, draws);
}

void add_axes_of_motion(std::vector<DrawnFamily<CastCase>>& list) {
  const auto add = [&](const char* axis, const std::vector<AxisValue>& values, int one_in,
                       const auto& draw) {
    for (const AxisValue& at : values) {
      list.push_back({fmt::format("{}-{}", axis, at.name), "axes", one_in,
                      [draw, size = at.value](Draws& draws, std::uint64_t index) {
                        return draw(size, draws, index);
                      },
                      axis, at.name});
    }
  };
  add("cast-speed", decades(0, 12), 1, [](double path, Draws& draws, std::uint64_t index) {
    const ShapeKind a = quick_kind(draws), b = quick_kind(draws);
    const ContactFeature feature = any_feature(draws);
    return case_of(index % 2 == 0
                       ? families::meeting(a, b, feature, draws.uniform(0, 1), path, draws)
                       : families::passing(a, b, feature, 1e-3, path, draws));
  });
  add("cast-slowness", decades(0, -12), 1, [](double path, Draws& draws, std::uint64_t index) {
    const ShapeKind a = quick_kind(draws), b = quick_kind(draws);
    const ContactFeature feature = any_feature(draws);
    return case_of(index % 2 == 0
                       ? families::meeting(a, b, feature, draws.uniform(0, 1), path, draws)
                       : families::passing(a, b, feature, 0.5 * path, path, draws));
  });
  add("cast-graze", decades(-1, -15), 1, [](double depth, Draws& draws, std::uint64_t index) {
    return pass(-depth, draws, 5 * index);
  });
  add("cast-gap", decades(-1, -15), 1,
      [](double gap, Draws& draws, std::uint64_t index) { return pass(gap, draws, 5 * index); });
  std::vector<AxisValue> turns;
  for (int e = -3; e <= 8; ++e)
    turns.push_back({fmt::format("{:g}", std::ldexp(1, e)), std::ldexp(1, e)});
  add("cast-turn", turns, 8, [](double radians, Draws& draws, std::uint64_t) {
    return case_of(any_turning(radians, draws));
  });
}

}  // namespace

std::span<const DrawnFamily<CastCase>> cast_families() {
  static const auto all = [] {
    std::vector<DrawnFamily<CastCase>> list;
    const auto add = [&](const char* name, auto draw) { list.push_back({name, "casts", 1, draw}); };
    constexpr std::array<const char*, 3> meets = {"casts-meet-vertices", "casts-meet-face",
                                                  "casts-meet-edges"};
    for (std::size_t i = 0; i < meets.size(); ++i) {
      add(meets[i], [feature = all_features[i]](Draws& draws, std::uint64_t index) {
        return meet(feature, draws, index);
      });
    }
    constexpr std::array<std::pair<const char*, double>, 7> gaps = {{{"casts-pass-1e-1", 1e-1},
                                                                     {"casts-pass-1e-3", 1e-3},
                                                                     {"casts-graze-1e-6", -1e-6},
                                                                     {"casts-graze-1e-12", -1e-12},
                                                                     {"casts-pass-1e-6", 1e-6},
                                                                     {"casts-pass-1e-12", 1e-12},
                                                                     {"casts-pass-deep", -0.1}}};
    for (const auto& [name, gap] : gaps) {
      add(name, [gap](Draws& draws, std::uint64_t index) { return pass(gap, draws, index); });
    }
    add("casts-on-a-grid", on_a_grid);
    add("casts-from-touch", from_touch);
    add("casts-overlapping", overlapping);
    add("casts-alike", alike);
    add("casts-far-path", far_path);
    add("casts-thin-plate", thin_plate);
    add("casts-every-scale", every_scale);
    // Of every size, by 2^-20 to 2^20.
    const auto turn = [&](const char* name, int one_in, auto draw) {
      list.push_back({name, "turns", one_in, [draw](Draws& draws, std::uint64_t index) {
                        const MovingPairCase c = draw(draws, index);
                        return case_of(families::scaled(c, std::ldexp(1, draws.below(41) - 20)));
                      }});
    };
    constexpr std::array<std::pair<const char*, double>, 3> turns = {
        {{"turns-half-a-radian", 0.5}, {"turns-3-radians", 3}, {"turns-30-radians", 30}}};
    for (const auto& [name, radians] : turns) {
      turn(name, 8, [radians](Draws& draws, std::uint64_t) { return any_turning(radians, draws); });
    }
    turn("turns-needle", 8, [](Draws& draws, std::uint64_t index) {
      return families::turning_needle(index % 2 == 0, draws);
    });
    turn("turns-several", 8, [](Draws& draws, std::uint64_t index) {
      return families::sinking_rod(index % 2 == 0, draws);
    });
    turn("turns-far-pivot", 8, [](Draws& draws, std::uint64_t index) {
      return families::far_pivot(index % 2 == 0, draws);
    });
    turn("turns-tangential", 8, [](Draws&, std::uint64_t index) {
      constexpr std::array corners = {1e-2, 1e-5, 1e-7, -1e-7, -1e-5, -1e-2};
      return families::passing_corner(corners[index % corners.size()]);
    });
    turn("turns-from-touch", 8, [](Draws& draws, std::uint64_t index) {
      const auto after = static_cast<families::AfterTouch>(index % 4);
      MovingPairCase c = families::touching_on_grid(after, draws);
      c.motion_b.rotation_vector = draws.vector(1);
      return c;
    });
    add_axes_of_motion(list);
    return list;
  }();
  return all;
}

}  // namespace touchstone::kinds
