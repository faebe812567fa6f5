// Kernel benchmarks: every algorithm of the registry, and the oracle, under Google Benchmark, for
// profiling one at a time (--benchmark_filter=narrow/gjk/double/box-box). The harness proper times
// whole scenes; see `touchstone run`.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/executor.h"
#include "algorithms/registry.h"
#include "harness/bench/harness_overhead.h"
#include "harness/bench/oracle.h"
#include "harness/run/build_info.h"
#include "harness/run/pair_groups.h"
#include "harness/scene/player.h"

namespace {

using namespace touchstone;

// One scene, played to its end once: a sample cycles through many distinct frames or pairs, since a
// loop over one input would measure trained branch predictors.
struct Stage {
  Scene scene;
  std::vector<std::vector<Aabb>> boxes;  // of each frame
  std::vector<Pose> poses;               // of the last frame
  std::vector<PairGroup> groups;         // its true pairs
  std::vector<std::uint32_t> shape_of;

  Stage(const std::string& file, std::int64_t count, int frames)
      : scene(load_scene(std::filesystem::path(source_folder) / "datasets" / file,
                         {count, -1, frames})) {
    ScenePlayer player(scene, BoxKind::tight);
    do {
      boxes.emplace_back(player.boxes().begin(), player.boxes().end());
    } while (player.next());
    poses.assign(player.poses().begin(), player.poses().end());
    for (const Body& body : scene.bodies) shape_of.push_back(body.shape);
    Executor executor(1);
    const std::unique_ptr<BroadPhase> naive = find_broad_phase("naive")->make(executor);
    PairSink sink;
    naive->build(boxes.back());
    naive->find_pairs(sink);
    groups = group_by_kind(sink.gather(), scene.shapes, shape_of);
  }
};

void broad(benchmark::State& state, const BroadPhaseEntry& entry, const Stage& stage) {
  Executor executor(1);
  const std::unique_ptr<BroadPhase> algorithm = entry.make(executor);
  PairSink sink;
  std::size_t frame = 0;
  for (auto _ : state) {
    algorithm->build(stage.boxes[frame]);
    algorithm->find_pairs(sink);
    frame = (frame + 1) % stage.boxes.size();
  }
  state.counters["bodies"] = static_cast<double>(stage.scene.size());
  state.counters["pairs"] = static_cast<double>(sink.size());
}

void narrow(benchmark::State& state, const NarrowPhaseEntry& entry, Precision scalar, Task task,
            const PairGroup& group, const Stage& stage) {
  const std::unique_ptr<NarrowPhase> algorithm = entry.make({.scalar = scalar});
  algorithm->bind(stage.scene.shapes);
  std::vector<Outcome> outcomes(group.size());
  const PairBatch batch = group.batch(task, stage.shape_of, stage.poses, 0, group.size());
  for (auto _ : state) algorithm->solve(batch, outcomes);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(group.size()));
}

void register_all(const Stage& boxes, const Stage& bodies) {
  for (const BroadPhaseEntry& entry : broad_phases()) {
    if (!is_built(entry.info)) continue;
    benchmark::RegisterBenchmark(fmt::format("broad/{}", entry.info.name).c_str(),
                                 [&](benchmark::State& state) { broad(state, entry, boxes); });
  }
  for (const NarrowPhaseEntry& entry : narrow_phases()) {
    if (!is_built(entry.info)) continue;
    for (const Precision scalar : entry.scalars) {
      for (const Task task : entry.tasks) {
        for (const PairGroup& group : bodies.groups) {
          if (!offers(entry, group.kind_a, group.kind_b, task)) continue;
          const std::string name = fmt::format("narrow/{}/{}/{}/{}", entry.info.name,
                                               to_string(scalar), group.name(), to_string(task));
          benchmark::RegisterBenchmark(name.c_str(), [&, scalar, task](benchmark::State& state) {
            narrow(state, entry, scalar, task, group, bodies);
          });
        }
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const Stage boxes("uniform.toml", 1000, 64);
  const Stage bodies("primitives.toml", 2000, 1);
  register_all(boxes, bodies);
  register_oracle_benchmarks();
  register_harness_overhead_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
