// touchstone check: grades every algorithm against exact answers.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/check/certificate_files.h"
#include "harness/check/check_run.h"
#include "harness/check/requests/select_cases.h"
#include "harness/commands/arguments.h"
#include "harness/commands/case_selection.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/text_file.h"

namespace touchstone::commands {
namespace {

struct CheckOptions {
  check::CaseSelection selection;
  std::string out, page, certificates, saved;
  check::CheckRequest request;
};

int verify(const std::string& file) {
  check::CertificateVerdicts verdicts;
  const auto print = [&](const char* until) {
    for (const std::string& line : verdicts.refused) fmt::print("{}\n", line);
    fmt::print("{} certificates verified, {} refused{}\n", verdicts.verified,
               verdicts.refused_count, until);
  };
  try {
    check::verify_certificates(file, verdicts);
  } catch (const base::InputError&) {
    print(", before what cannot be read");
    throw;
  }
  print("");
  return verdicts.refused_count == 0 ? exit_done : exit_measured_wrong;
}

int check(CheckOptions& options, const std::string& command) {
  if (!options.certificates.empty()) return verify(options.certificates);
  check::CheckRequest& request = options.request;
  check::select_cases(options.selection, "all", request);
  request.out = results_folder(options.out, "check");
  if (!options.page.empty()) files::check_output(options.page);
  if (!options.saved.empty()) {
    files::check_output(options.saved);
    fmt::print("{} certificates in {}\n", check::save_certificates(request, options.saved),
               options.saved);
    return exit_done;
  }
  const std::unique_ptr<check::CheckResult> result = check::run_check(request);
  if (result->interrupted) return end_interrupted();
  fmt::print("{}", check::summary_text(result->report, base::page_width()));
  fmt::print("\nRows in grades.csv and families.csv of {}; case files of what is wrong in {}\n",
             request.out.string(), (request.out / "failures").string());
  if (!options.page.empty())
    files::write_text(options.page, check::page_text(result->report, command));
  return result->report.ours_wrong().empty() ? exit_done : exit_measured_wrong;
}

}  // namespace

void add_check(Arguments command) {
  const auto options = std::make_shared<CheckOptions>();
  check::CheckRequest& request = options->request;
  add_case_options(command, request, options->selection.pair, options->out, "check", "check");
  command.text("--broad", options->selection.box, "Broad phases: names, all, ours, peers, none");
  add_selection(command, options->selection);
  command.number("--cases", request.cases, "Cases of each regime or family in a round")
      .within(1, 1'000'000)
      .show_default();
  command
      .number("--seconds,--long", request.seconds,
              "Go on for this long, round after round (default: one round)")
      .positive();
  const Option page =
      command.text("--page", options->page, "Also write the table as a Markdown page");
  command
      .text("--save-certificates", options->saved,
            "Only prove the exact answers of the cases, and write the proofs to this file")
      .excludes(page)
      .excludes(command.option("--resume"));
  command.text("--certificates", options->certificates, "Only verify the proofs in this file");
  command.exclude_others("--certificates");
  command.job([options, command] { return check(*options, command.shell_line("--out")); });
}

}  // namespace touchstone::commands
