// touchstone check: grades every algorithm against exact answers, on hard cases, along axes to its
// limits, or by the million.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/progress.h"
#include "harness/base/table.h"
#include "harness/check/certificate_files.h"
#include "harness/check/check_run.h"
#include "harness/check/graded_answers.h"
#include "harness/check/select_cases.h"
#include "harness/check/versions.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/pictures.h"
#include "harness/commands/shared_options.h"
#include "harness/files/text_file.h"
#include "harness/kinds/pair/pair_request.h"
#include "harness/kinds/selection.h"
#include "harness/modules/modules.h"
#include "harness/peer/peer.h"
#include "harness/record/row.h"

namespace touchstone::commands {
namespace {

constexpr int quick_cases = 4;

struct CheckOptions {
  check::CaseSelection selection;
  std::string file, axes, out, page, certificates, saved, written;
  std::vector<std::string> peers, answers;
  check::CheckRequest common;  // what is the same with and without --axes and --count
  std::optional<int> cases;
  std::optional<double> time_limit;
  bool quick = false;
};

// What a mode calls its folder, and its file of rows.
struct ModeNames {
  std::string_view folder, rows;
};

ModeNames names_of(check::CheckMode mode) {
  switch (mode) {
    case check::CheckMode::cases: break;
    case check::CheckMode::axes: return {"stress", "stress.csv"};
    case check::CheckMode::count: return {"soak", "soak.csv"};
  }
  return {"check", "grades.csv"};
}

// `peers` are graded too, or alone if no algorithm is named.
check::CheckRequest request_of(const CheckOptions& options, check::CheckMode mode,
                               const std::string& peers) {
  check::CheckRequest request(mode);
  request.scalars = options.common.scalars;
  request.seed = options.common.seed;
  request.seconds = options.common.seconds;
  request.count = options.common.count;
  request.workers = options.common.workers;
  request.resume = options.common.resume;
  if (options.cases) request.cases = *options.cases;
  if (options.quick) request.cases = quick_cases;
  if (options.time_limit) request.time_limit = *options.time_limit;
  if (mode == check::CheckMode::axes && request.cases > kinds::most_cases_of_axes) {
    throw base::InputError(fmt::format("--cases: found {}; expected at most {} with --axes",
                                       request.cases, kinds::most_cases_of_axes));
  }
  check::CaseSelection selection = options.selection;
  selection.with = joined_names(selection.with, peers);
  check::select_cases(selection, options.axes, request);
  if (!options.file.empty()) kinds::take_case_file(options.file, request);
  request.out = results_folder(options.out, std::string(names_of(mode).folder));
  return request;
}

int verify(const std::string& file) {
  kinds::Verdicts verdicts(file);
  const bool good = verdicts.of([&] { check::verify_certificates(file, verdicts); });
  return good ? exit_done : exit_measured_wrong;
}

// Throws InputError for a kind of the list about which a peer is not asked by lines of text.
void expect_lines(const std::string& kinds_asked, const std::string& writer) {
  if (kinds_asked.empty()) return;
  std::vector<std::string_view> written;
  for (const kinds::Kind* kind : kinds::checked_kinds()) {
    const auto algorithms = kind->algorithms();
    if (std::ranges::find(algorithms, writer, &AlgorithmInfo::name) != algorithms.end()) {
      written.push_back(kind->name());
    }
  }
  for (const std::string& name : kinds::split_names(kinds_asked)) {
    const auto words = registry::kind_named(name);
    if (std::ranges::find(written, words ? words->word : name) == written.end()) {
      throw base::InputError(
          fmt::format("--export: no file of questions is about the kind '{}'; expected some of {}",
                      name, fmt::join(written, ", ")));
    }
  }
}

// Draws the cases, and writes the questions that a peer would be asked.
int write_questions(const CheckOptions& options, check::CheckMode mode) {
  files::check_output(options.written);
  const peer::QuestionWriter writer;
  expect_lines(options.selection.kinds, writer.name());
  const check::CheckRequest request = request_of(options, mode, writer.name());
  const check::CheckReport report(request);
  base::Progress progress(static_cast<std::size_t>(request.job_count()));
  for (std::int64_t job = 0; job < request.job_count(); ++job) {
    progress.start(fmt::format("questions of job {}", job));
    report.do_job(static_cast<std::size_t>(job));
  }
  fmt::print("{} lines of questions and meshes in {}\n", writer.save(options.written),
             options.written);
  return exit_done;
}

// Draws the maps of axes. Returns their path from the page's folder; empty if they are not drawn.
std::string draw_maps(const std::filesystem::path& out, const std::string& page) {
  const std::filesystem::path log = out / "figures.txt";
  const Drawing maps = draw_figures("stress.py", {out.string()}, log);
  if (maps == Drawing::no_matplotlib) {
    fmt::print(
        "The maps are not drawn: that takes Python 3 with matplotlib "
        "(Debian: python3-matplotlib)\n");
  } else if (maps == Drawing::failed) {
    fmt::print("The maps could not be drawn; {} says why\n", log.string());
  }
  if (maps != Drawing::drawn || page.empty()) return "";
  const std::filesystem::path folder = std::filesystem::absolute(page).parent_path();
  return std::filesystem::absolute(out / "figures").lexically_relative(folder).string();
}

// The versions of libraries of which several were asked.
std::string text_of(const check::VersionReport& versions) {
  if (versions.is_empty()) return "";
  return fmt::format(
      "\nVersions over the same cases. Wrong: on the other side of contact, or a number off, by "
      "more "
      "than {:g} of the size.\n{}{}\nRows in versions.csv and version_changes.csv, pairs in "
      "wrong_pairs.jsonl\n",
      check::wrong_share, versions.table().text(base::page_width()),
      fmt::join(versions.since(), "\n"));
}

// `command` is said to have made the page.
int run(const CheckOptions& options, check::CheckMode mode, const std::string& command) {
  if (!options.certificates.empty()) return verify(options.certificates);
  if (!options.written.empty()) return write_questions(options, mode);
  modules::load_named(options.selection.with);
  std::string peers = start_peers(options.peers);
  for (const std::string& file : options.answers) {
    peers = joined_names(peers, peer::add_answers(file));
  }
  const check::CheckRequest request = request_of(options, mode, peers);
  const bool has_axes = mode == check::CheckMode::axes;
  if (!options.page.empty()) {
    // The page may be in the folder that is about to be made, as that of axes is.
    std::error_code ignored;
    if (has_axes) std::filesystem::create_directories(request.out, ignored);
    files::check_output(options.page);
  }
  if (!options.saved.empty()) {
    files::check_output(options.saved);
    fmt::print("{} certificates in {}\n", check::save_certificates(request, options.saved),
               options.saved);
    return exit_done;
  }
  const check::CheckReport report = check::run_check(request);
  const std::vector<peer::PeerRow> peer_rows = peer::peer_rows();
  if (!peer_rows.empty()) record::write_rows(request.out / "peers.csv", peer_rows);
  if (report.interrupted) return end_interrupted();
  check::VersionReport versions;
  if (mode == check::CheckMode::cases) versions = check::compare_versions(request);
  print_summary(
      request.out,
      fmt::format("{}{}\nRows in {} and families.csv of {}; case files of what is wrong in {}\n",
                  check::summary_text(report, base::page_width()), text_of(versions),
                  names_of(mode).rows, request.out.string(), (request.out / "failures").string()));
  const std::string maps = has_axes ? draw_maps(request.out, options.page) : "";
  if (!options.page.empty()) {
    files::write_text(options.page, check::page_text(report, command, maps));
  }
  return report.ours_wrong().empty() ? exit_done : exit_measured_wrong;
}

std::string names_of_kinds() {
  std::vector<std::string> names;
  for (const kinds::Kind* kind : kinds::checked_kinds()) names.emplace_back(kind->name());
  return fmt::format("{}", fmt::join(names, ", "));
}

// Adds an option for each kind by its old name.
void add_older_spellings(Arguments& command, check::CaseSelection& selection) {
  for (const kinds::Kind* kind : kinds::checked_kinds()) {
    command
        .text("--" + std::string(kind->old_name()), selection.of_one[kind],
              fmt::format("The same as --with for the kind {} alone", kind->name()))
        .group("Older spellings");
  }
}

}  // namespace

void add_check(Arguments command) {
  const auto options = std::make_shared<CheckOptions>();
  check::CheckRequest& common = options->common;
  const Option file = command
                          .text("FILE", options->file,
                                "Pairs to grade in place of the regimes, one JSON object a line")
                          .is_read();
  Option axes = command
                    .text("--axes", options->axes,
                          "Drive one property of a case at a time to its extreme, and find where "
                          "each algorithm breaks. Axes: all, or names joined by commas")
                    .value_optional();
  Option count =
      command
          .number("--count", common.count,
                  "Count the verdicts of so many cases, spread over the regimes and families, a "
                  "thousand of one at a time; of `certified` if no algorithm is named")
          .within(1, 1'000'000'000'000)
          .show_default()
          .value_optional();
  command.text(
      "--with", options->selection.with,
      "Algorithms of all kinds: names, all, ours, libraries, oracle, none, or the file of a "
      "module, such as ./libmine.so");
  add_peer(command, options->peers);
  command
      .texts(
          "--answers", options->answers,
          "Also grade what a peer answered to the questions of --export: its file, with the same "
          "options")
      .is_read()
      .once_each();
  command.text("--kind", options->selection.kinds, "Only these kinds: " + names_of_kinds());
  command.text("--regimes", options->selection.regimes,
               "Regimes and families of cases: names joined by commas (default: all)");
  command.text("--group,--groups", options->selection.groups, "Groups of these, joined by commas");
  command.some_of("--scalar", common.scalars, scalar_choices(),
                  "What is calculated in (default: both)");
  command.number("--seed", common.seed, "The seed of the cases").show_default();
  const Option cases =
      command
          .number("--cases", options->cases,
                  "Cases of each regime or family in a round (default: 200); with --axes of each "
                  "value (default: 48; of large hulls at most 12)")
          .within(1, 1'000'000);
  command
      .flag("--quick", options->quick,
            fmt::format("With --axes the same as --cases {}, for a first look", quick_cases))
      .needs(axes)
      .excludes(cases);
  command
      .number("--seconds,--long", common.seconds,
              "Go on for this long, round after round (default: one round)")
      .positive();
  command.number("--threads", common.workers, "Processes that share the work")
      .within(1, 256)
      .show_default();
  command
      .number("--time-limit", options->time_limit,
              "Seconds that a query may take (default: 10; with --axes 0.5)")
      .positive();
  command.text("--out", options->out,
               "Folder for the results (default: results/local/check; with --axes "
               "stress, with --count soak)");
  command.flag("--resume", common.resume, "Go on with the work in this folder");
  const Option page =
      command.text("--page", options->page, "Also write the tables as a Markdown page");
  command
      .text("--save-certificates", options->saved,
            "Only prove the exact answers of the cases, and write the proofs to this file")
      .excludes(page)
      .excludes(command.option("--resume"));
  Option written =
      command.text("--export", options->written,
                   "Only write the questions for a peer that runs elsewhere to this file (default: "
                   "in double alone)");
  for (const char* name : {"--with", "--peer", "--answers", "--seconds", "--page", "--resume",
                           "--save-certificates", "--out"}) {
    written.excludes(command.option(name));
  }
  command.text("--certificates", options->certificates, "Only verify the proofs in this file")
      .is_read();
  add_older_spellings(command, options->selection);
  for (const kinds::Kind* kind : kinds::checked_kinds()) {
    written.excludes(command.option("--" + std::string(kind->old_name())));
  }
  command.exclude_others("--certificates");
  axes.excludes(count);
  for (Option option : {axes, count, cases, command.option("--regimes"), command.option("--groups"),
                        command.option("--seed"), command.option("--seconds")}) {
    option.excludes(file);
  }
  for (const char* name : {"--regimes", "--groups", "--seconds", "--broad"}) {
    axes.excludes(command.option(name));
  }
  for (const char* name : {"--cases", "--seconds", "--page", "--save-certificates", "--broad"}) {
    count.excludes(command.option(name));
  }
  command.job([options, command, axes, count, written] {
    if (written.given() && !command.option("--scalar").given()) {
      options->common.scalars = {Precision::float64};
    }
    if (axes.given()) return run(*options, check::CheckMode::axes, command.shell_line("--resume"));
    const auto mode = count.given() ? check::CheckMode::count : check::CheckMode::cases;
    return run(*options, mode, command.shell_line("--out"));
  });
}

}  // namespace touchstone::commands
