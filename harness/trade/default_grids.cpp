// The grids of a request that has none.
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string_view>

#include "harness/trade/grid.h"
#include "harness/trade/pipeline/truth.h"

namespace touchstone::trade {
namespace {

constexpr std::array<std::string_view, 9> broad_names = {
    "sweep-one-axis", "sweep-and-prune", "packed-rtree", "verlet-list", "hierarchical-grid",
    "linear-bvh",     "dynamic-bvh",     "uniform-grid", "naive"};
// The peers at the end are left out if they are not built. A pair that gjk-lanes does not take goes
// to the algorithm behind it.
constexpr std::array<std::string_view, 16> narrow_names = {"gjk",
                                                           "gjk-lanes+gjk",
                                                           "closed-form+gjk",
                                                           "closed-form+gjk-lanes+gjk",
                                                           "ellipsoid+gjk",
                                                           "sat+gjk",
                                                           "sat-faces+gjk",
                                                           "gjk-nesterov",
                                                           "gjk-switched",
                                                           "mpr",
                                                           "certified",
                                                           "closed-form+certified",
                                                           "bullet-gjk-epa",
                                                           "fcl-libccd",
                                                           "libccd-mpr",
                                                           "libccd-gjk"};
constexpr std::array<std::string_view, 20> forms = {"sphere",
                                                    "sphere inner",
                                                    "box",
                                                    "oriented-box",
                                                    "capsule",
                                                    "dop-14",
                                                    "dop-18",
                                                    "dop-26",
                                                    "hull-8",
                                                    "hull-16",
                                                    "hull-16 inner",
                                                    "hull-32",
                                                    "hull-64",
                                                    "hull",
                                                    "parts",
                                                    "mesh",
                                                    "icosphere-0",
                                                    "icosphere-1",
                                                    "icosphere-1 inner",
                                                    "icosphere-2"};

bool is_built_chain(std::string_view name) {
  for (;;) {
    const std::size_t plus = name.find('+');
    const NarrowPhaseEntry* entry = registry::find<NarrowPhaseEntry>(name.substr(0, plus));
    if (entry == nullptr || !is_built(entry->info)) return false;
    if (plus == std::string_view::npos) return true;
    name.remove_prefix(plus + 1);
  }
}

std::vector<NarrowChain> chains(std::span<const std::string_view> names) {
  std::vector<NarrowChain> chains;
  for (const std::string_view name : names) {
    if (is_built_chain(name)) chains.push_back(parse_chain(name));
  }
  return chains;
}

std::vector<NarrowChain> all_chains(Task task) {
  std::vector<NarrowChain> all = chains(narrow_names);
  // The verdicts of mpr-refined equal those of mpr, so it is added for depths only.
  if (task == Task::penetration) all.push_back(parse_chain("mpr-refined"));
  return all;
}

std::vector<BoxChoice> box_choices() {
  return {
      {}, {BoxChoice::Kind::loose, 0}, {BoxChoice::Kind::fat, 0.05}, {BoxChoice::Kind::fat, 0.2}};
}

std::vector<const BroadPhaseEntry*> broad_entries() {
  std::vector<const BroadPhaseEntry*> entries;
  for (const std::string_view name : broad_names)
    entries.push_back(registry::find<BroadPhaseEntry>(name));
  return entries;
}

Representations same_for_all(const proxies::Representation& representation) {
  Representations all;
  all.of.fill(representation);
  return all;
}

const NarrowChain quickest() { return parse_chain("closed-form+gjk"); }

TradeGrid representation_grid(const BroadPhaseEntry& broad) {
  TradeGrid grid;
  grid.representations.clear();
  for (const std::string_view form : forms) {
    grid.representations.push_back(same_for_all(proxies::parse_representation(form)));
  }
  grid.boxes = {{}, {BoxChoice::Kind::loose, 0}};
  grid.broad = {&broad};
  grid.narrow = {quickest(), {}};
  grid.scalars = {Precision::float64, Precision::float32};
  return grid;
}

}  // namespace

std::vector<TradeGrid> default_grids(Task task, const BroadPhaseEntry& broad) {
  const std::vector<Precision> both = {Precision::float64, Precision::float32};
  TradeGrid algorithms;
  algorithms.broad = {&broad};
  algorithms.narrow = all_chains(task);
  algorithms.scalars = both;

  TradeGrid tolerances = algorithms;
  tolerances.narrow = {parse_chain("gjk")};
  tolerances.tolerances = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14};
  TradeGrid caps = algorithms;
  constexpr std::array<std::string_view, 2> capped = {"gjk", "mpr"};
  caps.narrow = chains(capped);
  caps.scalars = {Precision::float64};
  caps.max_iterations = {1, 2, 4, 8, 16, 32};

  TradeGrid boxes = algorithms;
  boxes.boxes = box_choices();
  boxes.narrow = {quickest(), {}};
  boxes.scalars = both;
  TradeGrid broads = algorithms;
  broads.broad = broad_entries();
  broads.narrow = {quickest()};
  broads.scalars = {Precision::float64};

  // Whether decompositions beat the meshes themselves.
  TradeGrid whole;
  whole.representations = {same_for_all(proxies::parse_representation("mesh")),
                           same_for_all(proxies::parse_representation("parts"))};
  whole.broad = {&broad};
  whole.concave = {registry::find<ConcaveEntry>("fused")};
  std::vector<TradeGrid> grids = {
      algorithms, tolerances, caps, boxes, broads, whole, representation_grid(broad)};
  // A verdict needs no number, so one tolerance is enough.
  if (task == Task::intersect) grids.erase(grids.begin() + 1);
  return grids;
}

std::vector<TradeGrid> grids_like(const Configuration& configuration, Task task) {
  TradeGrid broad = grid_of(configuration);
  broad.boxes = box_choices();
  broad.broad = broad_entries();
  if (configuration.narrow.empty()) return {broad};  // also of a concave phase
  TradeGrid narrow = grid_of(configuration);
  narrow.narrow = all_chains(task);
  narrow.scalars = {Precision::float64, Precision::float32};
  return {broad, narrow};
}

void add_kinds(const SceneFrames& frames, std::vector<TradeGrid>& grids) {
  std::vector<std::size_t> kinds;
  for (std::size_t body = 0; body < frames.scene->bodies.size(); ++body) {
    const std::size_t kind = frames.kind_of(body);
    if (kind == static_cast<std::size_t>(ShapeKind::halfspace)) continue;
    if (std::ranges::find(kinds, kind) == kinds.end()) kinds.push_back(kind);
  }
  if (kinds.size() < 2) return;
  TradeGrid each = grids.back();
  each.representations.clear();
  for (const std::size_t kind : kinds) {
    for (const std::string_view form : forms) {
      Representations one;
      one.of[kind] = proxies::parse_representation(form);
      each.representations.push_back(one);
    }
  }
  grids.push_back(std::move(each));
}

const BroadPhaseEntry& fastest_broad(const SceneFrames& frames, StandInLibrary& library) {
  TradeGrid trial;
  trial.broad = broad_entries();
  trial.narrow = {{}};
  const GridPoints grid = expand({&trial, 1}, frames, library, Task::intersect);
  if (grid.points.empty()) return *trial.broad.front();  // the scene lists its pairs
  // The trial needs no truth, because it does not look at the answers.
  std::vector<FrameTruth> order;
  const std::vector<std::size_t> sampled = sampling_order(frames.frames.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(sampled.size(), 8); ++i) {
    order.push_back({sampled[i], {}});
  }
  const std::vector<Evaluation> found = evaluate(frames, grid.points, order, Task::intersect);
  const BroadPhaseEntry* best = trial.broad.front();
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].ok() || !(found[i].rough_seconds() < least)) continue;
    least = found[i].rough_seconds();
    best = grid.points[i].configuration.broad;
  }
  return *best;
}

}  // namespace touchstone::trade
