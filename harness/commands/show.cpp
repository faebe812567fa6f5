// touchstone show: prints the summary of a results folder, writes its tables and draws its figures.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/packed_files.h"
#include "harness/files/text_file.h"
#include "harness/process/subprocess.h"
#include "harness/record/build_info.h"
#include "harness/record/findings.h"
#include "harness/record/machine.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/cell_tables.h"
#include "harness/stats/machines.h"
#include "harness/stats/summary.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::commands {
namespace {

using namespace stats;

struct ShowOptions {
  std::string results, out;
  double band = 1.5, depth_error = stats::usual_depth_error;
  bool tables = false, figures = false, noisy = false;
};

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

// Prints what the work ended with. Folders without that text have its numbers in rows or a page.
int print_kept(const std::filesystem::path& of) {
  constexpr auto names = std::to_array<std::string_view>(
      {summary_file, "advice.txt", "", "tables.md", "front.md", "envelope.md"});
  const bool is_folder = std::filesystem::is_directory(of);
  const std::filesystem::path folder = is_folder ? of : of.parent_path();
  for (const std::string_view name : names) {
    if (name.empty()) {
      if (print_summary_of_rows(folder)) return exit_done;
    } else if (std::filesystem::is_regular_file(folder / name)) {
      fmt::print("{}", files::read_text(folder / name));
      return exit_done;
    }
  }
  throw base::InputError(
      of.string(), 0,
      is_folder || std::filesystem::exists(of)
          ? "holds no summary.txt; expected a folder that run, check or advise wrote to its end"
          : "is not there; expected a folder of results");
}

// Becomes plots/plot.py, which draws all figures as files and names them on the screen.
[[noreturn]] void draw_figures(const ShowOptions& options) {
  const std::filesystem::path plots = std::filesystem::path(record::source_folder) / "plots";
  const std::string python = (plots / "python").string();
  if (process::run_and_wait(python, {"-c", ""}, "/dev/null") != 0) {
    throw base::InputError(
        "figures are drawn by matplotlib for Python 3, which is not here (Debian: "
        "python3-matplotlib); `touchstone show RESULTS --tables` gives the same numbers without "
        "it");
  }
  std::vector<std::string> words = {python,
                                    "-B",
                                    (plots / "plot.py").string(),
                                    "--program",
                                    std::filesystem::read_symlink("/proc/self/exe").string(),
                                    options.results};
  if (!options.out.empty()) words.insert(words.end(), {"--out", options.out});
  if (options.noisy) words.emplace_back("--noisy");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::fflush(stdout);
  execv(python.c_str(), pointers.data());
  throw base::InputError(python, 0, fmt::format("cannot be run: {}", std::strerror(errno)));
}

int show(const ShowOptions& options) {
  if (!options.tables && !options.figures) return print_kept(options.results);
  if (options.tables) write_tables(options);
  if (options.figures) draw_figures(options);
  return exit_done;
}

}  // namespace

void add_show(Arguments command) {
  auto options = std::make_shared<ShowOptions>();
  command.text("results", options->results, "Results folder, or its raw.csv").required();
  const Option tables =
      command.flag("--tables", options->tables, "Write its tables, beside the rows");
  command.flag("--figures", options->figures, "Draw its figures, as SVG, PDF and PNG");
  const Option out = command.text(
      "--out", options->out, "Folder for the tables, or the figures (default: RESULTS/figures)");
  command
      .number("--band", options->band,
              "Written tables state that a ratio holds within its interval, widened by this "
              "factor at both ends")
      .within_real(1, 1e6)
      .needs(tables)
      .show_default();
  add_depth_error(command, options->depth_error).needs(tables);
  const Option noisy =
      command.flag("--noisy", options->noisy,
                   "Keep the rounds that were measured under noise; they are left out otherwise");
  command.job([options, out, noisy] {
    if (!options->tables && !options->figures) {
      expect_not_given({out, noisy}, "with --tables or --figures alone");
    }
    return show(*options);
  });
}

}  // namespace touchstone::commands
