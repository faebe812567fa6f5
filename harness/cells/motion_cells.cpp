// Scenes of bodies that move: reads what is played through them, and how.
#include <algorithm>

#include "harness/base/error.h"
#include "harness/cells/kinds.h"
#include "harness/cells/motion/motion_plan.h"
#include "harness/kinds/set_keys.h"

namespace touchstone::cells {
namespace {

constexpr std::array<std::string_view, 2> motion_names = {"as-given", "linear"};
constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};

// The chains that a key names; a group of algorithms stands for a chain of each.
template <class Entry, class MakeChain>
std::vector<std::vector<const Entry*>> chains(files::TomlTable& table, std::string_view key,
                                              std::vector<std::string> fallback,
                                              std::span<const Entry> entries,
                                              const MakeChain& make_chain, std::string_view what) {
  std::vector<std::vector<const Entry*>> all;
  for (const std::string& name : table.texts(key, std::move(fallback))) {
    try {
      if (name.find('+') != std::string::npos) {
        all.push_back(make_chain(name));
      } else {
        for (const Entry* entry : kinds::select(entries, {name}, what)) all.push_back({entry});
      }
    } catch (const base::InputError& error) {
      table.fail(key, error.what());
    }
  }
  return all;
}

std::vector<int> whole_numbers(files::TomlTable& table, std::string_view key, std::int64_t most,
                               std::int64_t fallback) {
  std::vector<int> numbers;
  for (const std::int64_t number : table.integers(key, 1, most, fallback))
    numbers.push_back(static_cast<int>(number));
  return numbers;
}

}  // namespace

std::vector<kinds::PlannedSet> motion_cells(files::TomlTable& table,
                                            const std::filesystem::path& home) {
  MotionRequest request;
  for (const std::string& scene : table.texts("scenes", {})) request.scenes.push_back(home / scene);
  if (request.scenes.empty()) table.fail("scenes", "missing; expected files of scenes");
  request.overrides.clear();
  const auto frames = static_cast<int>(table.integer("frames", 1, 1'000'000, -1));
  for (const std::int64_t count : table.integers("counts", 1, 100'000'000, -1)) {
    for (const std::int64_t seed :
         table.integers("seeds", 0, std::numeric_limits<std::int64_t>::max(), -1))
      request.overrides.push_back({.count = count, .seed = seed, .frames = frames});
  }
  request.threads = whole_numbers(table, "threads", 1024, 1);
  try {
    request.broad = kinds::select(registry::entries<BroadPhaseEntry>(),
                                  table.texts("broad", {"packed-rtree"}), "broad phase");
  } catch (const base::InputError& error) {
    table.fail("broad", error.what());
  }
  request.casts =
      chains(table, "casts", {"ours", "peers"}, registry::entries<CastEntry>(), cast_chain, "cast");
  if (table.contains("substeps")) request.substeps = whole_numbers(table, "substeps", 1'000'000, 1);
  request.narrow = chains(table, "narrow", {"closed-form+gjk"},
                          registry::entries<NarrowPhaseEntry>(), narrow_chain, "narrow phase");
  request.scalars.clear();
  for (const std::size_t scalar : kinds::choices(table, "scalars", scalar_names))
    request.scalars.push_back(static_cast<Precision>(scalar));
  if (!table.contains("scalars")) request.scalars = {Precision::float64};
  if (table.has("tolerance")) request.tolerance = table.number("tolerance", files::positive);
  request.is_linear = table.choice("motion", motion_names, 0) == 1;
  request.parts = static_cast<int>(table.integer("parts", 0, 64, 0));
  if ((request.parts & (request.parts - 1)) != 0)
    table.fail("parts", "expected 0, or 1, 2, 4, 8, 16, 32 or 64");
  return plan_motion(request);
}

}  // namespace touchstone::cells
