// Expands grids into the configurations that make sense for a scene, and has those of a request without grids.
#include "harness/trade/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <set>
#include <string_view>

#include "harness/base/error.h"
#include "harness/record/query_task.h"
#include "harness/trade/pipeline/truth.h"

namespace touchstone::trade {
namespace {

// Returns the narrow phases of the chain that take some pair of the scene; nothing, with the
// reason, if a pair is taken by none.
std::optional<NarrowChain> used(const NarrowChain& chain, const StandIns& stand_ins, Task task,
                                std::string& reason) {
  std::set<const NarrowPhaseEntry*> taking;
  for (const auto& [a, b] : stand_ins.kind_pairs) {
    const auto taker = std::ranges::find_if(
        chain, [&](const NarrowPhaseEntry* entry) { return offers(*entry, a, b, task); });
    if (taker == chain.end()) {
      reason = fmt::format("{} does not take {}-{} for {}", chain_name(chain), to_string(a),
                           to_string(b), to_string(task));
      return {};
    }
    taking.insert(*taker);
  }
  NarrowChain left;
  for (const NarrowPhaseEntry* entry : chain) {
    if (taking.contains(entry)) left.push_back(entry);
  }
  return left;
}

class Expansion {
 public:
  Expansion(const SceneFrames& frames, StandInLibrary& library, Task task)
      : frames_(&frames), library_(&library), task_(task) {}

  void add(const TradeGrid& grid) {
    for (const Representations& asked : grid.representations) {
      const Representations representations = library_->complete(asked);
      std::shared_ptr<const StandIns> stand_ins;
      try {
        stand_ins = library_->get(representations);
      } catch (const base::InputError& error) {
        leave_out(fmt::format("{}: {}", representations.name(), error.what()));
        continue;
      }
      Configuration configuration;
      configuration.representations = representations;
      for (const BoxChoice& boxes : grid.boxes) {
        configuration.boxes = boxes;
        for (const BroadPhaseEntry* broad : grid.broad) {
          configuration.broad = broad;
          if (!frames_->scene->pairs.empty()) {
            configuration.boxes = {};
            configuration.broad = nullptr;
          }
          for (const NarrowChain& chain : grid.narrow) add(configuration, stand_ins, grid, chain);
          for (const ConcaveEntry* entry : grid.concave) {
            add(configuration, stand_ins, grid, *entry);
          }
        }
      }
    }
  }

  GridPoints points;

 private:
  void leave_out(const std::string& reason) { ++points.left_out[reason]; }

  static bool has_mesh_as_given(const Representations& representations) {
    const auto& of_meshes = representations.of[mesh_body];
    return of_meshes && of_meshes->form == proxies::Form::as_given;
  }

  void add(Configuration configuration, const std::shared_ptr<const StandIns>& stand_ins,
           const TradeGrid& grid, const NarrowChain& chain) {
    if (chain.empty()) {
      configuration.narrow = {};
      configuration.settings = {};
      if (task_ != Task::intersect) return leave_out("without a narrow phase there are no numbers");
      if (configuration.broad == nullptr) {
        return leave_out("the scene lists its pairs: without a narrow phase nothing is left to do");
      }
      return keep(configuration, stand_ins);
    }
    if (has_mesh_as_given(configuration.representations)) {
      return leave_out(
          "no narrow phase takes a mesh as it is given; expected hull, parts or mesh for it, or a "
          "concave phase");
    }
    std::string reason;
    const std::optional<NarrowChain> narrow = used(chain, *stand_ins, task_, reason);
    if (!narrow) return leave_out(reason);
    configuration.narrow = *narrow;
    for (const Precision scalar : grid.scalars) {
      const auto lacks = std::ranges::find_if_not(
          *narrow, [&](const NarrowPhaseEntry* entry) { return offers(*entry, scalar); });
      if (lacks != narrow->end()) {
        leave_out(fmt::format("{} has no {}", (*lacks)->info.name, to_string(scalar)));
        continue;
      }
      for (const std::optional<double> tolerance : grid.tolerances) {
        for (const std::optional<int> cap : grid.max_iterations) {
          configuration.settings = {
              .scalar = scalar, .tolerance = tolerance, .max_iterations = cap};
          keep(configuration, stand_ins);
        }
      }
    }
  }

  void add(Configuration configuration, std::shared_ptr<const StandIns> stand_ins,
           const TradeGrid& grid, const ConcaveEntry& entry) {
    if (std::ranges::all_of(frames_->mesh_of, [](const auto* mesh) { return mesh == nullptr; })) {
      return leave_out("no body has a mesh: concave phases have nothing to do");
    }
    const std::optional<ConcaveTask> task = record::concave_task(record::query_task(task_));
    configuration.concave = &entry;
    // Both say the same to a concave phase.
    auto& of_meshes = configuration.representations.of[mesh_body];
    if (of_meshes && of_meshes->form == proxies::Form::mesh) {
      of_meshes.emplace();
      stand_ins = library_->get(configuration.representations);
    }
    for (const Precision scalar : grid.scalars) {
      if (!task || !offers(entry, *task, scalar)) {
        leave_out(fmt::format("{} has no {} for {}", entry.info.name, to_string(scalar),
                              to_string(task_)));
        continue;
      }
      configuration.settings = {.scalar = scalar};
      const std::vector<ConcaveBody> bodies = whole_bodies(*frames_, *stand_ins, configuration);
      const bool all =
          entry.supports == nullptr || std::ranges::all_of(bodies, [&](const ConcaveBody& a) {
            return std::ranges::all_of(bodies,
                                       [&](const ConcaveBody& b) { return entry.supports(a, b); });
          });
      if (all) {
        keep(configuration, stand_ins);
      } else {
        leave_out(fmt::format("{} does not take all bodies", entry.info.name));
      }
    }
  }

  void keep(const Configuration& configuration, const std::shared_ptr<const StandIns>& stand_ins) {
    if (!names_.insert(configuration.name()).second) return leave_out("the same as another");
    points.points.push_back({configuration, stand_ins});
  }

  const SceneFrames* frames_;
  StandInLibrary* library_;
  Task task_;
  std::set<std::string> names_;
};

}  // namespace

TradeGrid grid_of(const Configuration& configuration) {
  TradeGrid grid;
  grid.representations = {configuration.representations};
  grid.boxes = {configuration.boxes};
  grid.broad = {configuration.broad};
  if (configuration.concave != nullptr) {
    grid.concave = {configuration.concave};
  } else {
    grid.narrow = {configuration.narrow};
  }
  grid.scalars = {configuration.settings.scalar};
  grid.tolerances = {configuration.settings.tolerance};
  grid.max_iterations = {configuration.settings.max_iterations};
  return grid;
}

GridPoints expand(std::span<const TradeGrid> grids, const SceneFrames& frames,
                  StandInLibrary& library, Task task) {
  Expansion expansion(frames, library, task);
  for (const TradeGrid& grid : grids) expansion.add(grid);
  return std::move(expansion.points);
}

namespace {

constexpr std::array<std::string_view, 9> broad_names = {
    "sweep-one-axis", "sweep-and-prune", "packed-rtree", "verlet-list", "hierarchical-grid",
    "linear-bvh",     "dynamic-bvh",     "uniform-grid", "naive"};
// Behind these every library, and every module that was loaded. A pair that gjk-lanes does not take goes to the algorithm behind it.
constexpr std::array<std::string_view, 12> narrow_names = {
    "gjk",           "gjk-lanes+gjk", "closed-form+gjk", "closed-form+gjk-lanes+gjk",
    "ellipsoid+gjk", "sat+gjk",       "sat-faces+gjk",   "gjk-nesterov",
    "gjk-switched",  "mpr",           "certified",       "closed-form+certified"};
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
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.info.origin == Origin::peer && is_built(entry.info)) all.push_back({&entry});
    // What a module does not take goes on to gjk.
    if (entry.info.origin == Origin::module)
      all.push_back({&entry, registry::find<NarrowPhaseEntry>("gjk")});
  }
  // The verdicts of mpr-refined equal those of mpr, so it is added for depths only.
  if (task == Task::penetration) all.push_back(parse_chain("mpr-refined"));
  return all;
}

std::vector<BoxChoice> box_choices() {
  return {
      {}, {BoxChoice::Kind::loose, 0}, {BoxChoice::Kind::fat, 0.05}, {BoxChoice::Kind::fat, 0.2}};
}

// `fused`, and every library and module.
std::vector<const ConcaveEntry*> concave_entries() {
  std::vector<const ConcaveEntry*> entries = {registry::find<ConcaveEntry>("fused")};
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    const bool is_other = entry.info.origin == Origin::peer || entry.info.origin == Origin::module;
    if (is_other && is_built(entry.info)) entries.push_back(&entry);
  }
  return entries;
}

std::vector<const BroadPhaseEntry*> broad_entries() {
  std::vector<const BroadPhaseEntry*> entries;
  for (const std::string_view name : broad_names)
    entries.push_back(registry::find<BroadPhaseEntry>(name));
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin == Origin::module) entries.push_back(&entry);
  }
  return entries;
}

Representations same_for_all(const proxies::Representation& representation) {
  Representations all;
  all.of.fill(representation);
  return all;
}

// Narrow phases take the hull of a mesh; what else is stood in for is chosen by the kinds.
Representations meshes_as_hulls() {
  Representations representations;
  representations.of[mesh_body] = proxies::parse_representation("hull");
  return representations;
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
  algorithms.representations = {meshes_as_hulls()};
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
  whole.representations = {{}, same_for_all(proxies::parse_representation("parts"))};
  whole.broad = {&broad};
  whole.concave = concave_entries();
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
      Representations one = meshes_as_hulls();
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
