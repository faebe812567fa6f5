#include "algorithms/oracle/oracle.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <memory>
#include <vector>

#include "harness/bench/oracle.h"
#include "harness/scene/convex_hull.h"
#include "harness/scene/random.h"

namespace touchstone {
namespace {

constexpr std::size_t pairs = 256;

// Pairs of bodies of about unit size, turned at random, at a signed distance from each other.
class PlacedPairs {
 public:
  // `vertices` of a hull with its vertices on the unit sphere; 8: a box.
  PlacedPairs(std::size_t vertices, double signed_distance) {
    Random random(vertices);
    solids_.reserve(2 * pairs);
    for (std::size_t i = 0; i < pairs; ++i) {
      for (int side = 0; side < 2; ++side) solids_.emplace_back(shape(vertices, random));
      Pose a{random.rotation(), random.in_ball()}, b{random.rotation(), a.translation};
      b.translation += 4 * random.on_sphere();
      for (int step = 0; step < 40; ++step) {
        const oracle::Measure measure =
            oracle_.measure({solids_[2 * i], a}, {solids_[2 * i + 1], b});
        const double off = signed_distance - measure.middle();
        if (std::abs(off) < 2e-16) break;
        b.translation += off * measure.normal;
      }
      bodies_.emplace_back(solids_[2 * i], a);
      bodies_.emplace_back(solids_[2 * i + 1], b);
    }
  }

  void verdicts(benchmark::State& state) {
    run(state, [&](const auto& a, const auto& b) { return oracle_.verdict(a, b); });
  }
  void measures(benchmark::State& state) {
    run(state, [&](const auto& a, const auto& b) { return oracle_.measure(a, b); });
  }

 private:
  static Shape shape(std::size_t vertices, Random& random) {
    Shape shape;
    if (vertices == 8) {
      shape.kind = ShapeKind::box;
      for (double& half : shape.half_extents) half = random.uniform(0.3, 1);
      return shape;
    }
    std::vector<Vec3d> points;
    for (std::size_t k = 0; k < vertices; ++k) points.push_back(random.on_sphere());
    shape.kind = ShapeKind::hull;
    shape.hull = make_hull(std::move(points));
    return shape;
  }

  template <class Query>
  void run(benchmark::State& state, const Query& query) {
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(query(bodies_[2 * i], bodies_[2 * i + 1]));
      i = (i + 1) % pairs;
    }
    state.SetItemsProcessed(state.iterations());
  }

  oracle::Oracle oracle_;
  std::vector<oracle::Solid> solids_;
  std::vector<oracle::Body> bodies_;
};

}  // namespace

void register_oracle_benchmarks() {
  for (const std::size_t vertices : {8, 42, 128}) {
    const std::string shape = vertices == 8 ? "box" : fmt::format("hull-{}", vertices);
    for (const double distance : {1.0, 1e-3, 1e-9, 1e-15, -1e-15, -1e-3, -0.3}) {
      const std::string place = fmt::format("{}/{:g}", shape, distance);
      benchmark::RegisterBenchmark(
          ("oracle/verdict/" + place).c_str(),
          [=](benchmark::State& state) { PlacedPairs(vertices, distance).verdicts(state); });
      const char* const what = distance > 0 ? "distance" : "depth";
      benchmark::RegisterBenchmark(
          fmt::format("oracle/{}/{}", what, place).c_str(),
          [=](benchmark::State& state) { PlacedPairs(vertices, distance).measures(state); });
    }
  }
}

}  // namespace touchstone
