// Reads and writes the request of a trade.
#include "harness/trade/trade_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"
#include "harness/modules/modules.h"

namespace touchstone::trade {
namespace {

constexpr std::array<std::string_view, 2> scalar_names = {"float", "double"};
constexpr std::array<std::string_view, 2> executor_names = {"crew", "onetbb"};

// Converts each element with `make`; an error that it throws is reported with the element's place.
template <class Value, class Make>
void read_axis(files::TomlTable& table, std::string_view key, std::vector<Value>& values,
               const Make& make) {
  const auto nodes = table.elements(key);
  if (nodes.empty()) return;
  values.clear();
  for (const toml::node* node : nodes) {
    try {
      values.push_back(make(*node));
    } catch (const base::InputError& error) {
      table.fail(key, error.what());
    }
  }
}

std::string text_of(const toml::node& node) {
  const auto* text = node.as_string();
  if (text == nullptr) throw base::InputError("expected texts");
  return text->get();
}

Representations representations_of(const toml::node& node) {
  Representations representations;
  if (const toml::table* kinds = node.as_table()) {
    for (const auto& [name, value] : *kinds) {
      std::size_t kind = 0;
      while (kind < body_kinds && body_kind_name(kind) != name.str()) ++kind;
      if (kind == body_kinds || kind == static_cast<std::size_t>(ShapeKind::halfspace)) {
        throw base::InputError(fmt::format(
            "found \"{}\"; expected a kind of bodies: sphere, capsule, box, cylinder, cone, "
            "ellipsoid, hull, mesh",
            name.str()));
      }
      representations.of[kind] = proxies::parse_representation(text_of(value));
    }
    return representations;
  }
  representations.of.fill(proxies::parse_representation(text_of(node)));
  return representations;
}

BoxChoice boxes_of(const toml::node& node) {
  const std::string text = text_of(node);
  const std::optional<BoxChoice> choice = parse_box_choice(text);
  if (!choice) {
    throw base::InputError(fmt::format(
        "found \"{}\"; expected tight, loose, or fat-M with a margin M above 0 and up to 10",
        text));
  }
  return *choice;
}

NarrowChain chain_of(const toml::node& node) { return parse_chain(text_of(node)); }

std::optional<double> tolerance_of(const toml::node& node) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value > 0 && *value < 1))
    throw base::InputError("expected numbers between 0 and 1");
  return value;
}

std::optional<int> cap_of(const toml::node& node) {
  const auto* value = node.as_integer();
  if (value == nullptr || value->get() < 1 || value->get() > 1'000'000) {
    throw base::InputError("expected whole numbers from 1 to 1000000");
  }
  return static_cast<int>(value->get());
}

TradeGrid read_grid(files::TomlTable& table) {
  TradeGrid grid;
  read_axis(table, "representations", grid.representations, representations_of);
  read_axis(table, "boxes", grid.boxes, boxes_of);
  std::vector<std::string> names = {"sweep-and-prune"};
  read_axis(table, "broad", names, text_of);
  try {
    grid.broad = kinds::select(registry::entries<BroadPhaseEntry>(), names, "broad phase");
  } catch (const base::InputError& error) {
    table.fail("broad", error.what());
  }
  if (grid.broad.empty()) table.fail("broad", "found none; expected at least one");
  names = {"none"};
  read_axis(table, "concave", names, text_of);
  try {
    grid.concave = kinds::select(registry::entries<ConcaveEntry>(), names, "concave phase");
  } catch (const base::InputError& error) {
    table.fail("concave", error.what());
  }
  if (grid.concave.empty()) grid.narrow = {parse_chain("gjk")};
  read_axis(table, "narrow", grid.narrow, chain_of);
  read_axis(table, "scalars", grid.scalars, [&](const toml::node& node) {
    return static_cast<Precision>(table.choice_of(node, "scalars", scalar_names));
  });
  read_axis(table, "tolerances", grid.tolerances, tolerance_of);
  read_axis(table, "max_iterations", grid.max_iterations, cap_of);
  table.finish();
  return grid;
}

std::string in_quotes(std::string_view text) {
  std::string line = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') line += '\\';
    line += c;
  }
  return line + '"';
}

std::string describe(const Representations& representations) {
  std::string kinds;
  bool all = true;
  for (std::size_t kind = 0; kind < body_kinds; ++kind) {
    const auto& of = representations.of[kind];
    all = all && of && *of == *representations.of[0];
    if (!of || kind == static_cast<std::size_t>(ShapeKind::halfspace)) continue;
    kinds += fmt::format("{}{} = {}", kinds.empty() ? "" : ", ", body_kind_name(kind),
                         in_quotes(to_string(*of)));
  }
  return all ? in_quotes(to_string(*representations.of[0])) : "{" + kinds + "}";
}

template <class Values, class Text>
std::string line_of(std::string_view key, const Values& values, const Text& text) {
  std::vector<std::string> texts;
  for (const auto& value : values) texts.push_back(text(value));
  return fmt::format("{} = [{}]\n", key, fmt::join(texts, ", "));
}

std::string describe(const TradeGrid& grid) {
  std::string text = "\n[[trade.grid]]\n";
  text += line_of("representations", grid.representations,
                  [](const Representations& r) { return describe(r); });
  text += line_of("boxes", grid.boxes, [](const BoxChoice& b) { return in_quotes(b.name()); });
  // A scene that lists its pairs has no broad phase.
  if (!grid.broad.empty() && grid.broad.front() != nullptr) {
    text += line_of("broad", grid.broad,
                    [](const BroadPhaseEntry* b) { return in_quotes(b->info.name); });
  }
  if (!grid.narrow.empty()) {
    text += line_of("narrow", grid.narrow,
                    [](const NarrowChain& c) { return in_quotes(chain_name(c)); });
  }
  if (!grid.concave.empty()) {
    text += line_of("concave", grid.concave,
                    [](const ConcaveEntry* entry) { return in_quotes(entry->info.name); });
  }
  text += line_of("scalars", grid.scalars,
                  [](Precision scalar) { return in_quotes(to_string(scalar)); });
  if (grid.tolerances.front()) {
    text += line_of("tolerances", grid.tolerances, [](std::optional<double> tolerance) {
      const std::string number = fmt::format("{}", *tolerance);
      // A float of TOML has a point or an exponent.
      return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
    });
  }
  if (grid.max_iterations.front()) {
    text += line_of("max_iterations", grid.max_iterations,
                    [](std::optional<int> cap) { return std::to_string(*cap); });
  }
  return text;
}

}  // namespace

std::vector<TradeRequest> read_trades(const std::filesystem::path& file,
                                      const std::filesystem::path& home) {
  const toml::table root = files::parse_toml(file);
  files::TomlTable top(root, file.string(), "");
  TradeRequest request;
  request.name = files::folder_name(top, file);
  // Modules come first, since grids name their algorithms.
  const std::filesystem::path folder = home.empty() ? file.parent_path() : home;
  for (const std::string& module_file : top.texts("modules", {}))
    modules::load(folder / module_file);
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  request.seed = static_cast<std::uint64_t>(top.integer("seed", 0, most, 1));
  files::TomlTable table = top.inside("trade", "trade");
  const std::vector<std::string> scenes = table.texts("scene", {});
  if (scenes.empty()) table.fail("scene", "missing; expected a scene file, or several");
  const std::vector<std::int64_t> counts = table.integers("count", 1, 100'000'000, -1);
  const std::vector<std::int64_t> seeds = table.integers("seed", 0, most, -1);
  request.overrides.frames = static_cast<int>(table.integer("frames", 1, 1'000'000, -1));
  request.task = static_cast<Task>(table.choice("task", traded_tasks, 0));
  request.threads = static_cast<int>(table.integer("threads", 1, 1024, 2));
  request.executor = static_cast<ExecutorKind>(
      table.choice("executor", executor_names, static_cast<std::size_t>(usual_executor)));
  request.seconds = table.number("seconds", files::positive, 150.0);
  request.measure = static_cast<ErrorMeasure>(table.choice(
      "error", error_measure_names, static_cast<std::size_t>(default_measure(request.task))));
  if (table.has("grid")) {
    for (files::TomlTable& grid : table.tables("grid")) request.grids.push_back(read_grid(grid));
  }
  table.finish();
  top.finish();
  std::vector<TradeRequest> requests;
  for (const std::string& scene : scenes) {
    for (const std::int64_t count : counts) {
      for (const std::int64_t seed : seeds) {
        TradeRequest& one = requests.emplace_back(request);
        one.scene = (folder / scene).lexically_normal();
        one.overrides.count = count;
        one.overrides.seed = seed;
      }
    }
  }
  for (std::size_t i = 0; requests.size() > 1 && i < requests.size(); ++i)
    requests[i].name = files::folder_name(top, file, fmt::format("-{}", i));
  return requests;
}

std::string trade_toml(const TradeRequest& request, const std::filesystem::path& folder,
                       const std::string& comment) {
  std::string text;
  std::size_t at = 0;
  while (at < comment.size()) {
    const std::size_t end = std::min(comment.find('\n', at), comment.size());
    text += "# " + comment.substr(at, end - at) + "\n";
    at = end + 1;
  }
  const std::filesystem::path scene =
      std::filesystem::absolute(request.scene)
          .lexically_normal()
          .lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  text += fmt::format("name = {}\nseed = {}\n", in_quotes(request.name), request.seed);
  std::string module_files;
  for (const std::filesystem::path& module_file : modules::files())
    module_files += (module_files.empty() ? "" : ", ") +
                    in_quotes(std::filesystem::relative(module_file, folder).string());
  if (!module_files.empty()) text += fmt::format("modules = [{}]\n", module_files);
  text += fmt::format("\n[trade]\nscene = {}\n", in_quotes(scene.string()));
  if (request.overrides.count != -1) text += fmt::format("count = {}\n", request.overrides.count);
  if (request.overrides.seed != -1) text += fmt::format("seed = {}\n", request.overrides.seed);
  if (request.overrides.frames != -1)
    text += fmt::format("frames = {}\n", request.overrides.frames);
  text += fmt::format("task = {}\nthreads = {}\nerror = {}\nseconds = {}\n",
                      in_quotes(to_string(request.task)), request.threads,
                      in_quotes(to_string(request.measure)), request.seconds);
  if (request.executor != usual_executor)
    text += fmt::format("executor = {}\n", in_quotes(to_string(request.executor)));
  for (const TradeGrid& grid : request.grids) text += describe(grid);
  return text;
}

}  // namespace touchstone::trade
