// touchstone run: the main job.
#include <fmt/core.h>

#include <memory>

#include "harness/commands/commands.h"
#include "harness/error.h"
#include "harness/run/build_info.h"
#include "harness/run/report.h"
#include "harness/run/runner.h"
#include "harness/run/selection.h"
#include "harness/run/text_table.h"

namespace touchstone {
namespace {

struct Options {
  std::string campaign, out;
  // A campaign of one group, from the command line.
  std::vector<std::string> scenes;
  std::string broad = "ours,peers", narrow = "ours,peers";
  std::vector<Task> tasks = {Task::intersect};
  std::vector<Precision> scalars = {Precision::float32, Precision::float64};
  std::vector<BoxKind> boxes = {BoxKind::tight};
  std::vector<int> threads = {2};
  std::vector<std::int64_t> counts = {-1};
  std::vector<std::int64_t> seeds = {-1};
  int frames = -1;
  double tolerance = 0, time_limit = 10;
  bool product = false, rebuild = false;
};

Campaign campaign_of(const Options& options) {
  if (options.scenes.empty()) {
    return read_campaign(options.campaign.empty() ? std::filesystem::path(source_folder) /
                                                        "datasets/campaigns/standard.toml"
                                                  : std::filesystem::path(options.campaign));
  }
  Campaign campaign;
  campaign.name = "command-line";
  CampaignGroup group;
  group.scenes.assign(options.scenes.begin(), options.scenes.end());
  group.counts = options.counts;
  group.seeds = options.seeds;
  group.frames = options.frames;
  group.boxes = options.boxes;
  group.threads = options.threads;
  group.rebuild = options.rebuild;
  group.broad = select(broad_phases(), split_names(options.broad), "broad phase");
  for (const NarrowPhaseEntry* entry :
       select(narrow_phases(), split_names(options.narrow), "narrow phase")) {
    for (const Precision scalar : options.scalars) {
      if (!offers(*entry, scalar)) continue;
      NarrowPhaseSettings settings{.scalar = scalar};
      if (options.tolerance > 0) settings.tolerance = options.tolerance;
      group.narrow.push_back({entry, settings});
    }
  }
  group.tasks = options.tasks;
  group.pairing = options.product ? Pairing::product : Pairing::separate;
  group.time_limit = options.time_limit;
  campaign.groups.push_back(std::move(group));
  return campaign;
}

int run(const Options& options) {
  const Campaign campaign = campaign_of(options);
  const std::filesystem::path folder = options.out.empty() ? std::filesystem::path(source_folder) /
                                                                 "results" / "local" / campaign.name
                                                           : std::filesystem::path(options.out);
  const RunResult result = run_campaign(campaign, folder);
  const std::size_t width = page_width();
  for (const std::string& text :
       {broad_table(result.findings, width), narrow_tables(result.findings, width),
        departures(result.findings)}) {
    if (!text.empty()) fmt::print("{}\n", text);
  }
  fmt::print("{} rows in {}\n", result.findings.rows().size(), (folder / "raw.csv").string());
  if (result.interrupted) {
    fmt::print(stderr, "touchstone: interrupted; what was measured until then is kept\n");
    return exit_bad_request;
  }
  return result.findings.ours_are_wrong() ? exit_measured_wrong : exit_done;
}

}  // namespace

void add_run(CLI::App& app, int& status) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "run", "Run a campaign: every scene through every algorithm, compared and timed");
  CLI::Option* campaign = command->add_option(
      "campaign", options->campaign, "Campaign file (.toml); without one, the standard comparison");
  command->add_option(
      "--out", options->out,
      "Folder for raw.csv and machine.csv (default: results/local/NAME in the project)");

  const std::string one = "Instead of a campaign file";
  CLI::Option* scene =
      command
          ->add_option("--scene", options->scenes, "Scene files: .toml, rigid-ipc's .json, .aabbs")
          ->excludes(campaign)
          ->group(one);
  const auto add = [&](CLI::Option* option) { option->needs(scene)->group(one); };
  add(command
          ->add_option("--broad", options->broad,
                       "Broad phases: names, all, ours, peers, oracle, none")
          ->capture_default_str());
  add(command
          ->add_option("--narrow", options->narrow,
                       "Narrow phases: names, all, ours, peers, oracle, none")
          ->capture_default_str());
  const std::map<std::string, Task> tasks = {{"intersect", Task::intersect},
                                             {"distance", Task::distance},
                                             {"penetration", Task::penetration}};
  add(command->add_option("--task", options->tasks, "intersect, distance, penetration")
          ->delimiter(',')
          ->transform(CLI::CheckedTransformer(tasks).description("")));
  const std::map<std::string, Precision> scalars = {{"float", Precision::float32},
                                                    {"double", Precision::float64}};
  add(command->add_option("--scalar", options->scalars, "float, double (default: both)")
          ->delimiter(',')
          ->transform(CLI::CheckedTransformer(scalars).description("")));
  const std::map<std::string, BoxKind> boxes = {{"tight", BoxKind::tight},
                                                {"loose", BoxKind::loose}};
  add(command->add_option("--boxes", options->boxes, "tight, loose")
          ->delimiter(',')
          ->transform(CLI::CheckedTransformer(boxes).description("")));
  add(command->add_option("--threads", options->threads, "Numbers of threads")
          ->delimiter(',')
          ->check(CLI::Range(1, 1024))
          ->capture_default_str());
  add(command->add_option("--count", options->counts, "Bodies of a generated scene")
          ->delimiter(',')
          ->check(CLI::PositiveNumber));
  add(command->add_option("--seed", options->seeds, "Seeds of a generated scene")
          ->delimiter(',')
          ->check(CLI::NonNegativeNumber));
  add(command->add_option("--frames", options->frames, "Frames")->check(CLI::PositiveNumber));
  add(command
          ->add_option("--tolerance", options->tolerance, "Of the narrow phases, part of the size")
          ->check(CLI::PositiveNumber));
  add(command
          ->add_option("--time-limit", options->time_limit, "Seconds for a frame of an algorithm")
          ->check(CLI::PositiveNumber)
          ->capture_default_str());
  add(command->add_flag("--product", options->product,
                        "Every narrow phase on the pairs of every broad phase"));
  add(command->add_flag("--rebuild", options->rebuild,
                        "Build every frame anew instead of updating"));
  command->callback([options, &status] { status = run(*options); });
}

}  // namespace touchstone
