#include "harness/run/campaign.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "harness/run/selection.h"
#include "harness/scene/toml_table.h"

namespace touchstone {
namespace {

constexpr std::array<std::string_view, 2> box_names = {"tight", "loose"};
constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};
constexpr std::array<std::string_view, 3> task_names = {"intersect", "distance", "penetration"};
constexpr std::array<std::string_view, 2> pairing_names = {"separate", "product"};
constexpr std::int64_t greatest_count = 100'000'000;

// The group's value where it has one, else the file's.
class Settings {
 public:
  Settings(TomlTable& file, TomlTable& group) : file_(&file), group_(&group) {}

  TomlTable& of(std::string_view key) {
    const bool own = group_->has(key);
    file_->has(key);  // known there too, whether it counts or not
    return own ? *group_ : *file_;
  }
  // The elements of an array; one value stands for an array of it. Empty where there is none.
  std::vector<const toml::node*> elements(std::string_view key) {
    TomlTable& table = of(key);
    const toml::node* node = table.node(key);
    std::vector<const toml::node*> list;
    if (node == nullptr) return list;
    if (const toml::array* array = node->as_array()) {
      for (const toml::node& element : *array) list.push_back(&element);
      if (list.empty()) table.fail(key, "found an empty array; expected at least one value");
    } else {
      list.push_back(node);
    }
    return list;
  }
  std::vector<std::string> texts(std::string_view key, std::vector<std::string> fallback) {
    std::vector<std::string> values;
    for (const toml::node* node : elements(key)) {
      const auto* value = node->as_string();
      if (value == nullptr) of(key).fail(key, "expected texts");
      values.push_back(value->get());
    }
    return values.empty() ? fallback : values;
  }
  std::vector<std::int64_t> integers(std::string_view key, std::int64_t low, std::int64_t high,
                                     std::int64_t fallback) {
    std::vector<std::int64_t> values;
    for (const toml::node* node : elements(key)) {
      const auto* value = node->as_integer();
      if (value == nullptr || value->get() < low || value->get() > high) {
        of(key).fail(key, fmt::format("expected whole numbers from {} to {}", low, high));
      }
      values.push_back(value->get());
    }
    if (values.empty()) values.push_back(fallback);
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
  TomlTable* file_;
  TomlTable* group_;
};

template <class Entry>
std::vector<const Entry*> algorithms(Settings& settings, const std::string& key,
                                     std::span<const Entry> entries) {
  const std::vector<std::string> names = settings.texts(key, {"ours", "peers"});
  try {
    return select(entries, names, key + " phase");
  } catch (const InputError& error) {
    settings.of(key).fail(key, error.what());
  }
}

// Each algorithm with each scalar that it offers and each tolerance.
std::vector<NarrowChoice> narrow_choices(Settings& settings) {
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
  std::vector<NarrowChoice> choices;
  for (const NarrowPhaseEntry* entry : algorithms(settings, "narrow", narrow_phases())) {
    for (const Precision scalar : scalars) {
      if (!offers(*entry, scalar)) continue;
      for (const std::optional<double> tolerance : tolerances) {
        choices.push_back({entry, {scalar, tolerance, max_iterations}});
      }
    }
  }
  return choices;
}

CampaignGroup read_group(Settings settings, const std::filesystem::path& folder) {
  CampaignGroup group;
  for (const std::string& scene : settings.texts("scenes", {}))
    group.scenes.push_back(folder / scene);
  if (group.scenes.empty()) settings.of("scenes").fail("scenes", "missing; expected scene files");
  group.counts = settings.integers("counts", 1, greatest_count, -1);
  group.seeds = settings.integers("seeds", 0, std::numeric_limits<std::int64_t>::max(), -1);
  group.frames = static_cast<int>(settings.of("frames").integer("frames", 1, 1'000'000, -1));
  group.boxes = settings.choices<BoxKind>("boxes", box_names, {BoxKind::tight});
  group.threads.clear();
  for (const std::int64_t threads : settings.integers("threads", 1, 1024, 2)) {
    group.threads.push_back(static_cast<int>(threads));
  }
  group.rebuild = settings.of("rebuild").boolean("rebuild", false);
  group.broad = algorithms(settings, "broad", broad_phases());
  group.narrow = narrow_choices(settings);
  group.tasks = settings.choices<Task>("tasks", task_names, {Task::intersect});
  group.pairing = static_cast<Pairing>(settings.of("pairing").choice("pairing", pairing_names, 0));
  group.time_limit = settings.of("time_limit").number("time_limit", positive, 10.0);
  return group;
}

}  // namespace

Campaign read_campaign(const std::filesystem::path& file) {
  const toml::table root = parse_toml(file);
  TomlTable table(root, file.string(), "");
  Campaign campaign;
  campaign.name = table.text("name", file.stem().string());
  campaign.seed = static_cast<std::uint64_t>(
      table.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 1));
  const std::filesystem::path folder = file.parent_path();
  if (table.has("group")) {
    for (TomlTable& group : table.tables("group")) {
      campaign.groups.push_back(read_group(Settings(table, group), folder));
      group.finish();
    }
  } else {
    const toml::table nothing;
    TomlTable empty(nothing, file.string(), "");
    campaign.groups.push_back(read_group(Settings(table, empty), folder));
  }
  table.finish();
  return campaign;
}

}  // namespace touchstone
