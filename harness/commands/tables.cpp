// touchstone tables: writes the tables of a results folder, or checks whether they hold here.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <span>

#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/row_file.h"
#include "harness/process/subprocess.h"
#include "harness/record/build_info.h"
#include "harness/record/facts.h"
#include "harness/stats/cells/cell_results.h"
#include "harness/stats/cells/cell_tables.h"
#include "harness/stats/machines/machine_tables.h"
#include "harness/stats/table_check.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::commands {
namespace {

using namespace stats;

struct TablesOptions {
  std::string results, reference, out, campaign;
  double band = 1.5, depth_error = stats::usual_depth_error;
  bool check = false, noisy = false;
};

std::string number_text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.3f}", value);
}

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

int write_of_cells(const std::filesystem::path& folder, const std::filesystem::path& out) {
  std::filesystem::create_directories(out);
  const std::string name = record::value_of(record::read_facts(folder / "machine.csv"), "cells");
  fmt::print("{}Tables in {}\n", stats::write_cell_tables(folder, name, out), out.string());
  return exit_done;
}

int write(const TablesOptions& options) {
  const bool is_folder = std::filesystem::is_directory(options.results);
  const std::filesystem::path of(options.results);
  const std::filesystem::path folder = !options.out.empty() ? std::filesystem::path(options.out)
                                       : is_folder          ? of
                                                            : of.parent_path();
  if (stats::is_of_cells(of)) {
    const TablesOptions usual;
    if (options.noisy || options.band != usual.band || options.depth_error != usual.depth_error) {
      throw base::InputError(options.results, 0,
                             "is of a campaign with [cells], whose tables know no --noisy, --band "
                             "and --depth-error; expected none of them");
    }
    return write_of_cells(is_folder ? of : of.parent_path(), folder);
  }
  const stats::ReportSetting setting = {
      .noise = options.noisy ? stats::Noise::kept : stats::Noise::left_out,
      .depth_error = options.depth_error};
  const auto of_machines = stats::read_machines(options.results, origin_of);
  if (of_machines.size() > 1) {
    fmt::print("{}", stats::write_machine_tables(of_machines, setting, options.band, folder));
    return exit_done;
  }
  const stats::Tables tables =
      stats::make_tables(of_machines.begin()->second, setting.noise, setting.depth_error);
  std::filesystem::create_directories(folder);
  stats::write_tables(tables, options.band, folder);
  fmt::print("{} times, {} ratios, {} winners, {} exponents in {}\n", tables.times.size(),
             tables.ratios.size(), tables.winners.size(), tables.exponents.size(),
             (folder / "tables.md").string());
  return exit_done;
}

// Runs the reference's campaign with this program in a process of its own. Returns the folder.
std::filesystem::path run_again(const std::filesystem::path& reference,
                                const TablesOptions& options) {
  const std::filesystem::path source(record::source_folder);
  std::filesystem::path campaign = options.campaign;
  if (campaign.empty()) {
    campaign = source / "datasets/campaigns" / (stats::read_results(reference).campaign + ".toml");
  }
  if (!std::ifstream(campaign)) {
    throw base::InputError(
        campaign.string(), 0,
        "cannot be read; expected the reference's campaign (--campaign names another)");
  }
  const std::filesystem::path out = results_folder(options.out, "tables");
  std::filesystem::create_directories(out);
  fmt::print(stderr, "running {}; what it prints is in {}\n", campaign.string(),
             (out / "output.txt").string());
  const int status =
      process::run_and_wait("/proc/self/exe",
                            {"--isa", std::string(to_string(isa())), "run", campaign.string(),
                             "--out", out.string(), "--overwrite"},
                            out / "output.txt");
  if (status != exit_done && status != exit_measured_wrong) {
    throw base::InputError(fmt::format("the campaign ended with status {}; its output is in {}",
                                       status, (out / "output.txt").string()));
  }
  return out;
}

void print_lines(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  fmt::print("{}\n", title);
  for (const std::string& line : lines) fmt::print("  {}\n", line);
  fmt::print("\n");
}

int check(const std::filesystem::path& reference, const std::filesystem::path& results,
          const TablesOptions& options) {
  const stats::TableCheck found =
      stats::check_tables(reference, stats::read_results(results),
                          options.noisy ? stats::Noise::kept : stats::Noise::left_out);
  print_lines("FAIL: not the same to the digit", found.changed);
  print_lines("Not looked at", found.left_out);
  for (std::size_t i = 0; i < found.cells.size();) {
    const stats::CheckedCell& first = found.cells[i];
    base::Table table({"over " + first.baseline, "stated", "band", "here", "interval", ""});
    for (; i < found.cells.size() && found.cells[i].key == first.key; ++i) {
      const stats::CheckedCell& cell = found.cells[i];
      table.add({cell.label, number_text(cell.stated),
                 number_text(cell.band_low) + " to " + number_text(cell.band_high),
                 number_text(cell.ratio.median),
                 number_text(cell.ratio.low) + " to " + number_text(cell.ratio.high),
                 std::string(to_string(cell.state))});
    }
    fmt::print("{}\n\n{}\n", first.key.words(), table.text(base::page_width()));
  }
  const auto count = [&](stats::Holds state) {
    return std::ranges::count(found.cells, state, &stats::CheckedCell::state);
  };
  fmt::print(
      "{} cells: {} pass, {} fail, {} undecided; {} answers changed, {} not looked at, {} faster "
      "than stated\n",
      found.cells.size(), count(stats::Holds::pass), count(stats::Holds::fail),
      count(stats::Holds::undecided), found.changed.size(), found.left_out.size(),
      count(stats::Holds::faster));
  return count(stats::Holds::fail) > 0 || !found.changed.empty() ? exit_measured_wrong : exit_done;
}

int tables(const TablesOptions& options) {
  if (!options.check && options.reference.empty() && !options.results.empty()) {
    return write(options);
  }
  const std::filesystem::path reference =
      options.reference.empty() ? std::filesystem::path(record::source_folder) / "results/reference"
                                : std::filesystem::path(options.reference);
  if (!std::ifstream(reference / "ratios.csv")) {
    throw base::InputError((reference / "ratios.csv").string(), 0,
                           "cannot be read; expected a reference with tables (`touchstone tables "
                           "REFERENCE` writes them)");
  }
  if (!options.results.empty() && stats::is_of_cells(options.results)) {
    throw base::InputError(options.results, 0,
                           "is of a campaign with [cells], whose tables state no band; expected "
                           "results of a campaign of scenes (`touchstone compare` takes cells)");
  }
  const std::filesystem::path results = options.results.empty()
                                            ? run_again(reference, options)
                                            : std::filesystem::path(options.results);
  return check(reference, results, options);
}

}  // namespace

void add_tables(Arguments command) {
  auto options = std::make_shared<TablesOptions>();
  command.text("results", options->results,
               "Results folder, or raw.csv: its tables are written beside it. Without one, "
               "the campaign of the reference is run again and checked");
  const Option check =
      command
          .text("--check", options->reference,
                "Check against this reference: a results folder with tables (default: "
                "results/reference in the project)")
          .value_optional();
  command.text("--campaign", options->campaign,
               "The campaign to run again (default: the one in datasets/campaigns that has "
               "the name in the reference's raw.csv)");
  command.text("--out", options->out, "Folder for the tables, or for the campaign run again");
  command
      .number("--band", options->band,
              "Written tables state that a ratio holds within its interval, widened by this "
              "factor at both ends")
      .within_real(1, 1e6)
      .show_default();
  add_depth_error(command, options->depth_error);
  command.flag("--noisy", options->noisy,
               "Keep the rounds that were measured under noise; they are left out otherwise");
  command.footer(
      "A check looks at hashes, pair counts, contact counts and work counters first: they must be\n"
      "the same to the digit. Then a cell passes where the interval of its ratio lies within the\n"
      "stated band, and fails where it lies wholly outside; absolute times count for nothing.\n"
      "Ratios are to a library where there is one; an algorithm of ours that is faster against it\n"
      "than stated does not fail.\n\n"
      "Exit status:\n"
      "  0  written; or nothing failed\n"
      "  1  at least one cell failed, or answers are not the same\n"
      "  2  the request or a file is wrong");
  command.job([options, check] {
    options->check = check.given();
    return tables(*options);
  });
}

}  // namespace touchstone::commands
