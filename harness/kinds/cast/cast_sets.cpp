// Pairs of convex bodies that move: towards each other, past each other, through each other, turning, and from
// a touch.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "algorithms/core/bounds.h"
#include "algorithms/hull/convex_hull.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/kinds/cast/cast_grade.h"
#include "harness/kinds/cast/cast_kind.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::kinds {
namespace {

enum class Way : std::uint8_t {
  hit,
  near_miss,
  clear_miss,
  overlapping,
  far_hit,
  turn_half,
  turn_2,
  turn_20,
  graze,
  into
};
constexpr std::array<std::string_view, 10> way_names = {"hit",
                                                        "miss by 1e-3",
                                                        "clear miss",
                                                        "overlapping at the start",
                                                        "hit from a thousand sizes",
                                                        "turning by 0.5",
                                                        "turning by 2",
                                                        "turning by 20",
                                                        "grazing by 1e-6",
                                                        "going in from a touch"};
constexpr std::array<std::string_view, 5> shape_names = {"sphere", "capsule", "box", "hull-32",
                                                         "hull-128"};

double radians(Way way) {
  switch (way) {
    case Way::turn_half: return 0.5;
    case Way::turn_2: return 2;
    case Way::turn_20: return 20;
    default: return 0;
  }
}

Shape make_shape(std::size_t kind, base::Random& random) {
  Shape shape;
  switch (kind) {
    case 0: shape.radius = random.uniform(0.3, 0.6); return shape;
    case 1:
      shape.kind = ShapeKind::capsule;
      shape.radius = random.uniform(0.15, 0.3);
      shape.half_length = random.uniform(0.2, 0.5);
      return shape;
    case 2:
      shape.kind = ShapeKind::box;
      for (int k = 0; k < 3; ++k) shape.half_extents[k] = random.uniform(0.2, 0.5);
      return shape;
    default: break;
  }
  std::vector<Vec3d> points(kind == 3 ? 32 : 128);
  for (Vec3d& point : points) point = 0.5 * random.on_sphere();
  return hull_of(std::move(points));
}

struct CastInput {
  std::vector<Shape> shapes;
  std::vector<std::uint32_t> shape_of, first, second;
  std::vector<Pose> poses;
  std::vector<Motion> motions;
  std::vector<files::CastCase> graded;  // the first ones, which are held against the oracle

  ::touchstone::CastBatch batch(std::size_t count) const {
    const ShapeKind kind = shapes.front().kind;
    return {kind,
            kind,
            {std::span(first).first(count), std::span(second).first(count), shape_of, poses},
            motions};
  }
};

void add_body(CastInput& input, Shape shape, const Pose& pose, const Motion& motion) {
  input.shape_of.push_back(static_cast<std::uint32_t>(input.shapes.size()));
  input.shapes.push_back(std::move(shape));
  input.poses.push_back(pose);
  input.motions.push_back(motion);
}

// Bodies that touch in a point, up to rounding, with a plane between them: b goes into a, or, a little
// deeper, past it along the plane.
void place_in_touch(const Shape& a, const Pose& pose_a, const Shape& b, Way way,
                    const Vec3d& normal, const Vec3d& along, Pose& pose_b, Motion& motion_b) {
  pose_b.translation += support_point(a, pose_a, normal) - support_point(b, pose_b, -normal);
  Vec3d inward = pose_a.translation - pose_b.translation;
  inward /= base::length(inward);
  if (way == Way::into) {
    motion_b.displacement = inward;
    return;
  }
  // Halfway it is as far inside as it was moved in.
  pose_b.translation += 1e-6 * inward - 3 * along;
  motion_b.displacement = 6 * along;
}

void add_pair(CastInput& input, std::size_t kind, Way way, base::Random& random) {
  Shape a = make_shape(kind, random), b = make_shape(kind, random);
  Pose pose_a{random.rotation(), random.in_ball()}, pose_b{random.rotation(), {}};
  const Vec3d direction = random.on_sphere();
  const Vec3d across = base::beside(direction, random.on_sphere());
  const double distance = way == Way::far_hit ? 1000 : way == Way::overlapping ? 0 : 3;
  double aside = random.uniform(0, 0.2);
  if (way == Way::clear_miss) aside = 4;
  if (radians(way) > 0) aside = random.uniform(0, 1.5);
  pose_b.translation = pose_a.translation + distance * direction + aside * across;
  Motion motion_a, motion_b;
  motion_b.displacement = -(way == Way::overlapping ? 1 : 2 * distance) * direction;
  if (way == Way::near_miss) {
    // The plane across `across` parts them by 1e-3 all the way.
    const oracle::Solid solid_a(a), solid_b(b);
    const oracle::Enclosure apart =
        oracle::separation_along({solid_a, pose_a}, {solid_b, pose_b}, across);
    pose_b.translation += (apart.upper + 1e-3) * across;
  }
  if (way == Way::graze || way == Way::into) {
    place_in_touch(a, pose_a, b, way, direction, across, pose_b, motion_b);
  }
  if (const double turn = radians(way); turn > 0) {
    const Vec3d axis_a = random.on_sphere();
    motion_a.rotation_vector = random.uniform(0.5, 1) * turn * axis_a;
    const Vec3d axis_b = random.on_sphere();
    motion_b.rotation_vector = random.uniform(0.5, 1) * turn * axis_b;
  }
  input.first.push_back(static_cast<std::uint32_t>(input.poses.size()));
  input.second.push_back(static_cast<std::uint32_t>(input.poses.size() + 1));
  add_body(input, std::move(a), pose_a, motion_a);
  add_body(input, std::move(b), pose_b, motion_b);
}

std::vector<files::CastCase> first_cases(const CastInput& input, std::size_t count) {
  std::vector<files::CastCase> cases(std::min(count, input.first.size()));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::uint32_t a = input.first[i], b = input.second[i];
    files::CastCase& c = cases[i];
    c.shape_a = input.shapes[input.shape_of[a]];
    c.shape_b = input.shapes[input.shape_of[b]];
    c.pose_a = input.poses[a];
    c.pose_b = input.poses[b];
    c.motion_a = input.motions[a];
    c.motion_b = input.motions[b];
  }
  return cases;
}

TimedGrade grade_cast_set(const CastInput& input, const CastEntry& entry,
                          std::optional<double> tolerance, CastTruths& truths,
                          std::span<const CastOutcome> outcomes) {
  TimedGrade sum;
  for (std::size_t i = 0; i < input.graded.size(); ++i) {
    const CastOutcome &found = outcomes[i], &right = truths.of(i);
    const double path = truths.path(i);
    const double own = cast_tolerance(entry, tolerance, path, span_of_motion(input.graded[i]));
    sum.add(grade_cast(found, right, {.place = i, .tolerance = own}, entry.in_time, truths),
            static_cast<std::int64_t>(i));
    if (is_meant(found.status) && found.answer == CastAnswer::hit &&
        right.answer == CastAnswer::hit) {
      sum.note_error(std::abs(found.toi - right.toi) * path);
    }
  }
  return sum;
}

TimedSet make_cast_set(std::size_t kind, Way way, std::size_t count, std::size_t graded,
                       std::uint64_t seed, std::optional<double> tolerance,
                       const std::vector<const CastEntry*>& entries) {
  const auto input = std::make_shared<CastInput>();
  base::Random random(seed, static_cast<std::uint64_t>(way) << 8 | kind);
  for (std::size_t i = 0; i < count; ++i) add_pair(*input, kind, way, random);
  const ShapeKind shape = input->shapes.front().kind;
  const bool turns = radians(way) > 0;
  input->graded = first_cases(*input, graded);
  const auto truths = std::make_shared<CastTruths>(input->graded);
  for (std::size_t i = 0; i < input->graded.size(); ++i) truths->of(i);
  TimedSet cell;
  cell.queries = static_cast<std::int64_t>(count);
  cell.graded = std::ssize(input->graded);
  for (const CastEntry* entry : entries) {
    if (!offers(*entry, shape, shape, turns)) continue;
    for (const Precision scalar : entry->scalars) {
      const CastSettings settings{.scalar = scalar, .tolerance = tolerance};
      const std::shared_ptr<Cast> caster = entry->make(settings);
      caster->bind(input->shapes);
      const auto outcomes = std::make_shared<std::vector<CastOutcome>>(count);
      TimedContestant made = contestant_in(*entry, scalar);
      made.answer = [=] { caster->solve(input->batch(input->first.size()), *outcomes); };
      made.grade = [=] { return grade_cast_set(*input, *entry, tolerance, *truths, *outcomes); };
      made.hash = [=] {
        return hash_of_answers(std::span<const CastOutcome>(*outcomes), [](const CastOutcome& one) {
          return hash_of_parts(one.status, one.answer, one.toi, one.lower, one.upper,
                               hash_of_point(one.normal), hash_of_point(one.point));
        });
      };
      cell.contestants.push_back(std::move(made));
    }
  }
  return cell;
}

}  // namespace

std::vector<PlannedSet> cast_sets(files::TomlTable& table, const std::filesystem::path& /*home*/) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 16, 1'000'000, 384));
  const auto graded = static_cast<std::size_t>(table.integer("graded", 16, 1'000'000, 384));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  std::optional<double> tolerance;
  if (table.has("tolerance")) tolerance = table.number("tolerance", files::positive);
  const std::vector<std::size_t> ways = choices(table, "ways", way_names);
  const std::vector<std::size_t> shapes = choices(table, "shapes", shape_names);
  const auto entries = selected(table, registry::entries<CastEntry>(), "cast");
  std::vector<PlannedSet> cells;
  for (const std::size_t way : ways) {
    for (const std::size_t shape : shapes) {
      cells.push_back({std::string(way_names[way]), std::string(shape_names[shape]), [=] {
                         return make_cast_set(shape, static_cast<Way>(way), count, graded, seed,
                                              tolerance, entries);
                       }});
    }
  }
  return cells;
}

}  // namespace touchstone::kinds
