// Convex bodies that slide over a flat ground of triangles. Every contact should push straight up: one that leans is
// a ghost, as it stops the body at an edge inside of the surface.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "algorithms/core/bounds.h"
#include "algorithms/core/nearest_float.h"
#include "algorithms/registry.h"
#include "harness/base/random.h"
#include "harness/kinds/mesh/mesh_kind.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::kinds {
namespace {

constexpr std::array<std::string_view, 2> ground_names = {"fine", "coarse"};
constexpr std::array<std::size_t, 2> ground_squares = {40, 4};  // on each side of [-1, 1]
constexpr double body_size = 0.2;                               // greatest half extent, metres
constexpr double body_depth = 0.002;                            // metres below the ground
// A contact leans if its normal is further than this from straight up (radians).
constexpr double greatest_lean = 1e-3;
// A depth that is off by more than this is wrong (metres).
constexpr double greatest_depth_error = 1e-3 * body_size;

std::shared_ptr<const TriangleMesh> flat_ground(std::size_t squares) {
  auto mesh = std::make_shared<TriangleMesh>();
  const auto across = static_cast<std::uint32_t>(squares + 1);
  for (std::uint32_t i = 0; i < across; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const auto place = [&](std::uint32_t k) {
        return 2.0 * k / static_cast<double>(squares) - 1;
      };
      mesh->vertices.push_back(nearest_float(Vec3d(place(i), place(j), 0)));
    }
  }
  for (std::uint32_t i = 0; i + 1 < across; ++i) {
    for (std::uint32_t j = 0; j + 1 < across; ++j) {
      const std::uint32_t at = i * across + j;
      mesh->triangles.push_back({at, at + across, at + across + 1});
      mesh->triangles.push_back({at, at + across + 1, at + 1});
    }
  }
  return mesh;
}

struct SlidingInput {
  std::array<ConcaveBody, 2> bodies;  // the ground, and what slides on it
  std::vector<std::pair<PlacedConcave, PlacedConcave>> asked;
  std::vector<Vec3d> up;  // of each: the ground's normal
};

struct SlidingAnswers {
  std::vector<Outcome> outcomes;
  std::vector<std::vector<IndexPair>> pairs;
  std::vector<std::vector<PartContact>> contacts;

  std::uint64_t hash() const {
    std::uint64_t sum = hash_of_answers(std::span<const Outcome>(outcomes), hash_of_outcome);
    for (const std::vector<PartContact>& of_pair : contacts) {
      for (const PartContact& contact : of_pair) {
        sum = base::mix(sum ^ hash_of_parts(contact.parts.a, contact.parts.b, contact.status,
                                            hash_of_point(contact.normal), contact.depth,
                                            hash_of_point(contact.point)));
      }
    }
    return sum;
  }
};

SlidingInput make_sliding_input(std::size_t squares, std::string_view body, std::size_t count,
                                std::uint64_t seed) {
  base::Random random(seed, squares);
  SlidingInput input;
  const Shape shape = convex_shape(body, body_size, random);
  input.bodies = {ConcaveBody{flat_ground(squares), {}}, ConcaveBody{nullptr, {{shape, {}, 0}}}};
  const auto rotation = [&] {
    Mat3d turned = random.rotation();
    for (int k = 0; k < 3; ++k) turned.col(k) = nearest_float(Vec3d(turned.col(k)));
    return turned;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const PlacedConcave ground{0, {rotation(), Vec3d::Zero()}};
    PlacedConcave slider{1, {rotation(), Vec3d::Zero()}};
    const Vec3d up = ground.pose.rotation.col(0).cross(ground.pose.rotation.col(1)).normalized();
    const double below = -up.dot(support_point(shape, slider.pose, -up));
    const double y = random.uniform(-0.7, 0.7), x = random.uniform(-0.7, 0.7);
    const Vec3d at(x, y, 0);
    slider.pose.translation = nearest_float(Vec3d(ground.pose(at) + (below - body_depth) * up));
    input.asked.emplace_back(ground, slider);
    input.up.push_back(up);
  }
  return input;
}

// A contact that pushes straight up is there; one that leans is a false one, and without any the contact is missed.
Graded grade_slide(const SlidingInput& input, const SlidingAnswers& answers, std::size_t i,
                   TimedGrade& sum) {
  if (!is_meant(answers.outcomes[i].status)) return {Grade::gave_up, true};
  bool leans = false, pushes_up = false;
  double deepest = 0;
  for (const PartContact& contact : answers.contacts[i]) {
    if (!contact.normal.allFinite()) continue;
    const double lean =
        std::atan2(input.up[i].cross(contact.normal).norm(), input.up[i].dot(contact.normal));
    sum.note_error(lean);
    (lean > greatest_lean ? leans : pushes_up) = true;
    if (lean <= greatest_lean) deepest = std::max(deepest, contact.depth);
  }
  if (!pushes_up) return {Grade::missed, true};
  if (leans) return {Grade::false_hit, true};
  const bool is_off = std::abs(deepest - body_depth) > greatest_depth_error;
  return {is_off ? Grade::inexact : Grade::right, true};
}

TimedGrade grade_sliding_set(const SlidingInput& input, const SlidingAnswers& answers) {
  TimedGrade sum;
  for (std::size_t i = 0; i < input.asked.size(); ++i) {
    sum.add(grade_slide(input, answers, i, sum), static_cast<std::int64_t>(i));
  }
  return sum;
}

TimedContestant sliding_contestant(const std::shared_ptr<const SlidingInput>& input,
                                   const ConcaveEntry& entry, Precision scalar, bool welds) {
  const std::shared_ptr<ConcavePhase> phase = make_phase(entry, scalar, welds);
  phase->bind(input->bodies);
  const auto answers = std::make_shared<SlidingAnswers>();
  const std::size_t count = input->asked.size();
  answers->outcomes.resize(count);
  answers->pairs.resize(count);
  answers->contacts.resize(count);
  TimedContestant made;
  made.name = entry.info.name;
  if (entry.scalars.size() > 1) made.name += fmt::format(" {}", to_string(scalar));
  if (welds) made.name += " welded";
  made.origin = entry.info.origin;
  // Alone, triangles push aside, which is right for each and wrong for the ground.
  made.approximate = entry.approximate || !welds;
  made.answer = [=] {
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [ground, slider] = input->asked[i];
      answers->outcomes[i] = {};
      phase->solve(ConcaveTask::contacts, ground, slider, answers->outcomes[i], answers->pairs[i]);
      phase->measure(ground, slider, answers->pairs[i], answers->contacts[i]);
    }
  };
  made.grade = [=] { return grade_sliding_set(*input, *answers); };
  made.hash = [=] { return answers->hash(); };
  return made;
}

TimedSet make_sliding_set(std::size_t squares, std::string_view body, std::size_t count,
                          std::uint64_t seed, const std::vector<const ConcaveEntry*>& entries) {
  const auto input =
      std::make_shared<const SlidingInput>(make_sliding_input(squares, body, count, seed));
  TimedSet cell;
  cell.queries = cell.graded = static_cast<std::int64_t>(count);
  for (const ConcaveEntry* entry : entries) {
    if (!entry->measures) continue;
    if (entry->supports != nullptr && !entry->supports(input->bodies[0], input->bodies[1]))
      continue;
    for (const Precision scalar : entry->scalars) {
      if (!offers(*entry, ConcaveTask::contacts, scalar)) continue;
      cell.contestants.push_back(sliding_contestant(input, *entry, scalar, false));
      if (entry->welds) cell.contestants.push_back(sliding_contestant(input, *entry, scalar, true));
    }
  }
  return cell;
}

}  // namespace

std::vector<PlannedSet> sliding_sets(files::TomlTable& table) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 6, 100'000, 128));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const std::vector<std::size_t> grounds = choices(table, "grounds", ground_names);
  const std::vector<std::size_t> bodies = choices(table, "bodies", convex_names);
  const auto entries = selected(table, registry::entries<ConcaveEntry>(), "concave phase");
  std::vector<PlannedSet> cells;
  for (const std::size_t ground : grounds) {
    const std::size_t squares = ground_squares[ground];
    for (const std::size_t body : bodies) {
      cells.push_back(
          {fmt::format("{} ground, {} triangles", ground_names[ground], 2 * squares * squares),
           std::string(convex_names[body]),
           [=] { return make_sliding_set(squares, convex_names[body], count, seed, entries); }});
    }
  }
  return cells;
}

}  // namespace touchstone::kinds
