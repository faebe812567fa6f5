// Benchmarks of the exact answers.
#include "algorithms/oracle/oracle.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <array>
#include <string_view>
#include <vector>

#include "harness/bench/benchmarks.h"
#include "harness/bench/placed_pairs.h"

namespace touchstone::bench {
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
