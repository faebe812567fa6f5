// Measures samplers whose algorithms do nothing.
#include "harness/bench/benchmarks.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/data_folder.h"
#include "harness/measure/narrow_sampler.h"
#include "harness/measure/phase_samplers.h"

namespace touchstone::bench {
namespace {

constexpr std::int64_t bodies = 1000;
constexpr int frames = 64;
constexpr int repetitions = 15;  // samples of a real algorithm; the median counts

class NoBroadPhase final : public BroadPhase {
 public:
  void build(std::span<const Aabb>) override {}
  void update(const FrameChange&) override {}
  Status find_pairs(PairSink&) override { return Status::ok; }
};

class NoNarrowPhase final : public NarrowPhase {
 public:
  void bind(std::span<const Shape>) override {}
  void solve(Task, const PairBatch&, std::span<Outcome>) override {}
};

struct Stage {
  scene::Scene scene;
  measure::BlockInput input;

  explicit Stage(const char* file)
      : scene(
            scene::load_scene(base::data_folder().path / "datasets" / file, {bodies, -1, frames})),
        input(scene, scene::BoxKind::tight, true) {}
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The result of one sample, seconds per unit.
using Take = std::function<double(measure::Sampler& sampler)>;

double typical(measure::Sampler& sampler, const Take& take) {
  take(sampler);  // warms up
  std::vector<double> values;
  for (int i = 0; i < repetitions; ++i) values.push_back(take(sampler));
  return median(std::move(values));
}

void report(benchmark::State& state, measure::Sampler& idle, const Take& take, double fastest) {
  std::vector<double> values;
  for (auto _ : state) {
    values.push_back(take(idle));
    state.SetIterationTime(values.back());
  }
  constexpr double nanoseconds = 1e9;
  const double overhead = median(std::move(values));
  state.counters["overhead"] = overhead * nanoseconds;
  state.counters["fastest"] = fastest * nanoseconds;
  state.counters["share"] = 100 * overhead / fastest;
}

void broad(benchmark::State& state, int threads) {
  const Stage stage("uniform.toml");
  Executor executor(threads);
  const Take take = [](measure::Sampler& sampler) {
    const measure::SampleReply reply = sampler.sample({.frame = 1, .frames = frames - 1});
    return reply.durations.sum() / (frames - 1);
  };
  double fastest = std::numeric_limits<double>::infinity();
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin != Origin::ours) continue;
    measure::BroadSampler sampler(entry, stage.input, false, executor);
    const double seconds = typical(sampler, take);
    if (seconds < fastest) state.SetLabel(entry.info.name);
    fastest = std::min(fastest, seconds);
  }
  BroadPhaseEntry none;
  none.make = [](Executor&) { return std::make_unique<NoBroadPhase>(); };
  measure::BroadSampler idle(none, stage.input, false, executor);
  report(state, idle, take, fastest);
}

// Measures spheres against spheres: the cheapest queries, and the kind with the most pairs.
void narrow(benchmark::State& state, int threads) {
  const Stage stage("primitives.toml");
  Executor executor(threads);
  std::vector<std::vector<IndexPair>> pairs;
  for (const measure::BlockFrame& frame : stage.input.frames) pairs.push_back(frame.truth);
  constexpr Task task = Task::intersect;
  constexpr record::QueryTask asked = record::query_task(task);
  const std::vector<measure::NarrowSet> sets =
      measure::narrow_sets(stage.input, "", pairs, {&asked, 1});
  const auto spheres = std::ranges::find_if(sets, [](const measure::NarrowSet& set) {
    return set.kind_a == ShapeKind::sphere && set.kind_b == ShapeKind::sphere;
  });
  if (spheres == sets.end()) return state.SkipWithError("the scene has no pair of spheres");
  const auto number = static_cast<std::uint32_t>(spheres - sets.begin());
  const Take take = [&](measure::Sampler& sampler) {
    const measure::SampleReply reply = sampler.sample({.set = number, .frames = frames});
    return reply.durations.sum() / static_cast<double>(reply.pairs);
  };
  double fastest = std::numeric_limits<double>::infinity();
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.info.origin != Origin::ours ||
        !offers(entry, spheres->kind_a, spheres->kind_b, task)) {
      continue;
    }
    const measure::NarrowChoice choice{.entry = &entry,
                                       .settings = {.scalar = entry.scalars.front()}};
    measure::NarrowSampler sampler(choice, stage.input, sets, executor);
    const double seconds = typical(sampler, take);
    if (seconds < fastest) state.SetLabel(entry.info.name);
    fastest = std::min(fastest, seconds);
  }
  NarrowPhaseEntry none;
  none.make = [](const NarrowPhaseSettings&) { return std::make_unique<NoNarrowPhase>(); };
  measure::NarrowSampler idle({.entry = &none, .settings = {}}, stage.input, sets, executor);
  report(state, idle, take, fastest);
}

}  // namespace

void register_harness_overhead_benchmarks() {
  const struct {
    const char* name;
    void (*run)(benchmark::State&, int threads);
  } kinds[] = {{"broad", broad}, {"narrow", narrow}};
  for (const auto& kind : kinds) {
    for (const int threads : {1, 2}) {
      benchmark::RegisterBenchmark(
          fmt::format("harness/overhead/{}/{}", kind.name, threads).c_str(),
          [=](benchmark::State& state) { kind.run(state, threads); })
          ->UseManualTime()
          ->Iterations(200)
          ->Unit(benchmark::kNanosecond);
    }
  }
}

}  // namespace touchstone::bench
