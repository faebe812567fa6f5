// touchstone reproduce: measures a reference again, and checks whether its tables hold here.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/packed_files.h"
#include "harness/process/subprocess.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/table_check.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::commands {
namespace {

struct ReproduceOptions {
  std::string reference, results, out, campaign;
  bool noisy = false;
};

std::string number_text(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.3f}", value);
}

// Runs the reference's campaign with this program in a process of its own. Returns the folder.
std::filesystem::path run_again(const std::filesystem::path& reference,
                                const ReproduceOptions& options) {
  std::filesystem::path campaign = options.campaign;
  if (campaign.empty()) {
    campaign = base::data_folder().path / "datasets/campaigns" /
               (stats::read_results(reference).campaign + ".toml");
  }
  if (!std::ifstream(campaign)) {
    throw base::InputError(
        campaign.string(), 0,
        "cannot be read; expected the reference's campaign (--campaign names another)");
  }
  const std::filesystem::path out = results_folder(options.out, "reproduce");
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
          const ReproduceOptions& options) {
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
      "{} cells: {} pass, {} fail, {} differ on this machine, {} undecided; {} answers changed, {} "
      "not looked at, {} faster than stated\n",
      found.cells.size(), count(stats::Holds::pass), count(stats::Holds::fail),
      count(stats::Holds::differs), count(stats::Holds::undecided), found.changed.size(),
      found.left_out.size(), count(stats::Holds::faster));
  return count(stats::Holds::fail) > 0 || !found.changed.empty() ? exit_measured_wrong : exit_done;
}

int reproduce(const ReproduceOptions& options) {
  const std::filesystem::path reference = options.reference.empty()
                                              ? base::data_folder().path / "results/reference"
                                              : std::filesystem::path(options.reference);
  if (!std::filesystem::exists(files::row_file(reference / "ratios.csv"))) {
    throw base::InputError((reference / "ratios.csv").string(), 0,
                           "cannot be read; expected a reference with tables (`touchstone show "
                           "REFERENCE --tables` writes them)");
  }
  if (!options.results.empty() && stats::is_of_cells(options.results)) {
    throw base::InputError(options.results, 0,
                           "is of a campaign with kinds, whose tables state no band; expected "
                           "results of a campaign of scenes (`touchstone compare` takes cells)");
  }
  const std::filesystem::path results = options.results.empty()
                                            ? run_again(reference, options)
                                            : std::filesystem::path(options.results);
  return check(reference, results, options);
}

}  // namespace

void add_reproduce(Arguments command) {
  auto options = std::make_shared<ReproduceOptions>();
  command
      .text("reference", options->reference,
            "A results folder with tables (default: results/reference)")
      .is_read();
  const Option results =
      command.text("--results", options->results, "Check these results, instead of measuring again")
          .is_read();
  command
      .text("--campaign", options->campaign,
            "The campaign to run again (default: the one in datasets/campaigns that has "
            "the name in the reference's raw.csv)")
      .is_read()
      .excludes(results);
  command
      .text("--out", options->out,
            "Folder for the campaign run again (default: results/local/reproduce)")
      .excludes(results);
  command.flag("--noisy", options->noisy,
               "Keep the rounds that were measured under noise; they are left out otherwise");
  command.footer(
      "The reference of the project takes about four minutes on two cores.\n\n"
      "Hashes, pair counts, contact counts and work counters are looked at first: they must be\n"
      "the same to the digit. Then a cell passes where the interval of its ratio lies within the\n"
      "stated band; absolute times count for nothing. Where it lies wholly outside, by less than "
      "a\n"
      "factor of two, the cell differs on this machine; beyond that it fails. Ratios are to a\n"
      "library where there is one; an algorithm of ours that is faster against it than stated "
      "does\n"
      "not fail.\n\n"
      "Exit status:\n"
      "  0  nothing failed\n"
      "  1  at least one cell failed, or answers are not the same\n"
      "  2  the request or a file is wrong");
  command.job([options] { return reproduce(*options); });
}

}  // namespace touchstone::commands
