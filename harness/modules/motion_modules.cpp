// Casts and continuous collision of features of a module.
#include "algorithms/registry.h"

#include <array>
#include <utility>
#include <vector>

#include "harness/modules/layouts.h"
#include "harness/modules/module_shapes.h"
#include "harness/modules/table.h"

namespace touchstone::modules {
namespace {

class CastModule final : public Cast {
 public:
  CastModule(const Offer<TouchstoneModuleCasts>& offer, const CastSettings& settings)
      : instance_(offer, TouchstoneModuleCastSettings{
                             .struct_size = sizeof(TouchstoneModuleCastSettings),
                             .scalar = scalar_of(settings.scalar),
                             .tolerance = tolerance_of(settings.tolerance),
                             .max_iterations = settings.max_iterations.value_or(0),
                             .reserved = 0}) {}

  void bind(std::span<const Shape> shapes) override {
    auto bound = std::make_unique<ModuleShapes>(shapes);
    instance_.table().bind(instance_.made(), bound->data(), bound->size());
    shapes_ = std::move(bound);
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const TouchstoneModuleCastBatch asked = {.struct_size = sizeof asked,
                                             .kind_a = static_cast<std::uint32_t>(batch.kind_a),
                                             .kind_b = static_cast<std::uint32_t>(batch.kind_b),
                                             .reserved = 0,
                                             .count = batch.size(),
                                             .first = batch.pairs.first.data(),
                                             .second = batch.pairs.second.data(),
                                             .shape_of = batch.pairs.shape_of.data(),
                                             .poses = theirs(batch.pairs.poses.data()),
                                             .motions = theirs(batch.motions.data())};
    instance_.table().solve(instance_.made(), &asked, theirs(outcomes.data()));
    expect_known(outcomes.data(), batch.size(), TOUCHSTONE_MODULE_CAST_UNKNOWN, most_status,
                 instance_.name());
  }

 private:
  std::unique_ptr<ModuleShapes> shapes_;  // outlives the instance
  Instance<TouchstoneModuleCasts> instance_;
};

// As of pairs.
std::vector<Supports>& cast_slots() {
  static std::vector<Supports> supports;
  return supports;
}
template <std::size_t slot>
bool cast_supports_in_slot(ShapeKind a, ShapeKind b, bool turns) {
  return cast_slots()[slot][supports_place(a, b, turns ? 1 : 0)];
}
constexpr auto cast_supports_functions = []<std::size_t... slot>(std::index_sequence<slot...>) {
  return std::array{&cast_supports_in_slot<slot>...};
}
(std::make_index_sequence<registry::most_added>());

class FeatureModule final : public Ccd {
 public:
  FeatureModule(const Offer<TouchstoneModuleFeaturePairs>& offer, const CcdSettings& settings)
      : instance_(offer, TouchstoneModuleFeatureSettings{
                             .struct_size = sizeof(TouchstoneModuleFeatureSettings),
                             .reserved = 0,
                             .tolerance = settings.tolerance,
                             .separation = settings.separation,
                             .max_iterations = settings.max_iterations.value_or(0),
                             .reserved_2 = 0}) {}

  void solve(FeaturePair pair, std::span<const CcdQuery> queries,
             std::span<CcdOutcome> outcomes) override {
    instance_.table().solve(instance_.made(), static_cast<std::uint32_t>(pair),
                            theirs(queries.data()), queries.size(), theirs(outcomes.data()));
    expect_known(outcomes.data(), queries.size(), TOUCHSTONE_MODULE_CAST_UNKNOWN, most_status,
                 instance_.name());
  }

 private:
  Instance<TouchstoneModuleFeaturePairs> instance_;
};

}  // namespace

void add(Offer<TouchstoneModuleCasts> offer, AlgorithmInfo info, TrialAnswers& ahead) {
  const TouchstoneModuleCasts& table = offer->table;
  expect_functions(*offer, {{"bind", table.bind != nullptr}, {"solve", table.solve != nullptr}});
  expect_bits(*offer, "scalars", table.scalars, all_scalars);
  CastEntry entry{.info = std::move(info),
                  .scalars = scalars_of(table.scalars),
                  .rotation = table.rotation != 0,
                  .make = [offer](const CastSettings& settings) {
                    return std::make_unique<CastModule>(offer, settings);
                  }};
  const bool has_slot = table.supports != nullptr && cast_slots().size() < registry::most_added;
  if (has_slot) entry.supports = cast_supports_functions[cast_slots().size()];
  registry::add(std::move(entry), registry::Timed::yes, offer->object->file().string());
  if (!has_slot) return;
  cast_slots().push_back(supports_of(ahead, 2, [&](ShapeKind a, ShapeKind b, std::size_t turns) {
    return table.supports(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                          static_cast<int>(turns)) != 0;
  }));
}

void add(Offer<TouchstoneModuleFeaturePairs> offer, AlgorithmInfo info, TrialAnswers&) {
  const TouchstoneModuleFeaturePairs& table = offer->table;
  expect_functions(*offer, {{"solve", table.solve != nullptr}});
  registry::add(CcdEntry{.info = std::move(info),
                         .separations = table.separations != 0,
                         .make =
                             [offer](const CcdSettings& settings) {
                               return std::make_unique<FeatureModule>(offer, settings);
                             }},
                registry::Timed::yes, offer->object->file().string());
}

}  // namespace touchstone::modules
