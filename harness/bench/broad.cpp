// Benchmarks of every broad phase on the families of scenes, each call separately.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/base/data_folder.h"
#include "harness/bench/benchmarks.h"
#include "harness/scene/player.h"

namespace touchstone::bench {
namespace {

constexpr std::array<std::string_view, 5> scenes = {"uniform", "clustered", "mixed", "city",
                                                    "ground"};
constexpr std::array<std::int64_t, 2> body_counts = {1'000, 10'000};

scene::Scene load(std::string_view name, const scene::SceneOverrides& overrides) {
  const std::filesystem::path folder = base::data_folder().path / "datasets";
  return scene::load_scene(folder / (std::string(name) + ".toml"), overrides);
}

// The boxes of a scene drawn with many seeds. A single input in a loop would measure trained branch
// predictors.
class Draws {
 public:
  Draws(std::string_view scene, std::int64_t count) {
    const std::int64_t seeds = count <= 1'000 ? 64 : 16;
    for (std::int64_t seed = 1; seed <= seeds; ++seed) {
      const scene::Scene drawn = load(scene, {.count = count, .seed = seed, .frames = 1});
      const scene::ScenePlayer player(drawn, scene::BoxKind::tight);
      boxes_.emplace_back(player.boxes().begin(), player.boxes().end());
    }
  }
  std::span<const Aabb> next() {
    at_ = (at_ + 1) % boxes_.size();
    return boxes_[at_];
  }

 private:
  std::vector<std::vector<Aabb>> boxes_;
  std::size_t at_ = 0;
};

// The frames of a scene, in a cycle.
class Film {
 public:
  Film(std::string_view scene, std::int64_t count) {
    const scene::Scene drawn = load(scene, {.count = count, .seed = 1, .frames = 64});
    scene::ScenePlayer player(drawn, scene::BoxKind::tight);
    do {
      const FrameChange change = player.change();
      frames_.push_back(
          {{change.boxes.begin(), change.boxes.end()}, {change.moved.begin(), change.moved.end()}});
    } while (player.next());
  }
  std::size_t size() const { return frames_.size(); }
  FrameChange change(std::size_t frame) const {
    return {frames_[frame].boxes, frames_[frame].moved, {}, {}};
  }

 private:
  struct Frame {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> moved;
  };
  std::vector<Frame> frames_;
};

template <class Input>
Input& input(std::string_view scene, std::int64_t count) {
  static std::map<std::pair<std::string_view, std::int64_t>, std::unique_ptr<Input>> made;
  auto& one = made[{scene, count}];
  if (!one) one = std::make_unique<Input>(scene, count);
  return *one;
}

struct Subject {
  const BroadPhaseEntry* entry;
  std::string_view scene;
  std::int64_t count;
};

template <class Call>
double seconds_of(const Call& call) {
  const base::Stopwatch watch;
  call();
  return watch.seconds();
}

// Makes both calls in every iteration and times one of them.
void rebuild(benchmark::State& state, const Subject& subject, bool time_build) {
  Draws& draws = input<Draws>(subject.scene, subject.count);
  Executor executor(1);
  const auto algorithm = subject.entry->make(executor);
  PairSink sink;
  std::size_t pairs = 0;
  for (auto _ : state) {
    const std::span<const Aabb> boxes = draws.next();
    const double build = seconds_of([&] { algorithm->build(boxes); });
    const double find = seconds_of([&] { algorithm->find_pairs(sink); });
    state.SetIterationTime(time_build ? build : find);
    pairs += sink.size();
  }
  state.counters["pairs"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kAvgIterations);
}

// Makes both calls on the frames of one scene. The build of its first frame is not timed.
void update(benchmark::State& state, const Subject& subject, bool time_update) {
  const Film& film = input<Film>(subject.scene, subject.count);
  Executor executor(1);
  const auto algorithm = subject.entry->make(executor);
  PairSink sink;
  std::size_t pairs = 0, frame = 0;
  for (auto _ : state) {
    if (frame == 0) {
      algorithm->build(film.change(0).boxes);
      algorithm->find_pairs(sink);
      frame = 1;
    }
    const FrameChange change = film.change(frame);
    const double updated = seconds_of([&] { algorithm->update(change); });
    const double find = seconds_of([&] { algorithm->find_pairs(sink); });
    state.SetIterationTime(time_update ? updated : find);
    pairs += sink.size();
    frame = (frame + 1) % film.size();
  }
  state.counters["pairs"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kAvgIterations);
}

template <class Call>
void add(const Subject& subject, std::string_view phase, const Call& call) {
  const std::string name = fmt::format("broad/{}/{}/{}/{}", subject.entry->info.name, subject.scene,
                                       subject.count, phase);
  benchmark::RegisterBenchmark(name.c_str(), [subject, call](benchmark::State& state) {
    call(state, subject);
  })->UseManualTime();
}

}  // namespace

void register_broad_benchmarks() {
  using State = benchmark::State;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    for (const std::string_view scene : scenes) {
      for (const std::int64_t count : body_counts) {
        const Subject subject{&entry, scene, count};
        add(subject, "build", [](State& s, const Subject& of) { rebuild(s, of, true); });
        add(subject, "find-pairs", [](State& s, const Subject& of) { rebuild(s, of, false); });
        add(subject, "update", [](State& s, const Subject& of) { update(s, of, true); });
        add(subject, "find-pairs-updated",
            [](State& s, const Subject& of) { update(s, of, false); });
      }
    }
  }
}

}  // namespace touchstone::bench
