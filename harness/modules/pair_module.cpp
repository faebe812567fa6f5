// A narrow phase of a module.
#include "algorithms/registry.h"

#include <array>
#include <utility>
#include <vector>

#include "harness/modules/layouts.h"
#include "harness/modules/module_shapes.h"
#include "harness/modules/table.h"

namespace touchstone::modules {
namespace {

TouchstoneModulePairSettings settings_of(const NarrowPhaseSettings& settings) {
  return {.struct_size = sizeof(TouchstoneModulePairSettings),
          .scalar = scalar_of(settings.scalar),
          .tolerance = tolerance_of(settings.tolerance),
          .max_iterations = settings.max_iterations.value_or(0),
          .reserved = 0};
}

class PairModule final : public NarrowPhase {
 public:
  PairModule(const Offer<TouchstoneModulePairs>& offer, const NarrowPhaseSettings& settings)
      : instance_(offer, settings_of(settings)) {}

  void bind(std::span<const Shape> shapes) override {
    auto bound = std::make_unique<ModuleShapes>(shapes);
    instance_.table().bind(instance_.made(), bound->data(), bound->size());
    shapes_ = std::move(bound);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const TouchstoneModulePairBatch asked = {.struct_size = sizeof asked,
                                             .task = bit_of(task),
                                             .kind_a = static_cast<std::uint32_t>(batch.kind_a),
                                             .kind_b = static_cast<std::uint32_t>(batch.kind_b),
                                             .count = batch.size(),
                                             .first = batch.pairs.first.data(),
                                             .second = batch.pairs.second.data(),
                                             .shape_of = batch.pairs.shape_of.data(),
                                             .poses = theirs(batch.pairs.poses.data())};
    instance_.table().solve(instance_.made(), &asked, theirs(outcomes.data()));
    expect_known(outcomes.data(), batch.size(), TOUCHSTONE_MODULE_UNKNOWN, most_status,
                 instance_.name());
  }

 private:
  std::unique_ptr<ModuleShapes> shapes_;  // outlives the instance
  Instance<TouchstoneModulePairs> instance_;
};

// An entry has a plain function, which cannot hold answers: each table that says what it supports has a slot.
std::vector<Supports>& slots() {
  static std::vector<Supports> supports;
  return supports;
}
template <std::size_t slot>
bool supports_in_slot(ShapeKind a, ShapeKind b, Task task) {
  return slots()[slot][supports_place(a, b, static_cast<std::size_t>(task))];
}
constexpr auto supports_functions = []<std::size_t... slot>(std::index_sequence<slot...>) {
  return std::array{&supports_in_slot<slot>...};
}
(std::make_index_sequence<registry::most_added>());

}  // namespace

void add(Offer<TouchstoneModulePairs> offer, AlgorithmInfo info, TrialAnswers& ahead) {
  const TouchstoneModulePairs& table = offer->table;
  expect_functions(*offer, {{"bind", table.bind != nullptr}, {"solve", table.solve != nullptr}});
  expect_bits(*offer, "tasks", table.tasks, 0b1111);
  expect_bits(*offer, "scalars", table.scalars, all_scalars);
  NarrowPhaseEntry entry{.info = std::move(info),
                         .tasks = values_of<Task>(table.tasks),
                         .scalars = scalars_of(table.scalars),
                         .traits = {.approximate = table.approximate != 0,
                                    .depth_is_bound = table.depth_is_bound != 0},
                         .make = [offer](const NarrowPhaseSettings& settings) {
                           return std::make_unique<PairModule>(offer, settings);
                         }};
  const bool has_slot = table.supports != nullptr && slots().size() < registry::most_added;
  if (has_slot) entry.supports = supports_functions[slots().size()];
  registry::add(std::move(entry), registry::Timed::yes, offer->object->file().string());
  if (!has_slot) return;
  slots().push_back(
      supports_of(ahead, all_tasks.size(), [&](ShapeKind a, ShapeKind b, std::size_t task) {
        return table.supports(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                              bit_of(all_tasks[task])) != 0;
      }));
}

}  // namespace touchstone::modules
