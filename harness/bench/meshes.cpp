// Benchmarks of what is built before a mesh is asked about.
#include <benchmark/benchmark.h>
#include <fmt/core.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/core/aabb.h"
#include "algorithms/registry.h"
#include "harness/bench/benchmarks.h"
#include "harness/geometry/mesh_shapes.h"

namespace touchstone::bench {
namespace {

constexpr std::array<std::string_view, 3> names = {"torus-2000", "trefoil-10000", "trefoil-100000"};

struct Subject {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<Aabb> boxes, bent;  // of the triangles, before and after vertices move

  double size() const { return static_cast<double>(mesh->triangles.size()); }
};

std::vector<Aabb> boxes_of(const TriangleMesh& mesh, double twist) {
  std::vector<Aabb> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    Aabb box = Aabb::empty();
    for (const std::uint32_t number : triangle) {
      const Vec3d& v = mesh.vertices[number];
      const Vec3d at = Eigen::AngleAxisd(twist * v.z(), Vec3d::UnitZ()) * v;
      for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] = std::min(box.min[k], round_down(at[static_cast<Eigen::Index>(k)]));
        box.max[k] = std::max(box.max[k], round_up(at[static_cast<Eigen::Index>(k)]));
      }
    }
    boxes.push_back(box);
  }
  return boxes;
}

// Made when it is first asked for.
const Subject& subject(std::string_view name) {
  static std::map<std::string_view, Subject> made;
  Subject& one = made[name];
  if (one.mesh == nullptr) {
    geometry::Mesh read = geometry::named_mesh(std::string(name), {});
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = std::move(read.vertices);
    mesh->triangles = std::move(read.triangles);
    one.boxes = boxes_of(*mesh, 0);
    one.bent = boxes_of(*mesh, 0.1);
    one.mesh = std::move(mesh);
  }
  return one;
}

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

void count_triangles(benchmark::State& state, const Subject& of) {
  using benchmark::Counter;
  state.counters["per_triangle"] =
      Counter(of.size(), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// `build` makes something that holds what it built.
template <class Build>
void add_build(const std::string& name, const Build& build) {
  for (const std::string_view mesh : names) {
    benchmark::RegisterBenchmark(
        fmt::format("meshes/{}/{}/build", name, mesh).c_str(), [=](benchmark::State& state) {
          const Subject& of = subject(mesh);
          const std::size_t before = bytes_in_use();
          auto kept = build(of);
          const std::size_t after = bytes_in_use();
          for (auto _ : state) kept = build(of);
          count_triangles(state, of);
          state.counters["bytes"] =
              benchmark::Counter(static_cast<double>(after - before) / of.size());
        });
  }
}

void add_refit(const MidPhaseEntry& entry) {
  for (const std::string_view mesh : names) {
    benchmark::RegisterBenchmark(
        fmt::format("meshes/mid/{}/{}/refit", entry.info.name, mesh).c_str(),
        [mesh, &entry](benchmark::State& state) {
          const Subject& of = subject(mesh);
          const auto phase = entry.make();
          const std::uint32_t body = phase->add(of.boxes);
          bool is_bent = false;
          for (auto _ : state) {
            is_bent = !is_bent;
            phase->refit(body, is_bent ? of.bent : of.boxes);
          }
          count_triangles(state, of);
        });
  }
}

}  // namespace

void register_mesh_benchmarks() {
  for (const MidPhaseEntry& entry : registry::entries<MidPhaseEntry>()) {
    if (!is_built(entry.info)) continue;
    add_build("mid/" + entry.info.name, [&entry](const Subject& of) {
      auto phase = entry.make();
      phase->add(of.boxes);
      return phase;
    });
    add_refit(entry);
  }
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (!is_built(entry.info) || entry.info.origin == Origin::oracle) continue;
    add_build("concave/" + entry.info.name, [&entry](const Subject& of) {
      ConcaveSettings settings;
      settings.scalar = entry.scalars.back();
      settings.mid_phase = registry::find<MidPhaseEntry>("wide-bvh")->make;
      settings.narrow_phase = [] { return registry::find<NarrowPhaseEntry>("gjk")->make({}); };
      auto bodies = std::make_shared<std::vector<ConcaveBody>>(1);
      bodies->front().mesh = of.mesh;
      std::shared_ptr<ConcavePhase> phase = entry.make(settings);
      phase->bind(*bodies);
      return std::pair(bodies, phase);
    });
  }
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    if (!is_built(entry.info) || entry.info.origin == Origin::oracle) continue;
    add_build("ray/" + entry.info.name, [&entry](const Subject& of) {
      auto cast = entry.make({.scalar = entry.scalars.back()});
      cast->bind(*of.mesh);
      return cast;
    });
  }
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
    if (!is_built(entry.info) || entry.info.origin == Origin::oracle) continue;
    add_build("point/" + entry.info.name, [&entry](const Subject& of) {
      auto query = entry.make();
      query->bind(*of.mesh);
      return query;
    });
  }
}

}  // namespace touchstone::bench
