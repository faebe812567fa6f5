// touchstone show: prints the summary of a results folder, writes its tables and draws its figures.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/program.h"
#include "harness/commands/shared_options.h"
#include "harness/commands/show_rows.h"
#include "harness/files/packed_files.h"
#include "harness/files/text_file.h"
#include "harness/process/subprocess.h"

namespace touchstone::commands {
namespace {

// Prints what the work ended with. Folders without that text have its numbers in rows or a page.
int print_kept(const ShowOptions& options, ShowRows show_rows) {
  const std::filesystem::path of(options.results);
  constexpr auto names = std::to_array<std::string_view>(
      {summary_file, "advice.txt", "", "tables.md", "front.md", "envelope.md"});
  const bool is_folder = std::filesystem::is_directory(of);
  const std::filesystem::path folder = is_folder ? of : of.parent_path();
  for (const std::string_view name : names) {
    if (name.empty()) {
      if (!std::filesystem::is_regular_file(files::row_file(folder / "raw.csv"))) continue;
      if (show_rows == nullptr) hand_over();
      if (show_rows(options)) return exit_done;
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
  const std::filesystem::path plots = base::data_folder().path / "plots";
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

int show(const ShowOptions& options, ShowRows show_rows) {
  if (!options.tables && !options.figures) return print_kept(options, show_rows);
  if (show_rows == nullptr) hand_over();
  if (options.tables) show_rows(options);
  if (options.figures) draw_figures(options);
  return exit_done;
}

void add_show_options(Arguments command, ShowRows show_rows) {
  auto options = std::make_shared<ShowOptions>();
  command.text("results", options->results, "Results folder, or its raw.csv").is_read().required();
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
  command.job([options, out, noisy, show_rows] {
    if (!options->tables && !options->figures) {
      expect_not_given({out, noisy}, "with --tables or --figures alone");
    }
    return show(*options, show_rows);
  });
}

}  // namespace

void add_show(Arguments command) { add_show_options(command, nullptr); }
void add_show(Arguments command, ShowRows show_rows) { add_show_options(command, show_rows); }

}  // namespace touchstone::commands
