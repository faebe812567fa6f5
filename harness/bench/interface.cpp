// What the library that installs (algorithms/api) adds to the algorithms behind it, beside the one-pair calls of other
// libraries. A program of its own, since no other links the library:
//   ninja -C build/release touchstone_bench_interface && build/release/harness/touchstone_bench_interface
// Repetitions are interleaved, and medians are printed. Arguments are Google Benchmark's.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <touchstone/touchstone.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <touchstone/touchstone.hpp>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "harness/base/clock.h"
#include "harness/base/random.h"
#include "harness/bench/placed_pairs.h"

namespace touchstone::bench {
namespace {

namespace api = touchstone::v1;

// --- one pair a call: pair/FAMILY/WHO, distances at a gap of 0.1 m -------------------------------

api::Vec3 outer(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

api::Shape shape_of(const Shape& shape) {
  if (shape.kind == ShapeKind::sphere) return api::Shape::sphere(shape.radius);
  if (shape.kind == ShapeKind::box) return api::Shape::box(outer(shape.half_extents));
  if (shape.kind != ShapeKind::hull) throw std::logic_error("no benchmark has this kind");
  std::vector<api::Vec3> points;
  for (const Vec3d& vertex : shape.hull->vertices) points.push_back(outer(vertex));
  return api::Shape::hull(points);
}

// The same pairs in each interface's own types.
struct Inputs {
  explicit Inputs(std::string_view family)
      : pairs(placed_pairs({find_family(family), find_family(family)}, pair_regimes()[1])) {
    std::vector<api::Shape> shapes;
    for (const Shape& shape : pairs.shapes) shapes.push_back(shape_of(shape));
    for (std::size_t i = 0; i < pairs.poses.size(); ++i) {
      const Pose& pose = pairs.poses[i];
      const auto axis = [&](int k) { return outer(pose.rotation.col(k)); };
      bodies.push_back(
          {shapes[pairs.shape_of[i]], {axis(0), axis(1), axis(2), outer(pose.translation)}});
    }
    solver.prepare(shapes);
  }
  const PlacedPairs& pairs;
  std::vector<api::Body> bodies;
  api::Solver solver;
};

template <class Ask>
void loop(benchmark::State& state, const PlacedPairs& pairs, const Ask& ask) {
  std::size_t i = 0;
  double sum = 0;
  for (auto _ : state) {
    sum += ask(i);
    i = (i + 1) % PlacedPairs::count;
  }
  benchmark::DoNotOptimize(sum);
  benchmark::DoNotOptimize(pairs);
}

void ask_algorithm(benchmark::State& state, std::string_view family, const std::string& name) {
  const Inputs inputs(family);
  const auto algorithm = registry::find<NarrowPhaseEntry>(name)->make({});
  algorithm->bind(inputs.pairs.shapes);
  const PairBatch batch = inputs.pairs.batch(0, PlacedPairs::count);
  Outcome outcome;
  loop(state, inputs.pairs, [&](std::size_t i) {
    algorithm->solve_alone(Task::distance, batch, i, outcome);
    return outcome.distance;
  });
}

void ask_solver(benchmark::State& state, std::string_view family) {
  Inputs inputs(family);
  loop(state, inputs.pairs, [&](std::size_t i) {
    return inputs.solver
        .distance(inputs.bodies[inputs.pairs.first[i]], inputs.bodies[inputs.pairs.second[i]])
        .distance;
  });
}

struct InC {
  explicit InC(const Inputs& inputs) {
    touchstone_solver_create(nullptr, &solver);
    for (const Shape& shape : inputs.pairs.shapes) {
      touchstone_shape* made = nullptr;
      if (shape.kind == ShapeKind::sphere) touchstone_sphere(shape.radius, &made);
      if (shape.kind == ShapeKind::box) {
        touchstone_box(shape.half_extents.x(), shape.half_extents.y(), shape.half_extents.z(),
                       &made);
      }
      if (shape.kind == ShapeKind::hull)
        touchstone_hull(shape.hull->vertices[0].data(), shape.hull->vertices.size(), &made);
      shapes.push_back(made);
    }
    for (const Pose& pose : inputs.pairs.poses) {
      touchstone_pose& made = poses.emplace_back();
      for (int k = 0; k < 9; ++k) made.rotation[k] = pose.rotation(k % 3, k / 3);
      for (int k = 0; k < 3; ++k) made.translation[k] = pose.translation[k];
    }
    touchstone_solver_prepare(solver, shapes.data(), shapes.size());
  }
  ~InC() {
    touchstone_solver_destroy(solver);
    for (touchstone_shape* const shape : shapes) touchstone_shape_destroy(shape);
  }
  InC(const InC&) = delete;
  InC& operator=(const InC&) = delete;

  touchstone_solver* solver = nullptr;
  std::vector<touchstone_shape*> shapes;
  std::vector<touchstone_pose> poses;
};

void ask_in_c(benchmark::State& state, std::string_view family) {
  const Inputs inputs(family);
  const InC in_c(inputs);
  const PlacedPairs& pairs = inputs.pairs;
  touchstone_result result = TOUCHSTONE_RESULT_INIT;
  loop(state, pairs, [&](std::size_t i) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    touchstone_solver_ask(in_c.solver, TOUCHSTONE_DISTANCE, in_c.shapes[pairs.shape_of[a]],
                          &in_c.poses[a], in_c.shapes[pairs.shape_of[b]], &in_c.poses[b], &result);
    return result.distance;
  });
}

void register_pairs() {
  for (const std::string_view family : {"sphere", "box", "hull-32"}) {
    const auto add = [&](std::string_view who, const auto& call) {
      benchmark::RegisterBenchmark(fmt::format("pair/{}/{}", family, who).c_str(), call);
    };
    // What the library chooses for these, and the libraries that answer distances.
    const std::string chosen = family == "sphere" ? "closed-form" : "gjk";
    for (const std::string& name :
         {chosen, std::string("bullet-gjk-epa"), std::string("fcl-indep")}) {
      const auto* const entry = registry::find<NarrowPhaseEntry>(name);
      if (entry == nullptr || !is_built(entry->info)) continue;
      add(name, [=](benchmark::State& state) { ask_algorithm(state, family, name); });
    }
    add("library", [=](benchmark::State& state) { ask_solver(state, family); });
    add("library-in-c", [=](benchmark::State& state) { ask_in_c(state, family); });
  }
}

// --- a world's step: step/BODIES/WHO, update and pairs of boxes that all moved --------------------

// Unit boxes, each with four others in its reach on average, and two sets of their places.
struct Boxes {
  explicit Boxes(std::size_t count) {
    base::Random random(count);
    const double side = std::cbrt(2.0 * static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 3> at;
      for (double& place : at) place = random.uniform(0, side);
      moved.push_back(static_cast<std::uint32_t>(i));
      for (int frame = 0; frame < 2; ++frame) {
        Aabb& box = frames[static_cast<std::size_t>(frame)].emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
          box.min[k] = static_cast<float>(at[k] + 0.1 * frame);
          box.max[k] = box.min[k] + 1;
        }
      }
    }
  }
  std::array<std::vector<Aabb>, 2> frames;
  std::vector<std::uint32_t> moved;
};

void step_broad_phase(benchmark::State& state, std::size_t count, const std::string& name) {
  const Boxes boxes(count);
  Executor executor(1);
  const auto algorithm = registry::find<BroadPhaseEntry>(name)->make(executor);
  PairSink sink;
  algorithm->build(boxes.frames[0]);
  std::size_t frame = 0, pairs = 0;
  for (auto _ : state) {
    frame = 1 - frame;
    const base::Stopwatch watch;
    algorithm->update({boxes.frames[frame], boxes.moved, {}, {}});
    algorithm->find_pairs(sink);
    state.SetIterationTime(watch.seconds());
    pairs = sink.size();
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

void step_world(benchmark::State& state, std::size_t count, const std::string& name) {
  const Boxes boxes(count);
  const auto box = [](const Aabb& from) {
    return api::Box{{from.min[0], from.min[1], from.min[2]},
                    {from.max[0], from.max[1], from.max[2]}};
  };
  api::World world({.broad_phase = name});
  std::vector<api::Handle> handles;
  for (const Aabb& one : boxes.frames[0]) handles.push_back(world.insert(box(one)));
  world.update();
  std::size_t frame = 0, pairs = 0;
  for (auto _ : state) {
    frame = 1 - frame;
    for (std::size_t i = 0; i < count; ++i) world.move(handles[i], box(boxes.frames[frame][i]));
    const base::Stopwatch watch;
    world.update();
    const api::World::Pairs found = world.pairs();
    state.SetIterationTime(watch.seconds());
    pairs = 0;
    for (const auto chunk : found.chunks) pairs += chunk.size();
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}

void register_steps() {
  for (const std::size_t count : {std::size_t{1'000}, std::size_t{10'000}}) {
    const std::string name = "packed-rtree";
    benchmark::RegisterBenchmark(fmt::format("step/{}/{}", count, name).c_str(),
                                 [=](benchmark::State& s) { step_broad_phase(s, count, name); })
        ->UseManualTime();
    benchmark::RegisterBenchmark(fmt::format("step/{}/library", count).c_str(),
                                 [=](benchmark::State& s) { step_world(s, count, name); })
        ->UseManualTime();
  }
}

}  // namespace
}  // namespace touchstone::bench

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  // What is given later has the last word.
  std::string interleaved = "--benchmark_enable_random_interleaving=true",
              repetitions = "--benchmark_repetitions=15", short_ones = "--benchmark_min_time=0.05",
              medians = "--benchmark_report_aggregates_only=true";
  for (std::string* const given : {&medians, &short_ones, &repetitions, &interleaved})
    arguments.insert(arguments.begin() + 1, given->data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  touchstone::bench::register_pairs();
  touchstone::bench::register_steps();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
