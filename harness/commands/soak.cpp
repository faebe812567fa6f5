// touchstone soak: verdicts by the million against exact ones.
#include "harness/check/soak.h"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "harness/base/text_table.h"
#include "harness/campaign/selection.h"
#include "harness/commands/checks.h"
#include "harness/commands/commands.h"
#include "harness/record/build_info.h"

namespace touchstone {
namespace {

struct Options {
  std::string narrow = "certified", out;
  SoakRequest request;
};

void print(const SoakRequest& request, const SoakResult& result) {
  std::map<std::pair<std::size_t, Precision>, SoakCount> totals;
  for (const auto& [key, count] : result.counts) {
    totals[{std::get<0>(key), std::get<1>(key)}].add(count);
  }
  TextTable table({"algorithm", "pairs", "separated", "touching", "overlapping", "unresolved",
                   "silent errors", "honest failures", "lost"});
  for (const auto& [key, count] : totals) {
    std::vector<std::string> row = {
        fmt::format("{} {}", request.narrow[key.first]->info.name, to_string(key.second))};
    for (const std::int64_t value :
         {count.pairs, count.separated, count.touching, count.overlapping, count.unresolved,
          count.silent, count.honest, count.lost}) {
      row.push_back(std::to_string(value));
    }
    table.add(row);
  }
  fmt::print("{}", table.text(page_width()));
}

int soak(Options& options) {
  SoakRequest& request = options.request;
  request.narrow = select(narrow_phases(), split_names(options.narrow), "narrow phase");
  request.out = options.out.empty() ? std::filesystem::path(source_folder) / "results/local/soak"
                                    : std::filesystem::path(options.out);
  for (const Regime& regime : regimes()) request.regimes.push_back(&regime);
  const SoakResult result = run_soak(request);
  print(request, result);
  fmt::print("\nBy regime: {}\n", (request.out / "soak.csv").string());
  return result.ours_are_wrong(request) ? exit_measured_wrong : exit_done;
}

}  // namespace

void add_soak(CLI::App& app, int& status) {
  const auto options = std::make_shared<Options>();
  SoakRequest& request = options->request;
  CLI::App& command = *app.add_subcommand(
      "soak", "Count verdicts by the million against exact ones, in regimes that are hard");
  command.add_option("--narrow", options->narrow, "Narrow phases: names, all, ours, peers")
      ->capture_default_str();
  const std::map<std::string, Precision> scalars = {{"float", Precision::float32},
                                                    {"double", Precision::float64}};
  command.add_option("--scalar", request.scalars, "float, double (default: both)")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(scalars).description(""));
  command.add_option("--pairs", request.pairs, "Pairs in all, spread over the regimes")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000'000}))
      ->capture_default_str();
  command.add_option("--seed", request.seed, "Of the cases")->capture_default_str();
  command.add_option("--threads", request.workers, "Processes that share the work")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command.add_option("--time-limit", request.time_limit, "Seconds that a query may take")
      ->check(positive_number)
      ->capture_default_str();
  command.add_option("--out", options->out,
                     "Folder for the counts (default: results/local/soak in the project)");
  command.add_flag("--resume", request.resume, "Go on with the soak that this folder is of");
  command.callback([options, &status] { status = soak(*options); });
}

}  // namespace touchstone
