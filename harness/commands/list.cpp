// touchstone list: lists all algorithms, and why some are not built.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/files/csv.h"

namespace touchstone::commands {
namespace {

struct Listed {
  const AlgorithmInfo* info;
  std::string_view kind;
  std::string tasks, scalars;  // joined by ';'
  std::string tolerance = {};  // what a tolerance limits
};

template <class Enumeration>
std::string joined(const std::vector<Enumeration>& values) {
  std::string text;
  for (const Enumeration value : values) {
    if (!text.empty()) text += ';';
    text += to_string(value);
  }
  return text;
}

std::vector<Listed> all_algorithms() {
  std::vector<Listed> all;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    all.push_back({&entry.info, "broad", "pairs", std::string(to_string(Precision::float32))});
  }
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    all.push_back(
        {&entry.info, "narrow", joined(entry.tasks), joined(entry.scalars), entry.tolerance});
  }
  for (const ManifoldEntry& entry : registry::entries<ManifoldEntry>()) {
    all.push_back({&entry.info, "manifold", "manifold", joined(entry.scalars)});
  }
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    all.push_back({&entry.info, "ray", joined(entry.tasks), joined(entry.scalars)});
  }
  for (const SceneRayCastEntry& entry : registry::entries<SceneRayCastEntry>()) {
    all.push_back({&entry.info, "scene-ray", joined(entry.tasks),
                   std::string(to_string(Precision::float64))});
  }
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>()) {
    all.push_back(
        {&entry.info, "point", joined(entry.tasks), std::string(to_string(entry.scalar))});
  }
  for (const MidPhaseEntry& entry : registry::entries<MidPhaseEntry>()) {
    all.push_back({&entry.info, "mid", "pairs", std::string(to_string(Precision::float32))});
  }
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    all.push_back({&entry.info, "concave", joined(entry.tasks), joined(entry.scalars)});
  }
  for (const CastEntry& entry : registry::entries<CastEntry>()) {
    all.push_back(
        {&entry.info, "cast", entry.rotation ? "linear;rigid" : "linear", joined(entry.scalars)});
  }
  for (const CcdEntry& entry : registry::entries<CcdEntry>()) {
    all.push_back(
        {&entry.info, "ccd", "vertex-face;edge-edge", std::string(to_string(Precision::float64))});
  }
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
  command.job([format] {
    const std::vector<Listed> all = all_algorithms();
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
