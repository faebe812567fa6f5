// touchstone soak: compares millions of verdicts with exact ones.
#include "harness/check/soak/soak.h"

#include <fmt/format.h>

#include <memory>

#include "harness/base/table.h"
#include "harness/campaign/selection.h"
#include "harness/check/regimes/select_regimes.h"
#include "harness/check/soak/soak_text.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"

namespace touchstone::commands {
namespace {

struct SoakOptions {
  std::string narrow = "certified", regimes, groups, out;
  check::SoakRequest request;
};

int soak(SoakOptions& options) {
  check::SoakRequest& request = options.request;
  request.narrow =
      campaign::select(narrow_phases(), campaign::split_names(options.narrow), "narrow phase");
  request.out = results_folder(options.out, "soak");
  request.regimes = check::select_regimes(options.regimes, options.groups);
  const check::SoakResult result = check::run_soak(request);
  fmt::print("{}", check::soak_text(request, result, base::page_width()));
  fmt::print("\nBy regime: {}\n", (request.out / "soak.csv").string());
  return result.ours_are_wrong(request) ? exit_measured_wrong : exit_done;
}

}  // namespace

void add_soak(Arguments command) {
  const auto options = std::make_shared<SoakOptions>();
  check::SoakRequest& request = options->request;
  add_case_options(command, request, options->narrow, options->out, "soak", "soak");
  command.number("--pairs", request.pairs, "Pairs in all, spread over the regimes")
      .within(1, 1'000'000'000'000)
      .show_default();
  command.text("--regimes", options->regimes, "Regimes: names joined by commas");
  command.text("--group,--groups", options->groups, "Groups of regimes, joined by commas");
  command.job([options] { return soak(*options); });
}

}  // namespace touchstone::commands
