// touchstone compare: says whether B is slower than A, or wrong where A is not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/check/changed_answers.h"
#include "harness/check/graded_answers.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/compare.h"
#include "harness/commands/shared_options.h"
#include "harness/files/output_file.h"
#include "harness/files/text_file.h"
#include "harness/process/subprocess.h"
#include "harness/record/machine.h"
#include "harness/record/result_folder.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/comparison.h"
#include "harness/stats/instruction_counts.h"

namespace touchstone::commands {
namespace {

using namespace stats;

struct CompareOptions {
  std::vector<std::string> files, programs;
  std::string out, csv, markdown;
  double threshold = 0.03, max_error = check::wrong_share;
  int runs = 8;
  bool any_machine = false, noisy = false, all = false;
  std::function<bool(const std::string&)> is_given;  // whether the command line has this option

  stats::Noise noise() const { return noisy ? stats::Noise::kept : stats::Noise::left_out; }
};

void add_lines(std::string& text, std::string_view title, const std::vector<std::string>& lines) {
  constexpr std::size_t most = 20;
  if (lines.empty()) return;
  text += fmt::format("{}\n", title);
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) {
    text += fmt::format("  {}\n", lines[i]);
  }
  if (lines.size() > most) text += fmt::format("  and {} more\n", lines.size() - most);
  text += "\n";
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4f}", value); }

// Adds every cell.
void add_all(std::string& text, const std::vector<stats::ComparedCell>& cells, double threshold) {
  for (std::size_t i = 0; i < cells.size();) {
    const stats::SetKey& key = cells[i].key;
    base::Table table({"", "B / A", "from", "to", "p (Holm)", "n", "verdict"});
    for (; i < cells.size() && cells[i].key == key; ++i) {
      const stats::ComparedCell& cell = cells[i];
      table.add({cell.label, number(cell.ratio.median), number(cell.ratio.low),
                 number(cell.ratio.high), fmt::format("{:.2g}", cell.p_corrected),
                 fmt::format("{} + {}", cell.squares_a, cell.squares_b),
                 std::string(to_string(stats::verdict(cell, threshold)))});
    }
    text += fmt::format("{}\n\n{}\n", key.words(), table.text(base::page_width()));
  }
}

// Adds the cells with a verdict: those that are the slowest for sure come first.
void add_cells(Judgement& judged, std::string_view title, stats::Verdict wanted,
               const CompareOptions& options, const std::vector<stats::ComparedCell>& cells) {
  std::vector<const stats::ComparedCell*> found;
  for (const stats::ComparedCell& cell : cells) {
    if (stats::verdict(cell, options.threshold) == wanted) found.push_back(&cell);
  }
  std::ranges::stable_sort(found, std::greater<>(), [](const stats::ComparedCell* cell) {
    return std::isnan(cell->ratio.low) ? 0 : cell->ratio.low;
  });
  constexpr std::size_t most = 5;
  if (found.empty()) return;
  judged.text += fmt::format("{}\n", title);
  base::Table table({"B / A", "algorithm", "input"}, 3);
  for (const stats::ComparedCell* cell : std::span(found).first(std::min(most, found.size()))) {
    const std::string ratio =
        std::isnan(cell->ratio.low)
            ? fmt::format("too few squares ({} + {})", cell->squares_a, cell->squares_b)
            : fmt::format("{:.3f} ({:.3f} to {:.3f})", cell->ratio.median, cell->ratio.low,
                          cell->ratio.high);
    judged.text += fmt::format("  {:<24}  {}, {}\n", ratio, cell->label, cell->key.words());
    table.add({ratio, cell->label, cell->key.words()});
  }
  judged.markdown += fmt::format("\n**{}**\n\n{}", title, table.markdown());
  if (found.size() > most) {
    const std::string more = fmt::format(
        "and {} more (--all prints every cell, --csv writes them)\n", found.size() - most);
    judged.text += "  " + more;
    judged.markdown += "\n" + more;
  }
  judged.text += "\n";
}

// Returns the judgement of A and B.
Judgement judge(const CompareOptions& options, const stats::Results& a, const stats::Results& b,
                const std::vector<stats::ComparedCell>& cells) {
  Judgement judged;
  add_lines(judged.text, "A and B differ in", stats::remarks(a, b));
  if (options.all) add_all(judged.text, cells, options.threshold);
  add_cells(judged, "SLOWER in B: time in B over time in A", stats::Verdict::slower, options,
            cells);
  add_cells(judged, "Undecided", stats::Verdict::undecided, options, cells);
  if (!options.csv.empty()) record::write_rows(options.csv, cells, options.threshold);
  const std::vector<std::string> changed = stats::changed_answers(a, b, stats::Compared::answers);
  add_lines(judged.text, "The answers changed", changed);
  const auto count = [&](stats::Verdict wanted) {
    return std::ranges::count_if(cells, [&](const stats::ComparedCell& c) {
      return stats::verdict(c, options.threshold) == wanted;
    });
  };
  const auto slower = count(stats::Verdict::slower);
  const auto undecided = count(stats::Verdict::undecided);
  const std::string sum =
      fmt::format("{} cells: {} slower, {} undecided, {} same, {} faster, {} not slower\n",
                  cells.size(), slower, undecided, count(stats::Verdict::same),
                  count(stats::Verdict::faster), count(stats::Verdict::not_slower));
  judged.text += sum;
  if (undecided > 0 && options.programs.empty()) {
    judged.text += fmt::format(
        "Two runs decide little: machines drift between them. What decides runs both programs in "
        "turns, {} times:\n  touchstone compare --exe OLD --exe NEW "
        "datasets/campaigns/compare.toml\n",
        CompareOptions().runs);
  } else if (undecided > 0) {
    judged.text += fmt::format("More runs decide more: --runs {}\n", 2 * options.runs);
  }
  const bool is_wrong = slower > 0 || !changed.empty();
  judged.status = is_wrong                         ? exit_measured_wrong
                  : undecided > 0 || cells.empty() ? exit_undecided
                                                   : exit_done;
  std::string answers;
  for (const std::string& line : changed)
    answers += fmt::format("\nThe answers changed: {}\n", line);
  judged.markdown = fmt::format("### Times: {}\n\n{}{}{}",
                                is_wrong                          ? "FAILED"
                                : judged.status == exit_undecided ? "undecided"
                                                                  : "passed",
                                sum, answers, judged.markdown);
  return judged;
}

stats::Results read(const std::filesystem::path& results) {
  return stats::is_of_cells(results) ? stats::read_cell_results(results)
                                     : stats::read_results(results);
}

Judgement not_comparable(const std::vector<std::string>& reasons) {
  Judgement judged;
  add_lines(judged.text, "A and B may not be compared", reasons);
  judged.markdown = "### Times: not comparable\n\n" + judged.text;
  judged.status = exit_bad_request;
  return judged;
}

// Throws InputError for an option that the command line has and that means nothing for what is compared.
void expect_none(const CompareOptions& options, const std::vector<std::string>& meaningless,
                 std::string_view what) {
  for (const std::string& name : meaningless) {
    if (!options.is_given(name)) continue;
    throw base::InputError(
        fmt::format("{} was given with {}; expected it with results that it is for", name, what));
  }
}

Judgement compare_files(const CompareOptions& options) {
  if (options.files.size() != 2) {
    throw base::InputError(
        fmt::format("found {} results; expected two, A and B", options.files.size()));
  }
  const CompareRequest request = {options.files[0], options.files[1], options.csv, options.all};
  const auto is_either = [&](const auto& is) { return is(request.a) || is(request.b); };
  if (is_either(check::is_of_check)) {
    expect_none(options, {"--threshold", "--any-machine", "--noisy"},
                "checks, which have no times");
    return compare_answers(request, options.max_error);
  }
  expect_none(options, {"--max-error"}, "what is no check");
  if (is_either(stats::has_instructions)) {
    expect_none(options, {"--any-machine", "--noisy"}, "counts of instructions");
    return compare_instructions(request, options.threshold);
  }
  const stats::Results a = read(request.a);
  const stats::Results b = read(request.b);
  const std::vector<std::string> reasons = stats::obstacles(a, b, !options.any_machine);
  if (!reasons.empty()) return not_comparable(reasons);
  return judge(options, a, b, stats::compare(a, b, options.noise()));
}

stats::Results run(const std::string& program, const std::string& campaign,
                   const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path log = folder / "output.txt";
  const int status = process::run_and_wait(
      program, {"run", campaign, "--out", folder.string(), "--overwrite"}, log);
  if (status != exit_done && status != exit_measured_wrong) {
    throw base::InputError(fmt::format("'{} run {}' ended with status {}; its output is in {}",
                                       program, campaign, status, log.string()));
  }
  return read(folder);
}

Judgement compare_programs(const CompareOptions& options) {
  expect_none(options, {"--max-error"}, "--exe");
  if (options.programs.size() != 2) {
    throw base::InputError(
        fmt::format("found {} times --exe; expected it twice, A and B", options.programs.size()));
  }
  if (options.files.size() > 1) {
    throw base::InputError("with --exe, found more than one campaign; expected one or none");
  }
  const std::string campaign =
      options.files.empty()
          ? (base::data_folder().path / "datasets/campaigns/compare.toml").string()
          : options.files[0];
  const std::filesystem::path out = results_folder(options.out, "compare");
  if (!std::ifstream(campaign)) throw base::InputError(campaign, 0, "cannot be read");
  record::ResultFolder folder({.folder = out,
                               .files = {},
                               .identity = record::machine_facts(),
                               .start = record::FolderStart::overwrite,
                               .work = "comparison"});
  std::vector<stats::Results> a, b;
  for (int i = 0; i < options.runs; ++i) {
    // A B, B A, A B, ... is fair to both on a machine whose speed drifts.
    for (const bool is_a : {i % 2 == 0, i % 2 != 0}) {
      fmt::print(stderr, "run {} of {}, {}\n", i + 1, options.runs, is_a ? 'A' : 'B');
      (is_a ? a : b)
          .push_back(run(options.programs[is_a ? 0 : 1], campaign,
                         out / (is_a ? "a" : "b") / std::to_string(i + 1)));
      folder.commit();
    }
  }
  folder.finish();
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Both ran on this machine, but their files must agree on it too.
    const std::vector<std::string> reasons = stats::obstacles(a[i], b[i], !options.any_machine);
    if (!reasons.empty()) return not_comparable(reasons);
  }
  return judge(options, a[0], b[0], stats::compare_runs(a, b, options.noise()));
}

// Prints and writes what was found. With `--markdown -` the text makes way for the Markdown.
int finish(const CompareOptions& options, const Judgement& judged) {
  const bool is_piped = options.markdown == "-";
  fmt::print(is_piped ? stderr : stdout, "{}", judged.text);
  if (is_piped) {
    fmt::print("{}", judged.markdown);
  } else if (!options.markdown.empty()) {
    files::write_text(options.markdown, judged.markdown);
  }
  return judged.status;
}

}  // namespace

void add_compare(Arguments command) {
  auto options = std::make_shared<CompareOptions>();
  command
      .texts("results", options->files,
             "A and B: results folders or raw.csv files of `run`, folders of `check`, or counts of "
             "instructions. With --exe: a campaign file (default: "
             "datasets/campaigns/compare.toml)")
      .is_read();
  const Option exe =
      command
          .texts("--exe", options->programs,
                 "A program to run; given twice, A and B, whose runs of the campaign are "
                 "interleaved")
          .once_each();  // the word behind the second program is the campaign
  command.number("--threshold", options->threshold, "A slower B is a regression beyond this part")
      .positive()
      .show_default();
  command.number("--runs", options->runs, "With --exe: runs of each program")
      .within(1, 1000)
      .needs(exe)
      .show_default();
  command
      .text("--out", options->out,
            "With --exe: folder for the runs (default: results/local/compare)")
      .needs(exe);
  command
      .number("--max-error", options->max_error,
              "With checks: an answer is wrong that is on the other side of contact, or a number "
              "off, by more than this part of the pair's size")
      .positive()
      .show_default();
  command.text("--csv", options->csv,
               "Write the cells, changed answers or counts to this file, too");
  command.text("--markdown", options->markdown,
               "Write the findings as Markdown to this file, too; with - to standard output, and "
               "the text to standard error");
  command.flag("--all", options->all,
               "Print every cell, changed answer or count, not only the first that matter");
  command.flag("--any-machine", options->any_machine,
               "Compare although the machines differ or are not known");
  command.flag("--noisy", options->noisy,
               "Keep the rounds that were measured under noise; they are left out otherwise");
  command.footer(
      "A cell is one algorithm on one input. Its ratio B / A comes with an interval of 95 %: a "
      "cell\n"
      "is slower where all of it is above 1 + threshold and Mann-Whitney's p, corrected by Holm "
      "over\n"
      "all cells, is below 0.05.\n\n"
      "Folders of `check` are compared answer by answer; they must have the same cases. Counts of\n"
      "instructions are files of `bench --instructions`, or of valgrind --tool=callgrind.\n\n"
      "Exit status:\n"
      "  0  the same: no cell is slower, none is undecided; no answer became wrong; no count grew\n"
      "  1  a regression: at least one cell is slower, or answers otherwise, or fails in B alone; "
      "an\n"
      "     answer of a check became wrong or was lost; a count is beyond the threshold\n"
      "  2  not comparable: machine, scene hash, settings, vector instructions or cases differ "
      "(it\n"
      "     says which); or the request or a file is wrong\n"
      "  3  undecided: no regression is shown, and in at least one cell none is ruled out");
  options->is_given = [command](const std::string& name) { return command.option(name).given(); };
  command.job([options] {
    if (!options->csv.empty()) files::check_output(options->csv);
    if (!options->markdown.empty() && options->markdown != "-") {
      files::check_output(options->markdown);
    }
    return finish(*options,
                  options->programs.empty() ? compare_files(*options) : compare_programs(*options));
  });
}

}  // namespace touchstone::commands
