// touchstone run: measures a campaign.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <tuple>

#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/base/group_words.h"
#include "harness/base/names.h"
#include "harness/campaign/plan.h"
#include "harness/campaign/runner.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/pictures.h"
#include "harness/commands/program.h"
#include "harness/commands/run_file.h"
#include "harness/commands/run_modules.h"
#include "harness/commands/shared_options.h"
#include "harness/grade/margins.h"
#include "harness/kinds/selection.h"
#include "harness/measure/noise.h"
#include "harness/modules/modules.h"
#include "harness/record/machine.h"
#include "harness/scene/generators/generators.h"
#include "harness/stats/summary.h"

namespace touchstone::commands {
namespace {

struct RunOptions {
  std::string campaign, out;
  // These options describe a campaign of one group on the command line.
  std::vector<std::string> scenes;
  std::string broad = "ours,peers", narrow = "ours,peers", concave = "ours,peers";
  std::string mids{measure::usual_mid_phase};
  std::vector<record::QueryTask> tasks = {record::QueryTask::intersect};
  std::vector<Precision> scalars = {Precision::float32, Precision::float64};
  std::vector<scene::BoxKind> boxes = {scene::BoxKind::tight};
  std::vector<int> threads = {2};
  std::vector<ExecutorKind> executors = {usual_executor};
  std::vector<std::int64_t> counts = {-1};
  std::vector<std::int64_t> seeds = {-1};
  int frames = -1;
  double tolerance = 0, time_limit = 10, seconds = campaign::CampaignGroup{}.seconds;
  bool product = false, rebuild = false, warm = false;
  int batch = measure::usual_batch;
  // These options decide how the campaign is measured.
  bool resume = false, overwrite = false, strict = false, noisy = false, dry_run = false;
  bool quick = false;
  bool tables = false, with_page = false;
  bool threads_given = false;
  // These options do a shard of a plan instead.
  std::string plan;
  std::int64_t shard = -1;
  double depth_error = grade::usual_depth_error;
  std::vector<std::string> peers;
  std::string with;  // files of modules, joined by commas
};

// Adds the peers to every group that asks narrow phases, in each of their scalars. They are graded, and not timed.
void add_peers(const std::string& names, campaign::Campaign& campaign) {
  if (names.empty()) return;
  for (const NarrowPhaseEntry* entry : kinds::select(registry::entries<NarrowPhaseEntry>(),
                                                     kinds::split_names(names), "narrow phase")) {
    for (campaign::CampaignGroup& group : campaign.groups) {
      const bool has_it = std::ranges::find(group.narrow, entry, &measure::NarrowChoice::entry) !=
                          group.narrow.end();
      if (group.narrow.empty() || has_it) continue;
      for (const Precision scalar : entry->scalars) {
        group.narrow.push_back({entry, {.scalar = scalar}, false, measure::usual_batch});
      }
    }
  }
}

campaign::Campaign campaign_of(const RunOptions& options) {
  if (options.scenes.empty()) {
    return campaign::read_campaign(
        options.campaign.empty() ? base::data_folder().path / "datasets/campaigns/standard.toml"
                                 : std::filesystem::path(options.campaign));
  }
  for (const std::string& file : options.scenes) {
    if (!scene::is_scene_of_motion(file)) continue;
    throw base::InputError(fmt::format(
        "--scene {0}: its bodies move far within a frame, and this command asks what they do at "
        "the "
        "frames alone; expected touchstone advise {0} --front --motion, or touchstone run with a "
        "file whose "
        "[[group]] is of the kind motion, as datasets/campaigns/motion.toml",
        file));
  }
  campaign::Campaign campaign;
  campaign.name = "command-line";
  campaign::CampaignGroup group;
  group.scenes.assign(options.scenes.begin(), options.scenes.end());
  group.counts = options.counts;
  group.seeds = options.seeds;
  group.frames = options.frames;
  group.seconds = options.seconds;
  group.boxes = options.boxes;
  group.threads = options.threads;
  group.executors = options.executors;
  group.rebuild = options.rebuild;
  group.broad = kinds::select(registry::entries<BroadPhaseEntry>(),
                              kinds::split_names(options.broad), "broad phase");
  for (const NarrowPhaseEntry* entry :
       kinds::select(registry::entries<NarrowPhaseEntry>(), kinds::split_names(options.narrow),
                     "narrow phase")) {
    for (const Precision scalar : options.scalars) {
      if (!offers(*entry, scalar)) continue;
      NarrowPhaseSettings settings{.scalar = scalar};
      if (options.tolerance > 0) settings.tolerance = options.tolerance;
      group.narrow.push_back({entry, settings, false, options.batch});
      if (options.warm && entry->traits.starts_warm)
        group.narrow.push_back({entry, settings, true, options.batch});
    }
  }
  group.concave =
      measure::concave_choices(kinds::select(registry::entries<ConcaveEntry>(),
                                             kinds::split_names(options.concave), "concave phase"),
                               kinds::select(registry::entries<MidPhaseEntry>(),
                                             kinds::split_names(options.mids), "mid-phase"),
                               options.scalars);
  group.tasks = options.tasks;
  group.pairing = options.product ? campaign::Pairing::product : campaign::Pairing::separate;
  group.time_limit = options.time_limit;
  campaign.groups.push_back(std::move(group));
  return campaign;
}

constexpr int quick_frames = 2;
constexpr std::int64_t quick_bodies = 1000;  // of a generator

// True if all that a group without narrow phases measures of a scene is measured by an earlier group too.
bool is_measured_by(const campaign::CampaignGroup& earlier, const campaign::CampaignGroup& group) {
  const auto grid = [](const campaign::CampaignGroup& of) {
    return std::tie(of.counts, of.seeds, of.gaps, of.frames, of.boxes, of.threads, of.executors,
                    of.isa, of.rebuild, of.broad, of.limit, of.tasks, of.pairing, of.include,
                    of.time_limit, of.memory_limit);
  };
  return group.narrow.empty() && grid(earlier) == grid(group) &&
         std::ranges::equal(earlier.concave, group.concave, {}, &measure::NarrowChoice::label,
                            &measure::NarrowChoice::label) &&
         std::ranges::all_of(earlier.exclude, [&](const campaign::CampaignRule& rule) {
           return std::ranges::find(group.exclude, rule) != group.exclude.end();
         });
}

// Leaves each group a small part of its time, for a first look. It has a folder of its own. Scenes
// of boxes that an earlier group then has with as many boxes are left out.
void make_quick(campaign::Campaign& campaign) {
  constexpr double quick_seconds = 0.45;  // for the samples of a block
  constexpr int quick_squares = 8;        // an interval needs six, and some are disturbed
  campaign.name += "-quick";
  for (campaign::CampaignGroup& group : campaign.groups) {
    group.seconds = std::min(group.seconds, quick_seconds);
    group.frames = std::min(group.frames, quick_frames);
    for (std::int64_t& count : group.counts) count = std::min(count, quick_bodies);
    const auto repeated = std::ranges::unique(group.counts);
    group.counts.erase(repeated.begin(), repeated.end());
    group.rounds = 1;
    group.processes = 1;
    // The share of one of many sets would end before it has an interval.
    if (!group.choices().empty()) group.squares = quick_squares;
  }
  for (auto group = campaign.groups.begin(); group != campaign.groups.end(); ++group) {
    for (auto earlier = campaign.groups.begin(); earlier != group; ++earlier) {
      if (!is_measured_by(*earlier, *group)) continue;
      std::erase_if(group->scenes, [&](const std::filesystem::path& scene) {
        return std::ranges::find(earlier->scenes, scene) != earlier->scenes.end();
      });
    }
  }
  std::erase_if(campaign.groups,
                [](const campaign::CampaignGroup& group) { return group.scenes.empty(); });
}

// Prints what a run would measure, without measuring it.
void print_plan(const campaign::Campaign& campaign) {
  double seconds = 0;
  double check_seconds = 0;
  std::size_t cells = 0;
  const std::vector<campaign::PlannedBlock> blocks = campaign::plan_campaign(campaign);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    fmt::print("block {}: {}\n", i, blocks[i].label);
    for (const campaign::PlannedBlock::Set& set : blocks[i].sets) {
      fmt::print("  {}: {}\n", set.name, fmt::join(set.contestants, ", "));
      cells += set.contestants.size();
    }
    fmt::print("  check: about {:.1f} s\n", blocks[i].check_seconds);
    check_seconds += blocks[i].check_seconds;
    if (!blocks[i].sets.empty()) seconds += blocks[i].seconds;
  }
  fmt::print(
      "{} blocks, {} cells; about {:.1f} s for the check of every frame, by a trial of some, and "
      "at "
      "most\nabout {:.0f} s for the samples\n",
      blocks.size(), cells, check_seconds, seconds);
}

record::FolderStart start_of(const RunOptions& options) {
  if (options.resume) return record::FolderStart::resume;
  return options.overwrite ? record::FolderStart::overwrite : record::FolderStart::fresh;
}

// Returns the names that the user wrote out in a list of algorithms, without words such as `ours`.
void add_named(const std::string& list, std::vector<std::string>& names) {
  for (std::string& name : kinds::split_names(list)) {
    if (!base::is_group_word(name)) names.push_back(std::move(name));
  }
}

// The command that goes on with this run.
std::string command_to_go_on() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  std::string word, text = "touchstone";
  std::getline(stream, word, '\0');  // the program
  while (std::getline(stream, word, '\0')) {
    if (word.starts_with(record::of_build_option)) continue;
    if (word != "--overwrite" && word != "--resume") text += " " + base::shell_word(word);
  }
  return text + " --resume";
}

// Writes tables.md and prints the summary, or all tables on request.
void report(const campaign::Campaign& campaign, const campaign::RunResult& result,
            const std::filesystem::path& folder, const RunOptions& options) {
  stats::ReportSetting setting = {
      .noise = options.noisy ? stats::Noise::kept : stats::Noise::left_out,
      .depth_error = options.depth_error};
  add_measured_modules(campaign, setting.own);
  if (setting.own.empty()) {
    for (const std::string* list : {&options.broad, &options.narrow, &options.concave})
      add_named(*list, setting.own);
  }
  if (result.interrupted) setting.stopped = stats::Stop{result.stopped_at, command_to_go_on()};
  const stats::RunReport report =
      stats::write_report(stats::read_results(folder), result.findings.departures(),
                          result.interrupted ? nullptr : &campaign.published, setting, folder);
  if (options.tables) {
    fmt::print("{}\n{}\n", report.tables, record::departures_text(result.findings));
    if (!report.published.empty()) fmt::print("{}\n", report.published);
  }
  print_summary(folder, report.summary);
}

// Measures a small part of the campaign and prints its summary. Returns false if it was interrupted.
bool run_first_look(campaign::Campaign campaign, const std::filesystem::path& folder,
                    RunOptions options) {
  make_quick(campaign);
  options.tables = false;
  fmt::print(stderr, "a first look, then the whole comparison\n");
  const campaign::RunResult result =
      campaign::run_campaign(campaign, folder, record::FolderStart::overwrite);
  if (result.interrupted) return false;
  report(campaign, result, folder, options);
  fmt::print("\nThat was a first look; the whole comparison follows.\n\n");
  std::fflush(stdout);
  return true;
}

// Does what is asked of another file than a campaign of scenes, or of a shard; returns nothing for such a campaign.
std::optional<int> run_other_file(const RunOptions& options, const WholeRun& whole) {
  RunFileOptions of_file = {.file = options.campaign,
                            .out = options.out,
                            .plan = options.plan,
                            .shard = options.shard,
                            .with_page = options.with_page,
                            .resume = options.resume};
  if (options.threads_given) of_file.threads = options.threads;
  if (options.overwrite) of_file.others.emplace_back("--overwrite");
  if (options.strict) of_file.others.emplace_back("--strict");
  if (options.noisy) of_file.others.emplace_back("--noisy");
  if (options.dry_run) of_file.others.emplace_back("--dry-run");
  if (options.tables) of_file.others.emplace_back("--tables");
  if (options.quick) of_file.others.emplace_back("--quick");
  if (!options.peers.empty()) of_file.others.emplace_back("--peer");
  if (!options.with.empty()) of_file.others.emplace_back("--with");
  if (options.depth_error != grade::usual_depth_error) of_file.others.emplace_back("--depth-error");
  return whole.run_file(of_file);
}

int run(const RunOptions& options, const WholeRun* whole) {
  const bool is_standard = options.campaign.empty() && options.scenes.empty() &&
                           options.peers.empty() && options.with.empty();
  const bool is_shard = !options.plan.empty();
  if (whole == nullptr && (!is_standard || is_shard || options.with_page)) hand_over();
  if (!options.campaign.empty() || is_shard) {
    if (const auto status = run_other_file(options, *whole)) return *status;
  }
  if (options.threads_given && options.scenes.empty()) {
    throw base::InputError(
        "--threads belongs to --scene or --plan; expected it in the campaign's file");
  }
  expect_module_files(options.with);
  modules::load_named(options.with);
  const std::string peers = whole == nullptr ? "" : whole->start_peers(options.peers);
  campaign::Campaign campaign = campaign_of(options);
  add_modules(options.with, campaign);
  add_peers(peers, campaign);
  if (options.quick) make_quick(campaign);
  const std::filesystem::path folder = results_folder(options.out, campaign.name);
  if (options.dry_run) {
    print_plan(campaign);
    return exit_done;
  }
  if (options.strict) {
    const std::string objection = measure::MachineLoad::now().objection();
    if (!objection.empty()) {
      throw base::InputError("the machine is not quiet, and --strict was given: " + objection);
    }
  }
  const auto look_first = [&] { return run_first_look(campaign, folder / "first-look", options); };
  const bool has_first_look = is_standard && !options.quick;
  const campaign::RunResult result =
      campaign::run_campaign(campaign, folder, start_of(options), {},
                             has_first_look ? std::function<bool()>(look_first) : nullptr);
  report(campaign, result, folder, options);
  if (options.with_page) make_page(folder);
  if (result.interrupted) return end_interrupted();
  return result.findings.ours_are_wrong() ? exit_measured_wrong : exit_done;
}

void add_run_options(Arguments command, const WholeRun* whole) {
  auto options = std::make_shared<RunOptions>();
  const Option campaign = command
                              .text("campaign", options->campaign,
                                    "Campaign file (.toml); without one, the standard comparison")
                              .is_read();
  command.text("--out", options->out,
               "Folder for raw.csv and machine.csv (default: results/local/NAME)");
  const Option resume = command.flag("--resume", options->resume,
                                     "Go on with the run that was stopped in the folder of --out");
  command
      .flag("--overwrite", options->overwrite,
            "Begin anew even where the folder holds a run that was not finished")
      .excludes(resume);
  command.flag("--strict", options->strict, "Refuse to measure on a machine that is busy");
  command.flag("--noisy", options->noisy, "Let the tables count rounds that the machine disturbed");
  command.flag("--tables", options->tables,
               "Print all tables, which are in tables.md, before the summary");
  command.flag("--report", options->with_page,
               "Make a page of the results, report.html in the folder");
  add_depth_error(command, options->depth_error);
  add_shard(command, options->plan, options->shard).excludes(campaign);
  command.flag("--quick", options->quick,
               fmt::format("Take few samples, of at most {} frames and {} generated bodies where "
                           "the campaign names more, for a first look",
                           quick_frames, quick_bodies));
  command.flag("--dry-run", options->dry_run, "Print what would be measured, and for how long");
  add_peer(command, options->peers).excludes(command.option("--plan"));
  command
      .text("--with", options->with,
            "Also measure the algorithms of these modules, joined by commas: ./libmine.so")
      .excludes(command.option("--plan"));

  const std::string one = "Instead of a campaign file";
  const Option scene = command
                           .texts("--scene", options->scenes,
                                  "Scene files: .toml, rigid-ipc's .json, .aabbs, models")
                           .is_read()
                           .excludes(campaign)
                           .group(one);
  const auto add = [&](Option option) { option.needs(scene).group(one); };
  add(command.text("--broad", options->broad, "Broad phases: names, all, ours, peers, oracle, none")
          .show_default());
  add(command
          .text("--narrow", options->narrow, "Narrow phases: names, all, ours, peers, oracle, none")
          .show_default());
  add(command
          .text("--concave", options->concave,
                "Concave phases, for pairs with a body that is not convex: as --narrow")
          .show_default());
  add(command.text("--mid", options->mids, "Mid-phases of concave phases that take any: names, all")
          .show_default());
  add(command.some_of("--task", options->tasks, run_task_choices(), "What is asked"));
  add(command.some_of("--scalar", options->scalars, scalar_choices(),
                      "What is calculated in (default: both)"));
  add(command.some_of("--boxes", options->boxes, box_choices(),
                      "Tight boxes, or loose ones that hold any attitude"));
  // A shard of a plan has this option too.
  const Option threads = command.numbers("--threads", options->threads, "Numbers of threads")
                             .within(1, 1024)
                             .show_default()
                             .group(one);
  add(command.some_of("--executor", options->executors, executor_choices(),
                      "Whose threads: ours (crew, the default), oneTBB's, or both"));
  add(command.numbers("--count", options->counts, "Bodies of a generated scene").positive());
  add(command.numbers("--seed", options->seeds, "Seeds of a generated scene").not_negative());
  add(command.number("--frames", options->frames, "Frames").positive());
  add(command.number("--seconds", options->seconds, "Seconds for the samples of a block of cells")
          .positive()
          .show_default());
  add(command
          .number("--tolerance", options->tolerance,
                  "Of the narrow phases, as a part of the pair's size")
          .positive());
  add(add_time_limit(command, options->time_limit, "Seconds for a frame of an algorithm")
          .show_default());
  add(command.flag("--product", options->product,
                   "Every narrow phase on the pairs of every broad phase"));
  add(command.flag("--rebuild", options->rebuild, "Build every frame anew instead of updating"));
  add(command.flag("--warm", options->warm,
                   "Narrow phases that know it once more, starting from the frame before"));
  add(command
          .number("--batch", options->batch,
                  "Pairs of a narrow phase's call; 1: one pair at a time")
          .within(1, measure::usual_batch)
          .show_default());
  Option plan = command.option("--plan");
  for (const char* name : {"--out", "--resume", "--overwrite", "--strict", "--noisy", "--tables",
                           "--report", "--depth-error", "--quick", "--dry-run", "--scene"}) {
    plan.excludes(command.option(name));
  }
  command.job([options, threads, whole] {
    options->threads_given = threads.given();
    return run(*options, whole);
  });
}

}  // namespace

void add_run(Arguments command) { add_run_options(command, nullptr); }
void add_run(Arguments command, const WholeRun& whole) { add_run_options(command, &whole); }

}  // namespace touchstone::commands
