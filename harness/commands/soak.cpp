// touchstone soak: compares millions of verdicts with exact ones.
#include "harness/check/soak/soak.h"

#include <fmt/format.h>

#include <memory>

#include "harness/base/table.h"
#include "harness/check/requests/select_cases.h"
#include "harness/check/soak/soak_text.h"
#include "harness/commands/arguments.h"
#include "harness/commands/case_selection.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"

namespace touchstone::commands {
namespace {

struct SoakOptions {
  check::CaseSelection selection;
  std::string out;
  check::SoakRequest request;
};

int soak(SoakOptions& options) {
  check::SoakRequest& request = options.request;
  if (options.selection.is_unsaid()) options.selection.pair = "certified";
  check::select_cases(options.selection, "none", request);
  request.out = results_folder(options.out, "soak");
  const check::SoakResult result = check::run_soak(request);
  if (result.interrupted) return end_interrupted();
  fmt::print("{}", check::soak_text(request, result, base::page_width()));
  fmt::print("\nBy regime: {}\n", (request.out / "soak.csv").string());
  return result.ours_are_wrong(request) ? exit_measured_wrong : exit_done;
}

}  // namespace

void add_soak(Arguments command) {
  const auto options = std::make_shared<SoakOptions>();
  check::SoakRequest& request = options->request;
  add_case_options(command, request, options->selection.pair, options->out, "soak", "soak");
  add_selection(command, options->selection);
  command
      .number("--pairs", request.pairs,
              "Cases in all, spread over the regimes and families, a thousand of one at a time")
      .within(1, 1'000'000'000'000)
      .show_default();
  command.job([options] { return soak(*options); });
}

}  // namespace touchstone::commands
