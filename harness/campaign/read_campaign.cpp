// Reads campaign files.
#include "harness/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"
#include "harness/modules/modules.h"

namespace touchstone::campaign {
namespace {

constexpr std::array<std::string_view, 2> box_names = {"tight", "loose"};
constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};
constexpr std::array<std::string_view, 5> task_names = {"intersect", "distance", "penetration",
                                                        "signed", "contacts"};
constexpr std::array<std::string_view, 3> isa_names = {"all", "avx2", "baseline"};
enum class IsaChoice : std::uint8_t { all, avx2, baseline };
constexpr std::array<std::string_view, 2> executor_names = {"crew", "onetbb"};
constexpr std::array<std::string_view, 2> pairing_names = {"separate", "product"};
constexpr std::int64_t greatest_count = 100'000'000;

// The group's value if it has one, else the file's.
class Settings {
 public:
  Settings(files::TomlTable& file, files::TomlTable& group) : file_(&file), group_(&group) {}

  files::TomlTable& of(std::string_view key) {
    const bool own = group_->has(key);
    file_->has(key);  // marks the file's key as known, even if the group's value replaces it
    return own ? *group_ : *file_;
  }
  std::vector<const toml::node*> elements(std::string_view key) { return of(key).elements(key); }
  std::vector<std::string> texts(std::string_view key, std::vector<std::string> fallback) {
    return of(key).texts(key, std::move(fallback));
  }
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t low, std::int64_t high,
                                     std::int64_t fallback) {
    return of(key).integers(key, low, high, fallback);
  }
  // Returns numbers from -`greatest` to `greatest`.
  std::vector<double> numbers(std::string_view key, double greatest) {
    std::vector<double> values;
    for (const toml::node* node : elements(key)) {
      const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
      if (!value || !(std::abs(*value) <= greatest)) {
        of(key).fail(key, fmt::format("expected numbers from -{} to {}", greatest, greatest));
      }
      values.push_back(*value);
    }
    return values;
  }
  template <class Value, std::size_t size>
  std::vector<Value> choices(std::string_view key, const std::array<std::string_view, size>& names,
                             std::vector<Value> fallback) {
    std::vector<Value> values;
    for (const toml::node* node : elements(key)) {
      values.push_back(static_cast<Value>(of(key).choice_of(*node, key, names)));
    }
    return values.empty() ? fallback : values;
  }

 private:
  files::TomlTable* file_;
  files::TomlTable* group_;
};

template <class Entry>
std::vector<const Entry*> algorithms(Settings& settings, const std::string& key,
                                     std::span<const Entry> entries,
                                     const std::vector<std::string>& usual = {"ours", "peers",
                                                                              "modules"}) {
  const std::vector<std::string> names = settings.texts(key, usual);
  try {
    return kinds::select(entries, names, key == "mid_phases" ? "mid-phase" : key + " phase");
  } catch (const base::InputError& error) {
    settings.of(key).fail(key, error.what());
  }
}

// Returns cold, warm, or both, cold first.
std::vector<bool> warm_starts(Settings& settings) {
  bool cold = false, warm = false;
  for (const toml::node* node : settings.elements("warm")) {
    const auto* value = node->as_boolean();
    if (value == nullptr) settings.of("warm").fail("warm", "expected true, false, or both");
    (value->get() ? warm : cold) = true;
  }
  std::vector<bool> starts;
  if (cold || !warm) starts.push_back(false);
  if (warm) starts.push_back(true);
  return starts;
}

// Returns the numbers of pairs of a call.
std::vector<int> batches(Settings& settings) {
  std::vector<int> sizes;
  for (const toml::node* node : settings.elements("batch")) {
    const std::optional<std::int64_t> value =
        node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (!value || *value < 1 || *value > measure::usual_batch) {
      settings.of("batch").fail(
          "batch", fmt::format("expected whole numbers from 1 to {}", measure::usual_batch));
    }
    sizes.push_back(static_cast<int>(*value));
  }
  if (sizes.empty()) sizes.push_back(measure::usual_batch);
  return sizes;
}

// Returns each algorithm with each of its scalars, each tolerance, each start that it offers and
// each batch.
std::vector<measure::NarrowChoice> narrow_choices(Settings& settings) {
  const auto scalars = settings.choices<Precision>("scalars", scalar_names,
                                                   {Precision::float32, Precision::float64});
  std::vector<std::optional<double>> tolerances;
  for (const toml::node* node : settings.elements("tolerances")) {
    const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !(*value > 0 && *value < 1)) {
      settings.of("tolerances").fail("tolerances", "expected numbers between 0 and 1");
    }
    tolerances.push_back(value);
  }
  if (tolerances.empty()) tolerances.emplace_back();
  std::optional<int> max_iterations;
  if (settings.of("max_iterations").has("max_iterations")) {
    max_iterations =
        static_cast<int>(settings.of("max_iterations").integer("max_iterations", 1, 1'000'000));
  }
  std::optional<double> duality_gap;
  files::TomlTable& gap_holder = settings.of("duality_gap");
  if (gap_holder.has("duality_gap"))
    duality_gap = gap_holder.number("duality_gap", files::positive);
  const std::vector<bool> starts = warm_starts(settings);
  const std::vector<int> sizes = batches(settings);
  std::vector<measure::NarrowChoice> choices;
  for (const NarrowPhaseEntry* entry :
       algorithms(settings, "narrow", registry::entries<NarrowPhaseEntry>())) {
    if (duality_gap && !entry->traits.stops_by_duality_gap) {
      gap_holder.fail("duality_gap",
                      fmt::format("given with '{}', which does not stop by it; "
                                  "expected only {}",
                                  entry->info.name, kinds::names_stopping_by_duality_gap()));
    }
    for (const Precision scalar : scalars) {
      if (!offers(*entry, scalar)) continue;
      for (const std::optional<double> tolerance : tolerances) {
        const NarrowPhaseSettings own{.scalar = scalar,
                                      .tolerance = tolerance,
                                      .max_iterations = max_iterations,
                                      .duality_gap = duality_gap};
        for (const bool warm : starts) {
          // An algorithm without warm starts is measured once, cold.
          if (!entry->traits.starts_warm && warm != starts.front()) continue;
          for (const int batch : sizes)
            choices.push_back({entry, own, warm && entry->traits.starts_warm, batch});
        }
      }
    }
  }
  return choices;
}

// Returns each concave phase with each of its scalars, and those that take any mid-phase with each.
std::vector<measure::NarrowChoice> concave_choices(Settings& settings) {
  if (!registry::is_whole()) return {};  // the standard campaign has no such bodies
  const auto scalars = settings.choices<Precision>("scalars", scalar_names,
                                                   {Precision::float32, Precision::float64});
  return measure::concave_choices(
      algorithms(settings, "concave", registry::entries<ConcaveEntry>()),
      algorithms(settings, "mid_phases", registry::entries<MidPhaseEntry>(),
                 {std::string(measure::usual_mid_phase)}),
      scalars);
}

std::vector<CampaignRule> rules(Settings& settings, const std::string& key) {
  std::vector<CampaignRule> rules;
  files::TomlTable& holder = settings.of(key);
  for (const toml::node* node : settings.elements(key)) {
    files::TomlTable table = holder.from(*node, key);
    CampaignRule& rule = rules.emplace_back();
    const auto text = [&](const char* name, std::optional<std::string>& value) {
      if (table.has(name)) value = table.text(name);
    };
    const auto choice = [&](const char* name, const auto& names, auto& value) {
      using Value = typename std::remove_reference_t<decltype(value)>::value_type;
      if (table.has(name)) value = static_cast<Value>(table.choice(name, names));
    };
    text("broad", rule.broad);
    text("narrow", rule.narrow);
    text("scene", rule.scene);
    text("pair_kind", rule.pair_kind);
    choice("scalar", scalar_names, rule.scalar);
    choice("task", task_names, rule.task);
    choice("boxes", box_names, rule.boxes);
    if (table.has("threads")) rule.threads = static_cast<int>(table.integer("threads", 1, 1024));
    if (table.has("warm")) rule.warm = table.boolean("warm", false);
    if (table.has("batch"))
      rule.batch = static_cast<int>(table.integer("batch", 1, measure::usual_batch));
    if (table.has("counts_above")) {
      rule.counts_above = table.integer("counts_above", 0, greatest_count);
    }
    if (table.has("counts_below")) {
      rule.counts_below = table.integer("counts_below", 0, greatest_count);
    }
    if (rule.broad && rule.narrow) {
      table.fail("narrow", "a rule is about a broad phase or a narrow phase, not both");
    }
    // The first program has the standard campaign alone, which excludes what is not in its list.
    if (!registry::is_whole()) {
      table.finish();
      continue;
    }
    if (rule.broad && registry::find<BroadPhaseEntry>(*rule.broad) == nullptr) {
      table.fail("broad", "no broad phase is called '" + *rule.broad + "'");
    }
    if (rule.narrow && registry::find<NarrowPhaseEntry>(*rule.narrow) == nullptr &&
        registry::find<ConcaveEntry>(rule.narrow->substr(0, rule.narrow->find(' '))) == nullptr) {
      table.fail("narrow", "no narrow phase is called '" + *rule.narrow + "'");
    }
    table.finish();
  }
  return rules;
}

std::optional<Isa> limit_of(IsaChoice choice) {
  switch (choice) {
    case IsaChoice::all: break;
    case IsaChoice::avx2: return Isa::avx2;
    case IsaChoice::baseline: return Isa::baseline;
  }
  return std::nullopt;
}

// Defaults alone need no scenes.
enum class Whole : std::uint8_t { group, defaults };

CampaignGroup read_group(Settings settings, const std::filesystem::path& folder, Whole whole) {
  CampaignGroup group;
  for (const std::string& scene : settings.texts("scenes", {}))
    group.scenes.push_back(folder / scene);
  if (group.scenes.empty() && whole == Whole::group)
    settings.of("scenes").fail("scenes", "missing; expected scene files");
  group.counts = settings.integers("counts", 1, greatest_count, -1);
  group.seeds = settings.integers("seeds", 0, std::numeric_limits<std::int64_t>::max(), -1);
  const std::vector<double> gaps = settings.numbers("gaps", 1e6);
  if (!gaps.empty()) group.gaps.assign(gaps.begin(), gaps.end());
  group.frames = static_cast<int>(settings.of("frames").integer("frames", 1, 1'000'000, -1));
  group.boxes = settings.choices<scene::BoxKind>("boxes", box_names, {scene::BoxKind::tight});
  group.threads.clear();
  for (const std::int64_t threads : settings.integers("threads", 1, 1024, 2)) {
    group.threads.push_back(static_cast<int>(threads));
  }
  group.executors = settings.choices<ExecutorKind>("executor", executor_names, {usual_executor});
  group.isa.clear();
  for (const IsaChoice choice : settings.choices<IsaChoice>("isa", isa_names, {IsaChoice::all})) {
    group.isa.push_back(limit_of(choice));
  }
  group.rebuild = settings.of("rebuild").boolean("rebuild", false);
  group.broad = algorithms(settings, "broad", registry::entries<BroadPhaseEntry>());
  group.limit = settings.of("limit").boolean("limit", false);
  group.narrow = narrow_choices(settings);
  group.concave = concave_choices(settings);
  group.tasks =
      settings.choices<record::QueryTask>("tasks", task_names, {record::QueryTask::intersect});
  group.pairing = static_cast<Pairing>(settings.of("pairing").choice("pairing", pairing_names, 0));
  group.time_limit = settings.of("time_limit").number("time_limit", files::positive, 10.0);
  group.memory_limit = static_cast<std::size_t>(
                           settings.of("memory_limit").integer("memory_limit", 1, 1 << 24, 4096))
                       << 20;
  group.width = settings.of("width").number("width", {.low = 1e-4, .high = 10}, 0.02);
  group.seconds = settings.of("seconds").number("seconds", files::positive, 10.0);
  if (settings.of("squares").has("squares")) {
    group.squares = static_cast<int>(settings.of("squares").integer("squares", 6, 10'000));
  }
  if (settings.of("rounds").has("rounds")) {
    group.rounds = static_cast<int>(settings.of("rounds").integer("rounds", 1, 4));
  }
  group.processes = static_cast<int>(settings.of("processes").integer("processes", 1, 6, 3));
  group.include = rules(settings, "include");
  group.exclude = rules(settings, "exclude");
  return group;
}

}  // namespace

Campaign read_campaign(const std::filesystem::path& file, const std::filesystem::path& home) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable table(root, file.string(), "");
  Campaign campaign;
  campaign.name = files::folder_name(table, file);
  campaign.seed = static_cast<std::uint64_t>(
      table.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 1));
  campaign.published = stats::read_published(table);
  const std::filesystem::path folder = home.empty() ? file.parent_path() : home;
  for (const std::string& module_file : table.texts("modules", {}))
    modules::load(folder / module_file);
  const toml::table nothing;
  files::TomlTable empty(nothing, file.string(), "");
  if (table.has("group")) {
    // A wrong default is reported even if every group has a value of its own.
    read_group(Settings(table, empty), folder, Whole::defaults);
    for (files::TomlTable& group : table.tables("group")) {
      campaign.groups.push_back(read_group(Settings(table, group), folder, Whole::group));
      group.finish();
    }
  } else {
    campaign.groups.push_back(read_group(Settings(table, empty), folder, Whole::group));
  }
  table.finish();
  return campaign;
}

}  // namespace touchstone::campaign
