// Benchmarks of every narrow phase on every two kinds of shapes, near and far, and of the exact
// answers.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "harness/bench/benchmarks.h"
#include "harness/bench/placed_pairs.h"

namespace touchstone::bench {
namespace {

// Solves one query per iteration, in batches that are short enough for the slowest algorithm.
void solve(benchmark::State& state, const NarrowSubject& subject) {
  constexpr std::size_t batch_size = 32;
  static_assert(PlacedPairs::count % batch_size == 0);
  const PlacedPairs& pairs = placed_pairs(subject.families, subject.regime);
  const auto algorithm = subject.entry->make({.scalar = subject.scalar});
  algorithm->bind(pairs.shapes);
  std::vector<Outcome> outcomes(PlacedPairs::count);
  std::size_t begin = 0, asked = 0;
  while (state.KeepRunningBatch(batch_size)) {
    algorithm->solve(subject.task, pairs.batch(begin, batch_size),
                     std::span(outcomes).subspan(begin, batch_size));
    begin = (begin + batch_size) % PlacedPairs::count;
    asked = std::max(asked, begin == 0 ? PlacedPairs::count : begin);
  }
  const Answer right = subject.regime.distance > 0 ? Answer::separated : Answer::overlapping;
  const auto wrong =
      std::count_if(outcomes.begin(), outcomes.begin() + static_cast<std::ptrdiff_t>(asked),
                    [&](const Outcome& o) { return o.answer != right; });
  state.counters["wrong"] = static_cast<double>(wrong);  // of the distinct pairs that were solved
  state.SetItemsProcessed(state.iterations());
}

}  // namespace

std::string NarrowSubject::name() const {
  return fmt::format("narrow/{}/{}/{}/{}/{}", entry->info.name, to_string(scalar), families.name(),
                     to_string(task), regime.name);
}

std::vector<NarrowSubject> narrow_subjects() {
  std::vector<NarrowSubject> subjects;
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    for (const Precision scalar : entry.scalars) {
      for (const FamilyPair& families : family_pairs()) {
        for (const Task task : entry.tasks) {
          if (!offers(entry, families.a->kind, families.b->kind, task)) continue;
          for (const PairRegime& regime : pair_regimes()) {
            if (regime.fits(task)) subjects.push_back({&entry, scalar, task, families, regime});
          }
        }
      }
    }
  }
  return subjects;
}

void register_narrow_benchmarks() {
  for (const NarrowSubject& subject : narrow_subjects()) {
    benchmark::RegisterBenchmark(subject.name().c_str(),
                                 [subject](benchmark::State& state) { solve(state, subject); });
  }
}

namespace {

// The places include gaps and depths at which the floating-point filters give way to exact
// arithmetic.
constexpr std::array<PairRegime, 7> places = {{{"1", 1},
                                               {"1e-3", 1e-3},
                                               {"1e-9", 1e-9},
                                               {"1e-15", 1e-15},
                                               {"-1e-15", -1e-15},
                                               {"-1e-3", -1e-3},
                                               {"-0.2", -0.2}}};

template <class Query>
void ask(benchmark::State& state, const FamilyPair& families, const PairRegime& place,
         const Query& query) {
  const PlacedPairs& pairs = placed_pairs(families, place);
  std::vector<oracle::Solid> solids(pairs.shapes.begin(), pairs.shapes.end());
  std::vector<oracle::Body> bodies;
  for (std::size_t i = 0; i < pairs.poses.size(); ++i) {
    bodies.emplace_back(solids[pairs.shape_of[i]], pairs.poses[i]);
  }
  oracle::Oracle oracle;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(query(oracle, bodies[pairs.first[i]], bodies[pairs.second[i]]));
    i = (i + 1) % PlacedPairs::count;
  }
  state.SetItemsProcessed(state.iterations());
}

}  // namespace

void register_oracle_benchmarks() {
  using State = benchmark::State;
  for (const std::string_view shape : {"box", "icosphere-42", "hull-128"}) {
    const FamilyPair families{find_family(shape), find_family(shape)};
    for (const PairRegime& place : places) {
      const std::string name = fmt::format("{}/{}", families.name(), place.name);
      benchmark::RegisterBenchmark(("oracle/verdict/" + name).c_str(), [=](State& state) {
        ask(state, families, place, [](auto& o, auto& a, auto& b) { return o.verdict(a, b); });
      });
      const char* const what = place.distance > 0 ? "distance" : "depth";
      benchmark::RegisterBenchmark(
          fmt::format("oracle/{}/{}", what, name).c_str(), [=](State& state) {
            ask(state, families, place, [](auto& o, auto& a, auto& b) { return o.measure(a, b); });
          });
    }
  }
}

}  // namespace touchstone::bench
