// Pairs of one mesh with itself, and of a mesh and a small convex body: a gap away from each other, touching,
// and deep in each other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/core/nearest_float.h"
#include "algorithms/hull/convex_hull.h"
#include "algorithms/registry.h"
#include "harness/base/hash.h"
#include "harness/base/random.h"
#include "harness/base/reproducible_math.h"
#include "harness/kinds/mesh/mesh_grade.h"
#include "harness/kinds/mesh/mesh_kind.h"
#include "harness/kinds/mesh_inputs.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::kinds {
namespace {

enum class MeshPlace : std::uint8_t { gap_10, gap_1, touching, deep };
constexpr std::array<std::string_view, 4> mesh_place_names = {"gap 10 %", "gap 1 %", "touching",
                                                              "deep"};
constexpr std::array<std::string_view, 3> concave_task_names = {"intersect", "distance",
                                                                "contacts"};
// The oracle tests all pairs of triangles of meshes up to this size. The answers of larger ones are those
// of `part-pairs`, which are exact too, by signs that are proven.
constexpr std::size_t most_exact_triangles = 3000;
// The greatest half extent of a convex body, as a part of the mesh's.
constexpr double convex_size = 0.05;

// The second body is the last one: the convex one, or the mesh again.
struct ConcaveInput {
  std::vector<ConcaveBody> bodies;
  double size = 0;  // half of the second body's greatest extent, metres
  std::uint32_t second() const { return static_cast<std::uint32_t>(bodies.size() - 1); }
  std::vector<std::pair<PlacedConcave, PlacedConcave>> asked;
  std::vector<MeshAnswer> exact;
};

// The answers of a phase to all pairs.
struct MeshAnswers {
  std::vector<Outcome> outcomes;
  std::vector<std::vector<IndexPair>> lists;  // kept, so that no call allocates

  explicit MeshAnswers(std::size_t count) : outcomes(count), lists(count) {}
  void ask(ConcavePhase& phase, ConcaveTask task, const ConcaveInput& input) {
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      outcomes[i] = {};
      lists[i].clear();
      phase.solve(task, input.asked[i].first, input.asked[i].second, outcomes[i], lists[i]);
    }
  }
  MeshAnswer of(std::size_t i) const {
    const Outcome& outcome = outcomes[i];
    return {outcome.status, outcome.answer,  outcome.distance,         outcome.lower,
            outcome.upper,  lists[i].size(), base::pair_hash(lists[i])};
  }
  std::uint64_t hash() const {
    std::uint64_t sum = hash_of_answers(std::span<const Outcome>(outcomes), hash_of_outcome);
    for (const std::vector<IndexPair>& list : lists) sum = base::mix(sum ^ base::pair_hash(list));
    return sum;
  }
};

// Rotations are random, and rounded to floats with all translations, so that peers see the same bodies.
PlacedConcave placed(std::uint32_t body, base::Random& random) {
  PlacedConcave placed{body, {random.rotation(), Vec3d::Zero()}};
  for (int k = 0; k < 3; ++k)
    placed.pose.rotation.col(k) = nearest_float(Vec3d(placed.pose.rotation.col(k)));
  return placed;
}

// The way from a point of a to b: from the mesh's origin, or from a point of its surface, away from it
// within half a right angle or so.
struct Approach {
  Vec3d start, direction;
};
Approach approach_of(const ConcaveInput& input, const PlacedConcave& a, base::Random& random) {
  const Vec3d any = random.on_sphere();
  if (input.second() == 0) return {Vec3d::Zero(), any};
  const TriangleMesh& mesh = *input.bodies[0].mesh;
  const auto& corners = mesh.triangles[random.next() % mesh.triangles.size()];
  const Vec3d &p = mesh.vertices[corners[0]], &q = mesh.vertices[corners[1]],
              &r = mesh.vertices[corners[2]];
  const Vec3d outward = a.pose.rotation * (q - p).cross(r - p).normalized();
  return {a.pose((p + q + r) / 3), (outward + 0.5 * any).normalized()};
}

// Moves b along the way to where the bodies first touch, by bisection, and from there to its place.
void place_pair(ConcaveInput& input, MeshPlace place, ConcavePhase& phase, base::Random& random) {
  const PlacedConcave a = placed(0, random);
  PlacedConcave b = placed(input.second(), random);
  const Approach way = approach_of(input, a, random);
  const auto at = [&](double distance) {
    b.pose.translation = nearest_float(Vec3d(way.start + distance * way.direction));
    Outcome outcome;
    std::vector<IndexPair> pairs;
    phase.solve(ConcaveTask::intersect, a, b, outcome, pairs);
    return outcome.answer != Answer::separated;
  };
  double in = 0, out = 4 * input.size;
  for (int step = 0; step < 22; ++step) {
    const double middle = 0.5 * (in + out);
    (at(middle) ? in : out) = middle;
  }
  // Meshes reach 0.2 % of their size into each other, a small convex body 2 %.
  const double depth = input.second() == 0 ? 0.004 : 0.04;
  switch (place) {
    case MeshPlace::gap_10: at(out + 0.2 * input.size); break;
    case MeshPlace::gap_1: at(out + 0.02 * input.size); break;
    case MeshPlace::touching: at(in - depth * input.size); break;
    case MeshPlace::deep: at(0.5 * in); break;
  }
  input.asked.emplace_back(a, b);
}

TimedGrade grade_mesh_set(const ConcaveInput& input, ConcaveTask task, Precision scalar,
                          const MeshAnswers& answers) {
  TimedGrade sum;
  for (std::size_t i = 0; i < input.exact.size(); ++i) {
    const auto& [a, b] = input.asked[i];
    const MeshAnswer found = answers.of(i), &right = input.exact[i];
    const double reach = mesh_reach(input.bodies[a.body], a.pose, input.bodies[b.body], b.pose);
    sum.add(grade_mesh(task, found, right, &right, scalar, reach), static_cast<std::int64_t>(i));
    if (is_meant(found.status) && right.answer == Answer::separated &&
        task == ConcaveTask::distance) {
      sum.note_error(std::abs(found.distance - right.distance) / input.size);
    }
  }
  return sum;
}

// The bodies of a set. Without a name of a convex shape the mesh meets itself.
struct MeshBodies {
  std::shared_ptr<const TriangleMesh> mesh;
  std::string_view convex;
};

TimedSet make_mesh_set(const MeshBodies& bodies, MeshPlace place, ConcaveTask task,
                       std::size_t count, std::uint64_t seed,
                       const std::vector<const ConcaveEntry*>& entries) {
  const auto input = std::make_shared<ConcaveInput>();
  const auto& mesh = bodies.mesh;
  input->bodies.push_back({mesh, {}});
  for (const Vec3d& v : mesh->vertices)
    input->size = std::max(input->size, v.cwiseAbs().maxCoeff());
  if (!bodies.convex.empty()) {
    input->size *= convex_size;
    base::Random shape(seed, 100);
    input->bodies.push_back({nullptr, {{convex_shape(bodies.convex, input->size, shape), {}, 0}}});
  }
  const std::unique_ptr<ConcavePhase> placing =
      make_phase(*registry::find<ConcaveEntry>("fused"), Precision::float64, false);
  placing->bind(input->bodies);
  base::Random random(seed, static_cast<std::uint64_t>(place));
  for (std::size_t i = 0; i < count; ++i) place_pair(*input, place, *placing, random);

  const bool brute = mesh->triangles.size() <= most_exact_triangles;
  const std::unique_ptr<ConcavePhase> asked = make_phase(
      *registry::find<ConcaveEntry>(brute ? "exact" : "part-pairs"), Precision::float64, false);
  asked->bind(input->bodies);
  MeshAnswers truth(count);
  truth.ask(*asked, task, *input);
  for (std::size_t i = 0; i < count; ++i) {
    MeshAnswer& exact = input->exact.emplace_back(truth.of(i));
    if (std::isnan(exact.lower)) exact.lower = exact.upper = exact.distance;
  }
  TimedSet cell;
  cell.queries = cell.graded = static_cast<std::int64_t>(count);
  if (!brute) cell.truth = "proven-fast";
  for (const ConcaveEntry* entry : entries) {
    if (entry->supports != nullptr && !entry->supports(input->bodies[0], input->bodies.back()))
      continue;
    for (const Precision scalar : entry->scalars) {
      if (!offers(*entry, task, scalar)) continue;
      const std::shared_ptr<ConcavePhase> phase = make_phase(*entry, scalar, false);
      phase->bind(input->bodies);
      const auto answers = std::make_shared<MeshAnswers>(count);
      TimedContestant made = contestant_in(*entry, scalar);
      made.approximate |= entry->approximate;
      made.answer = [=] { answers->ask(*phase, task, *input); };
      made.grade = [=] { return grade_mesh_set(*input, task, scalar, *answers); };
      made.hash = [=] { return answers->hash(); };
      cell.contestants.push_back(std::move(made));
    }
  }
  return cell;
}

}  // namespace

std::vector<PlannedSet> mesh_sets(files::TomlTable& table, const std::filesystem::path& home) {
  const auto count = static_cast<std::size_t>(table.integer("queries", 6, 100'000, 32));
  const auto seed = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  const std::vector<std::size_t> places = choices(table, "places", mesh_place_names);
  const std::vector<std::size_t> tasks = choices(table, "tasks", concave_task_names);
  const auto entries = selected(table, registry::entries<ConcaveEntry>(), "concave phase");
  std::vector<PlannedSet> cells;
  const auto add = [&](const std::string& group, const MeshBodies& bodies, std::size_t task,
                       std::size_t place) {
    cells.push_back(
        {group, fmt::format("{}, {}", concave_task_names[task], mesh_place_names[place]), [=] {
           return make_mesh_set(bodies, static_cast<MeshPlace>(place),
                                static_cast<ConcaveTask>(task), count, seed, entries);
         }});
  };
  for (const std::string& name : table.texts("meshes", {"torus-2000", "trefoil-10000"})) {
    const auto mesh = std::make_shared<const TriangleMesh>(mesh_of(name, home, table, "meshes"));
    for (const std::size_t task : tasks) {
      for (const std::size_t place : places) {
        add(fmt::format("{}, {} triangles", name, mesh->triangles.size()), {mesh, {}}, task, place);
      }
    }
  }
  const std::vector<std::size_t> convex = choices(table, "convex", convex_names);
  for (const std::string& name : table.texts("convex_meshes", {})) {
    const auto mesh =
        std::make_shared<const TriangleMesh>(mesh_of(name, home, table, "convex_meshes"));
    for (const std::size_t shape : convex) {
      for (const std::size_t task : tasks) {
        for (const std::size_t place : places) {
          if (static_cast<ConcaveTask>(task) == ConcaveTask::distance) continue;
          if (static_cast<MeshPlace>(place) == MeshPlace::gap_1) continue;
          add(fmt::format("{} and {}, {} triangles", convex_names[shape], name,
                          mesh->triangles.size()),
              {mesh, convex_names[shape]}, task, place);
        }
      }
    }
  }
  return cells;
}

Shape convex_shape(std::string_view name, double size, base::Random& random) {
  Shape shape;
  if (name == "hull-32") {
    std::vector<Vec3d> points;
    for (int i = 0; i < 32; ++i) points.push_back(nearest_float(Vec3d(size * random.on_sphere())));
    return hull_of(std::move(points));
  }
  const auto rounded = [&](double part) { return nearest_float(Vec3d::Constant(part * size))[0]; };
  shape.kind = name == "sphere"    ? ShapeKind::sphere
               : name == "capsule" ? ShapeKind::capsule
                                   : ShapeKind::box;
  shape.radius = rounded(name == "sphere" ? 1 : 0.4);
  shape.half_length = rounded(0.6);
  shape.half_extents = {rounded(1), rounded(0.8), rounded(0.6)};
  return shape;
}

std::unique_ptr<ConcavePhase> make_phase(const ConcaveEntry& entry, Precision scalar, bool welds) {
  ConcaveSettings settings;
  settings.scalar = scalar;
  settings.mid_phase = registry::find<MidPhaseEntry>("wide-bvh")->make;
  settings.narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); };
  settings.welds = welds;
  return entry.make(settings);
}

}  // namespace touchstone::kinds
