// touchstone show: tables and the summary from the rows of a results folder.
#include "harness/commands/show_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/commands.h"
#include "harness/files/packed_files.h"
#include "harness/record/findings.h"
#include "harness/record/machine.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/cell_tables.h"
#include "harness/stats/machines.h"
#include "harness/stats/summary.h"

namespace touchstone::commands {
namespace {

template <class Entry>
std::optional<record::RowOrigin> origin_among(std::span<const Entry> entries,
                                              const std::string& name) {
  const auto at =
      std::ranges::find_if(entries, [&](const Entry& entry) { return entry.info.name == name; });
  if (at == entries.end()) return std::nullopt;
  return record::row_origin(at->info.origin);
}

// Supplies origins for results without the column `origin`.
std::optional<record::RowOrigin> origin_of(bool narrow, const std::string& name) {
  if (!narrow && name == stats::limit_label) return record::RowOrigin::limit;
  return narrow ? origin_among(registry::entries<NarrowPhaseEntry>(), name)
                : origin_among(registry::entries<BroadPhaseEntry>(), name);
}

void write_of_cells(const std::filesystem::path& folder, const std::filesystem::path& out) {
  std::filesystem::create_directories(out);
  const std::string name = record::value_of(record::read_facts(folder / "machine.csv"), "cells");
  fmt::print("{}Tables in {}\n", stats::write_cell_tables(folder, name, out), out.string());
}

void write_tables(const ShowOptions& options) {
  const bool is_folder = std::filesystem::is_directory(options.results);
  const std::filesystem::path of(options.results);
  const std::filesystem::path folder = !options.out.empty() ? std::filesystem::path(options.out)
                                       : is_folder          ? of
                                                            : of.parent_path();
  if (stats::is_of_cells(of)) {
    const ShowOptions usual;
    if (options.noisy || options.band != usual.band || options.depth_error != usual.depth_error) {
      throw base::InputError(options.results, 0,
                             "is of a campaign with kinds, whose tables know no --noisy, --band "
                             "and --depth-error; expected none of them");
    }
    write_of_cells(is_folder ? of : of.parent_path(), folder);
    return;
  }
  const stats::ReportSetting setting = {
      .noise = options.noisy ? stats::Noise::kept : stats::Noise::left_out,
      .depth_error = options.depth_error};
  const auto of_machines = stats::read_machines(options.results, origin_of);
  if (of_machines.size() > 1) {
    fmt::print("{}", stats::write_machine_tables(of_machines, setting, options.band, folder));
    return;
  }
  const stats::Tables tables =
      stats::make_tables(of_machines.begin()->second, setting.noise, setting.depth_error);
  std::filesystem::create_directories(folder);
  stats::write_tables(tables, options.band, folder);
  fmt::print("{} times, {} ratios, {} winners ({} inputs undecided), {} exponents in {}\n",
             tables.times.size(), tables.ratios.size(), tables.winners.size(), tables.undecided,
             tables.exponents.size(), (folder / "tables.md").string());
}

// Prints the summary of a campaign's rows, of one machine; returns false if there are no such rows.
bool print_summary_of_rows(const std::filesystem::path& folder) {
  if (!std::filesystem::is_regular_file(files::row_file(folder / "raw.csv")) ||
      !std::filesystem::is_regular_file(files::row_file(folder / "departures.csv")) ||
      stats::is_of_cells(folder)) {
    return false;
  }
  const auto of_machines = stats::read_machines(folder, origin_of);
  if (of_machines.size() > 1) return false;
  const stats::Results& results = of_machines.begin()->second;
  stats::ReportSetting setting;
  const auto finished = results.machine.find("finished");
  if (finished != results.machine.end() && finished->second == "no") {
    setting.stopped = stats::Stop{"its middle", "the same command with --resume"};
  }
  const auto departures =
      record::read_rows<record::Departure>(files::row_file(folder / "departures.csv"));
  fmt::print("{}", stats::summary(results, stats::make_tables(results, setting.noise), departures,
                                  folder, setting));
  return true;
}

bool show_rows(const ShowOptions& options) {
  if (options.tables) {
    write_tables(options);
    return true;
  }
  const std::filesystem::path of(options.results);
  return print_summary_of_rows(std::filesystem::is_directory(of) ? of : of.parent_path());
}

}  // namespace

void add_show_of_any(Arguments command) { add_show(command, show_rows); }

}  // namespace touchstone::commands
