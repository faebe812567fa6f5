// touchstone list: lists all algorithms, and why some are not built.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/modules/modules.h"
#include "harness/peer/adapters.h"

namespace touchstone::commands {
namespace {

struct Listed {
  std::string tasks, scalars;  // joined by ';'
  std::string tolerance = {};  // what a tolerance limits
  const AlgorithmInfo* info = nullptr;
  std::string_view kind = {};
  bool is_adapter = false;  // it is no entry: --peer makes it one
};

// Returns "box, pair, ...".
std::string kinds() {
  std::string words;
  registry::for_each_kind([&]<class Entry>() {
    if (!words.empty()) words += ", ";
    words += kind_words<Entry>.word;
  });
  return words;
}

template <class Enumeration>
std::string joined(const std::vector<Enumeration>& values) {
  std::string text;
  for (const Enumeration value : values) {
    if (!text.empty()) text += ';';
    text += to_string(value);
  }
  return text;
}

std::string one(Precision scalar) { return std::string(to_string(scalar)); }

Listed listed(const BroadPhaseEntry&) { return {"pairs", one(Precision::float32)}; }
Listed listed(const NarrowPhaseEntry& entry) {
  return {joined(entry.tasks), joined(entry.scalars), entry.tolerance};
}
Listed listed(const ManifoldEntry& entry) { return {"manifold", joined(entry.scalars)}; }
Listed listed(const RayCastEntry& entry) { return {joined(entry.tasks), joined(entry.scalars)}; }
Listed listed(const SceneRayCastEntry& entry) {
  return {joined(entry.tasks), one(Precision::float64)};
}
Listed listed(const PointQueryEntry& entry) { return {joined(entry.tasks), one(entry.scalar)}; }
Listed listed(const MidPhaseEntry&) { return {"pairs", one(Precision::float32)}; }
Listed listed(const ConcaveEntry& entry) { return {joined(entry.tasks), joined(entry.scalars)}; }
Listed listed(const CastEntry& entry) {
  return {entry.rotation ? "linear;rigid" : "linear", joined(entry.scalars)};
}
Listed listed(const ConfigurationEntry& entry) {
  return {joined(entry.tasks), one(Precision::float64)};
}
Listed listed(const CcdEntry&) { return {"vertex-face;edge-edge", one(Precision::float64)}; }

// The versions of adapters, which are asked where --peer names them.
const std::vector<std::pair<std::string, AlgorithmInfo>>& adapter_versions() {
  static const auto all = [] {
    std::vector<std::pair<std::string, AlgorithmInfo>> list;
    for (const peer::Adapter& adapter : peer::adapters()) {
      for (const peer::AdapterVersion& version : adapter.versions) {
        const std::string name = adapter.name + "@" + version.version;
        const std::string reason = version.is_installed ? fmt::format("`--peer {}` asks it", name)
                                                        : "not installed: " + version.install;
        for (const std::string& kind : adapter.kinds) {
          list.emplace_back(kind, AlgorithmInfo{.name = name,
                                                .citation = adapter.about,
                                                .origin = Origin::peer,
                                                .reason = reason});
        }
      }
    }
    return list;
  }();
  return all;
}

// Returns the algorithms of a kind, or of all kinds if `kind` is empty. Throws InputError if no kind
// has this word.
std::vector<Listed> algorithms_of(std::string_view kind) {
  const std::optional<KindWords> wanted = registry::kind_named(kind);
  if (!kind.empty() && !wanted) {
    throw base::InputError(
        fmt::format("no kind is called '{}'; expected one of {}", kind, kinds()));
  }
  std::vector<Listed> all;
  registry::for_each_kind([&]<class Entry>() {
    if (wanted && wanted->word != kind_words<Entry>.word) return;
    for (const Entry& entry : registry::entries<Entry>()) {
      all.push_back(listed(entry));
      all.back().info = &entry.info;
      all.back().kind = kind_words<Entry>.word;
    }
    for (const auto& [of, info] : adapter_versions()) {
      if (of == kind_words<Entry>.word)
        all.push_back({.tasks = "", .scalars = "", .info = &info, .kind = of, .is_adapter = true});
    }
  });
  return all;
}

std::string as_csv(const std::vector<Listed>& all) {
  std::string text = "name,kind,origin,built,reason,tasks,scalars,citation\n";
  for (const Listed& row : all) {
    const std::array<std::string_view, 8> fields = {
        row.info->name,
        row.kind,
        to_string(row.info->origin),
        is_built(*row.info) ? "true" : "false",
        is_built(*row.info) ? row.info->lacking : row.info->reason,
        row.tasks,
        row.scalars,
        row.info->citation};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (i > 0) text += ',';
      files::append_csv_field(text, fields[i]);
    }
    text += '\n';
  }
  return text;
}

std::string as_table(const std::vector<Listed>& all) {
  const auto widest = [&](std::string_view title, auto width_of) {
    std::size_t width = title.size();
    for (const Listed& row : all) width = std::max(width, width_of(row));
    return width;
  };
  const std::size_t name = widest("name", [](const Listed& r) { return r.info->name.size(); });
  const std::size_t tasks = widest("tasks", [](const Listed& r) { return r.tasks.size(); });
  const std::size_t scalars = widest("scalars", [](const Listed& r) { return r.scalars.size(); });
  std::string text;
  const auto line = [&](std::string_view n, std::string_view kind, std::string_view origin,
                        std::string_view t, std::string_view s, std::string_view about) {
    text += fmt::format("{:<{}}  {:<9}  {:<6}  {:<{}}  {:<{}}  {}\n", n, name, kind, origin, t,
                        tasks, s, scalars, about);
  };
  line("name", "kind", "origin", "tasks", "scalars", "from");
  for (const Listed& row : all) {
    std::string about =
        is_built(*row.info) ? row.info->citation : "not built, because " + row.info->reason;
    if (row.is_adapter) about = row.info->reason + "; " + row.info->citation;
    if (is_built(*row.info) && !row.info->lacking.empty()) about += "; " + row.info->lacking;
    if (!row.tolerance.empty()) about += "; tolerance: " + row.tolerance;
    if (!row.info->known_defect.empty()) about += " (known defect: " + row.info->known_defect + ")";
    line(row.info->name, row.kind, to_string(row.info->origin), row.tasks, row.scalars, about);
  }
  return text;
}

}  // namespace

void add_list(Arguments command) {
  const auto format = std::make_shared<std::string>("table");
  command.text("--format", *format, "How to print them").among({"table", "csv"}).show_default();
  const auto kind = std::make_shared<std::string>();
  command.text("--kind", *kind, "The kind to list: " + kinds());
  const auto with = std::make_shared<std::string>();
  command.text("--with", *with, "Also list the algorithms of these modules, such as ./libmine.so");
  command.job([format, kind, with] {
    expect_module_files(*with);
    modules::load_named(*with);
    const std::vector<Listed> all = algorithms_of(*kind);
    const std::string text = *format == "csv" ? as_csv(all) : as_table(all);
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() ||
        std::fflush(stdout) != 0) {
      throw base::InputError("standard output", 0,
                             fmt::format("cannot be written: {}", std::strerror(errno)));
    }
    return exit_done;
  });
}

}  // namespace touchstone::commands
