// Benchmarks of the kernels that algorithms share. No other file of the harness includes kernels.
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/isa.h"
#include "algorithms/kernels/boxes/aabb_scan.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/sat/box_box.h"
#include "algorithms/kernels/sorting/insertion_sort.h"
#include "algorithms/kernels/sorting/ordered_key.h"
#include "algorithms/kernels/sorting/radix_sort.h"
#include "harness/base/clock.h"
#include "harness/base/random.h"
#include "harness/bench/benchmarks.h"
#include "harness/bench/placed_pairs.h"

namespace touchstone::bench {
namespace {

template <class Run>
void add(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(("kernels/" + name).c_str(), run);
}
template <class Run>
void add_timed_by_hand(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(("kernels/" + name).c_str(), run)->UseManualTime();
}

// --- support functions ---------------------------------------------------------------------------

// One call per iteration, over 64 shapes in turn. In `random` the direction is new each time. In
// `coherent` a shape's next direction is a twentieth of a radian from its last, as in the later
// steps of a query, whose data is mostly in cache.
template <class Scalar>
void support(benchmark::State& state, const ShapeFamily& family, bool coherent) {
  constexpr std::size_t shapes = 64, directions = 16 * shapes;
  base::Random random(2);
  std::vector<SupportShape<Scalar>> made;
  made.reserve(shapes);
  std::vector<PosedShape<Scalar>> turned;
  std::vector<Vec3<Scalar>> along;
  for (std::size_t i = 0; i < shapes; ++i) {
    made.emplace_back(family.draw(random));
    turned.emplace_back(made[i], random.rotation(), made[i].unit);
  }
  for (std::size_t i = 0; i < directions; ++i) {
    Vec3d direction = random.on_sphere();
    if (coherent && i >= shapes) {
      const Vec3d last = along[i - shapes].template cast<double>();
      direction = (last + 0.05 * direction).normalized();
    }
    along.push_back(direction.cast<Scalar>());
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(turned[i % shapes].support(along[i]));
    i = (i + 1) % directions;
  }
}

void register_support() {
  for (const ShapeFamily& family : shape_families()) {
    if (family.kind == ShapeKind::halfspace) continue;  // its support is infinite
    for (const bool coherent : {false, true}) {
      const auto name = [&](const char* scalar) {
        return fmt::format("support/{}/{}/{}", scalar, family.name,
                           coherent ? "coherent" : "random");
      };
      add(name("float"), [&family, coherent](benchmark::State& state) {
        support<float>(state, family, coherent);
      });
      add(name("double"), [&family, coherent](benchmark::State& state) {
        support<double>(state, family, coherent);
      });
    }
  }
}

// --- sorting -------------------------------------------------------------------------------------

using Items = std::vector<std::uint64_t>;

constexpr std::size_t lists = 16;

// Random coordinates as keys, with their indices.
Items draw_items(std::size_t count, base::Random& random) {
  Items items;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(random.uniform(-100, 100));
    items.push_back(sort_item(ordered_key(x), static_cast<std::uint32_t>(i)));
  }
  return items;
}

// Sorts one list per iteration; copying the list is not timed.
template <class Sort>
void sort_lists(benchmark::State& state, const std::vector<Items>& inputs, const Sort& sort) {
  Items items;
  std::size_t i = 0;
  for (auto _ : state) {
    items = inputs[i];
    i = (i + 1) % inputs.size();
    const base::Stopwatch watch;
    const bool sorted = sort(items);
    state.SetIterationTime(watch.seconds());
    if (!sorted) {
      state.SkipWithError("it gave up");
      break;
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(inputs[0].size()));
}

void sort_anew(benchmark::State& state, std::size_t count) {
  base::Random random(3);
  std::vector<Items> inputs;
  for (std::size_t i = 0; i < lists; ++i) inputs.push_back(draw_items(count, random));
  Executor executor(1);
  RadixSort<std::uint64_t> sort;
  sort_lists(state, inputs, [&](Items& items) {
    sort(executor, items, 32, key_of);
    return true;
  });
}

// Lists in which a tenth of the items has moved by up to three places.
void sort_again(benchmark::State& state, std::size_t count) {
  base::Random random(4);
  std::vector<Items> inputs;
  for (std::size_t i = 0; i < lists; ++i) {
    Items& items = inputs.emplace_back(draw_items(count, random));
    std::ranges::sort(items);
    for (std::size_t swaps = 0; swaps < count / 20; ++swaps) {
      const std::size_t at = random.below(count - 3);
      std::swap(items[at], items[at + 1 + random.below(3)]);
    }
  }
  sort_lists(state, inputs, [](Items& items) { return insertion_sort(std::span(items), 8); });
}

void register_sorts() {
  for (const std::size_t count : {1'000, 10'000, 100'000, 1'000'000}) {
    add_timed_by_hand(fmt::format("radix-sort/{}", count),
                      [count](benchmark::State& state) { sort_anew(state, count); });
    add_timed_by_hand(fmt::format("insertion-sort/{}", count),
                      [count](benchmark::State& state) { sort_again(state, count); });
  }
}

// --- tests of boxes ------------------------------------------------------------------------------

// Cubes of side 1, each overlapping about two others, sorted by x.
std::unique_ptr<AabbSoA> draw_boxes(std::size_t count, base::Random& random) {
  const double side = std::cbrt(4.0 * static_cast<double>(count));
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<float>(random.uniform(0, side));
      box.max[axis] = box.min[axis] + 1;
    }
  }
  std::ranges::sort(boxes, {}, [](const Aabb& box) { return box.min[0]; });
  auto arrays = std::make_unique<AabbSoA>();
  arrays->resize(count);
  for (std::uint32_t i = 0; i < count; ++i) arrays->set(i, boxes[i], i);
  return arrays;
}

// Scans one set of boxes per iteration, at a level of vector instructions.
template <class Scan>
void scan(benchmark::State& state, Isa level, std::size_t count, const Scan& scan_set) {
  if (level > isa_of_machine()) return state.SkipWithError("this machine has no such instructions");
  base::Random random(5);
  std::vector<std::unique_ptr<AabbSoA>> sets;
  for (std::size_t i = 0; i < 16; ++i) sets.push_back(draw_boxes(count, random));
  PairBuffer out;
  std::size_t i = 0, pairs = 0;
  limit_isa(level);
  for (auto _ : state) {
    out.clear();
    scan_set(*sets[i], out);
    pairs += out.size();
    i = (i + 1) % sets.size();
  }
  limit_isa(isa_of_machine());
  state.counters["pairs"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kAvgIterations);
}

// Tests the 15 axes of one pair per iteration, including the placement of the pair.
template <class Scalar>
void box_axes(benchmark::State& state, const PairRegime& regime) {
  const FamilyPair families{find_family("box"), find_family("box")};
  const PlacedPairs& pairs = placed_pairs(families, regime);
  const std::vector<Polytope<Scalar>> shapes = make_polytopes<Scalar>(pairs.shapes);
  std::size_t i = 0;
  int tested = 0;
  for (auto _ : state) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    const PolytopePair<Scalar> pair(shapes[pairs.shape_of[a]], pairs.poses[a],
                                    shapes[pairs.shape_of[b]], pairs.poses[b]);
    if (!pair.far_apart()) benchmark::DoNotOptimize(box_axis(pair, tested));
    i = (i + 1) % PlacedPairs::count;
  }
  state.counters["axes"] = benchmark::Counter(tested, benchmark::Counter::kAvgIterations);
}

void register_box_tests() {
  for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    for (const std::size_t count : {1'000, 10'000}) {
      const auto name = [&](const char* what) {
        return fmt::format("{}/{}/{}", what, to_string(level), count);
      };
      add(name("box-scan"), [level, count](benchmark::State& state) {
        scan(state, level, count, [&](const AabbSoA& boxes, PairBuffer& out) {
          const IndexRange all{0, boxes.size()};
          scan_boxes(boxes, all, std::span(&all, 1), out);
        });
      });
      add(name("box-sweep"), [level, count](benchmark::State& state) {
        scan(state, level, count, [&](const AabbSoA& boxes, PairBuffer& out) {
          sweep_boxes(boxes, 0, {0, boxes.size()}, out);
        });
      });
    }
  }
  for (const PairRegime& regime : pair_regimes()) {
    add(fmt::format("box-axes/float/{}", regime.name),
        [&regime](benchmark::State& state) { box_axes<float>(state, regime); });
    add(fmt::format("box-axes/double/{}", regime.name),
        [&regime](benchmark::State& state) { box_axes<double>(state, regime); });
  }
}

}  // namespace

void register_kernel_benchmarks() {
  register_support();
  register_sorts();
  register_box_tests();
}

}  // namespace touchstone::bench
