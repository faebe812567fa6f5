// Reads what is played through scenes of bodies that move, and makes the points and the front of a
// trade of motion.
#include "harness/cells/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/cells/read_cells.h"
#include "harness/files/text_file.h"
#include "harness/kinds/selection.h"
#include "harness/kinds/set_keys.h"
#include "harness/stats/cell_rows.h"
#include "harness/trade/evaluation.h"

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
  request.broad = kinds::selected(table, registry::entries<BroadPhaseEntry>(), "broad phase",
                                  "broad", {"packed-rtree"});
  request.casts = chains(table, "casts", {"ours", "peers", "modules"},
                         registry::entries<CastEntry>(), cast_chain, "cast");
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

namespace {

constexpr int most_substeps = 64;
constexpr const char* broad_name = "packed-rtree";
constexpr const char* ours_in_one_chain = "closed-form+mpr-ray-cast+gjk-ray-cast+rigid-advancement";
constexpr std::array<const char*, 3> narrow_names = {"closed-form+gjk", "closed-form+gjk-lanes+gjk",
                                                     "sat+closed-form+gjk"};
// The share of the time that goes into samples; the rest prepares and grades.
constexpr double sample_share = 0.6;

MotionPointRow point_of(const MotionMethod& method, const stats::CellTimeRow& time, double bodies) {
  const stats::GradeRow& grade = time.grade;
  MotionPointRow row;
  row.point = method.name;
  row.status = grade.status;
  row.method = method.substeps > 0 ? "discrete" : "continuous";
  row.substeps = method.substeps;
  row.broad = method.broad->info.name;
  row.narrow = method.chain_name();
  row.scalar = to_string(method.scalar);
  row.seconds = time.seconds * bodies;
  row.low = time.low * bodies;
  row.high = time.high * bodies;
  row.rounds = time.samples;
  row.true_hits = grade.true_hits;
  row.hits = grade.hits;
  row.missed = grade.missed;
  row.false_hits = grade.false_hits;
  row.unknown = grade.gave_up;
  if (grade.true_hits >= 0) {
    row.error = static_cast<double>(grade.missed) /
                static_cast<double>(std::max<std::int64_t>(grade.true_hits, 1));
  }
  return row;
}

std::vector<std::string> cells_of(const MotionPointRow& row) {
  const auto milliseconds = [](double seconds) { return fmt::format("{:.4g}", 1e3 * seconds); };
  return {row.point,
          milliseconds(row.seconds),
          std::isnan(row.low) ? "-" : milliseconds(row.low) + " to " + milliseconds(row.high),
          fmt::format("{:.2f} %", 100 * row.error),
          fmt::format("{}", row.hits),
          fmt::format("{}", row.false_hits),
          fmt::format("{}", row.unknown)};
}

}  // namespace

MotionRequest default_motion_trade(const std::filesystem::path& scene,
                                   const scene::SceneOverrides& overrides, int threads) {
  MotionRequest request;
  request.scenes = {scene};
  request.overrides = {overrides};
  request.threads = {threads};
  request.broad = {registry::find<BroadPhaseEntry>(broad_name)};
  request.casts = {cast_chain(ours_in_one_chain)};
  for (const CastEntry* entry :
       kinds::select(registry::entries<CastEntry>(), {"ours", "peers"}, "cast"))
    request.casts.push_back({entry});
  for (const char* names : narrow_names) request.narrow.push_back(narrow_chain(names));
  for (int substeps = 1; substeps <= most_substeps; substeps *= 2)
    request.substeps.push_back(substeps);
  return request;
}

MotionTrade plan_motion_trade(const MotionRequest& request, double seconds) {
  MotionTrade trade;
  const scene::Scene read = scene::load_scene(request.scenes.front(), request.overrides.front());
  trade.bodies = read.size();
  trade.steps = static_cast<std::size_t>(read.frames);
  trade.methods = methods_of(request);
  trade.cells.name = read.name;
  trade.cells.query_kind = "motion";
  trade.cells.cells = plan_motion(request);
  trade.cells.sample_seconds =
      sample_share * seconds / static_cast<double>(trade.methods.size()) / trade.cells.rounds;
  trade.cells.identity = {{"campaign", read.name},
                          {"scene", read.name},
                          {"scene_hash", scene::scene_hash(read)},
                          {"bodies", std::to_string(trade.bodies)},
                          {"frames", std::to_string(trade.steps)},
                          {"task", "motion"},
                          {"threads", std::to_string(request.threads.front())},
                          {"error", "missed-hits"}};
  return trade;
}

std::string write_motion_front(const MotionTrade& trade, const std::filesystem::path& folder) {
  const auto times = record::read_rows<stats::CellTimeRow>(folder / "set_times.csv");
  std::vector<MotionPointRow> points;
  for (const MotionMethod& method : trade.methods) {
    const auto time = std::ranges::find_if(
        times, [&](const stats::CellTimeRow& row) { return row.grade.algorithm == method.name; });
    if (time != times.end())
      points.push_back(point_of(method, *time, static_cast<double>(trade.bodies)));
  }
  if (!points.empty()) points.front().baseline = true;
  std::vector<trade::FrontPoint> all;
  for (const MotionPointRow& point : points) all.push_back({point.seconds, point.error});
  std::vector<MotionPointRow> front;
  base::Table table(
      {"method", "ms a step", "95 % interval", "hits missed", "hits", "false hits", "unknown"});
  for (const std::size_t i : trade::pareto_front(all)) {
    points[i].on_front = true;
    front.push_back(points[i]);
    table.add(cells_of(points[i]));
  }
  record::write_rows(folder / "points.csv", points);
  record::write_rows(folder / "front.csv", front);
  const std::string question =
      fmt::format("{}: {} bodies, {} step{}; the time of a step against the share of hits missed",
                  trade.cells.name, trade.bodies, trade.steps, trade.steps == 1 ? "" : "s");
  files::write_text(folder / "front.md", question + ".\n\n" + table.markdown());
  return fmt::format("{}\n\n{}\n{} methods: {} on the front\n", question,
                     table.text(base::page_width()), points.size(), front.size());
}

}  // namespace touchstone::cells
