// touchstone check: every algorithm graded against exact answers.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "harness/base/error.h"
#include "harness/base/text_table.h"
#include "harness/campaign/selection.h"
#include "harness/check/certificate_files.h"
#include "harness/check/check_run.h"
#include "harness/commands/checks.h"
#include "harness/commands/commands.h"
#include "harness/record/build_info.h"

namespace touchstone {
namespace {

struct Options {
  std::string narrow = "all", broad = "all", regimes, groups, out, page, certificates, saved;
  CheckRequest request;
};

// The oracle does not grade itself, unless it is asked to.
std::vector<const NarrowPhaseEntry*> chosen_narrow(const std::string& names) {
  const std::vector<std::string> list = split_names(names);
  auto chosen = select(narrow_phases(), list, "narrow phase");
  std::erase_if(chosen, [&](const NarrowPhaseEntry* entry) {
    return entry->info.origin == Origin::oracle &&
           std::ranges::find(list, entry->info.name) == list.end();
  });
  return chosen;
}

// The regimes of these names and of these groups; all where neither is asked for.
std::vector<const Regime*> chosen_regimes(const std::string& names, const std::string& groups) {
  std::vector<std::string> wanted, wanted_groups;
  if (!names.empty()) wanted = split_names(names);
  if (!groups.empty()) wanted_groups = split_names(groups);
  const auto expect = [](std::string_view what, const std::vector<std::string>& asked,
                         std::string Regime::*field) {
    for (const std::string& name : asked) {
      std::string known;
      bool found = false;
      for (const Regime& regime : regimes()) {
        const std::string& own = regime.*field;
        found = found || own == name;
        if (known.find(own + ",") == std::string::npos) known += own + ", ";
      }
      if (found) continue;
      throw InputError(fmt::format("no {} is called '{}'; expected some of {}", what, name,
                                   known.substr(0, known.size() - 2)));
    }
  };
  expect("regime", wanted, &Regime::name);
  expect("group of regimes", wanted_groups, &Regime::group);
  std::vector<const Regime*> chosen;
  const bool all = wanted.empty() && wanted_groups.empty();
  for (const Regime& regime : regimes()) {
    if (all || std::ranges::find(wanted, regime.name) != wanted.end() ||
        std::ranges::find(wanted_groups, regime.group) != wanted_groups.end()) {
      chosen.push_back(&regime);
    }
  }
  return chosen;
}

void write_page(const CheckReport& report, const std::string& command, const std::string& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << page_text(report, command);
  stream.close();
  if (!stream) throw InputError(file, 0, "cannot be written");
}

int verify(const std::string& file) {
  const CertificateVerdicts verdicts = verify_certificates(file);
  for (const std::string& line : verdicts.refused) fmt::print("{}\n", line);
  fmt::print("{} certificates verified, {} refused\n", verdicts.verified, verdicts.refused_count);
  return verdicts.refused_count == 0 ? exit_done : exit_measured_wrong;
}

int check(Options& options, const std::string& command) {
  if (!options.certificates.empty()) return verify(options.certificates);
  CheckRequest& request = options.request;
  request.narrow = chosen_narrow(options.narrow);
  // With all of them, those without the scalar are left out; one that was named is not.
  for (const NarrowPhaseEntry* entry : request.narrow) {
    const bool named = std::ranges::count(split_names(options.narrow), entry->info.name) > 0;
    const bool offered = std::ranges::any_of(
        request.scalars, [&](Precision scalar) { return offers(*entry, scalar); });
    if (!named || offered) continue;
    throw InputError(fmt::format("'{}' does not compute in {}; expected another --scalar",
                                 entry->info.name, to_string(request.scalars.front())));
  }
  request.broad = select(broad_phases(), split_names(options.broad), "broad phase");
  request.regimes = chosen_regimes(options.regimes, options.groups);
  request.out = options.out.empty() ? std::filesystem::path(source_folder) / "results/local/check"
                                    : std::filesystem::path(options.out);
  if (!options.page.empty()) check_output(options.page);
  if (!options.saved.empty()) {
    check_output(options.saved);
    fmt::print("{} certificates in {}\n", save_certificates(request, options.saved), options.saved);
    return exit_done;
  }
  const std::unique_ptr<CheckResult> result = run_check(request);
  fmt::print("{}", summary_text(result->report, page_width()));
  fmt::print("\nRows in {}; case files of what is wrong in {}\n",
             (request.out / "grades.csv").string(), (request.out / "failures").string());
  if (!options.page.empty()) write_page(result->report, command, options.page);
  return result->report.ours_wrong().empty() ? exit_done : exit_measured_wrong;
}

}  // namespace

void add_check(CLI::App& app, int& status) {
  const auto options = std::make_shared<Options>();
  CheckRequest& request = options->request;
  CLI::App& command = *app.add_subcommand(
      "check", "Grade every algorithm against exact answers, in regimes that are hard");
  command.add_option("--narrow", options->narrow, "Narrow phases: names, all, ours, peers, none")
      ->capture_default_str();
  command.add_option("--broad", options->broad, "Broad phases: names, all, ours, peers, none")
      ->capture_default_str();
  const std::map<std::string, Precision> scalars = {{"float", Precision::float32},
                                                    {"double", Precision::float64}};
  command.add_option("--scalar", request.scalars, "float, double (default: both)")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(scalars).description(""));
  command.add_option("--regimes", options->regimes, "Regimes: names joined by commas");
  command.add_option("--group,--groups", options->groups, "Groups of regimes, joined by commas");
  command.add_option("--seed", request.seed, "Of the cases")->capture_default_str();
  command.add_option("--cases", request.cases, "Cases of each regime in a round")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command
      .add_option("--seconds,--long", request.seconds,
                  "Go on for this long, round after round (default: one round)")
      ->check(positive_number);
  command.add_option("--threads", request.workers, "Processes that share the work")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_option("--time-limit", request.time_limit, "Seconds that a query may take")
      ->check(positive_number)
      ->capture_default_str();
  command.add_option("--out", options->out,
                     "Folder for what is found (default: results/local/check in the project)");
  command.add_flag("--resume", request.resume, "Go on with the check that this folder is of");
  command.add_option("--page", options->page, "Also write the table as a Markdown page");
  command
      .add_option("--save-certificates", options->saved,
                  "Only prove the exact answers of the cases, and write the proofs to this file")
      ->excludes("--page")
      ->excludes("--resume");
  // It is about what a file says, and nothing else.
  CLI::Option* const certificates = command.add_option("--certificates", options->certificates,
                                                       "Only verify the proofs in this file");
  for (CLI::Option* option : command.get_options()) {
    if (option != certificates && option->get_name() != "--help") certificates->excludes(option);
  }
  command.callback([options, &app, &status] {
    std::string line = "touchstone check";
    for (const CLI::Option* option : app.get_subcommand("check")->get_options()) {
      if (option->count() == 0 || option->get_name() == "--out") continue;
      line += " " + option->get_name();
      if (option->get_expected_max() > 0)
        line += " " + fmt::format("{}", fmt::join(option->results(), ","));
    }
    status = check(*options, line);
  });
}

}  // namespace touchstone
