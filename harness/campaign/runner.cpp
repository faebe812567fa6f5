// Runs a campaign block by block: check pass, then samples.
#include "harness/campaign/runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <tuple>
#include <utility>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/progress.h"
#include "harness/campaign/block_run.h"
#include "harness/campaign/check_pass/check_broad.h"
#include "harness/campaign/check_pass/check_narrow.h"
#include "harness/campaign/check_pass/check_price.h"
#include "harness/campaign/lower_bound_entry.h"
#include "harness/campaign/run_folder.h"
#include "harness/process/child_process.h"
#include "harness/record/machine.h"

namespace touchstone::campaign {
namespace {

constexpr int tried_frames = 2;

volatile std::sig_atomic_t interrupt = 0;

// SIGINT ends the run after the current round; a second one ends the program as usual.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupt = 0;
    previous_ = std::signal(SIGINT, [](int) {
      interrupt = 1;
      std::signal(SIGINT, SIG_DFL);
    });
  }
  ~InterruptGuard() { std::signal(SIGINT, previous_); }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*previous_)(int);
};

std::vector<Block> blocks_of(const Campaign& campaign) {
  std::vector<Block> blocks;
  for (const CampaignGroup& group : campaign.groups) {
    for (const std::filesystem::path& scene : group.scenes) {
      for (const std::int64_t count : group.counts) {
        for (const std::int64_t seed : group.seeds) {
          for (const auto& gap : group.gaps) {
            const scene::SceneOverrides overrides{count, seed, group.frames, gap};
            for (const scene::BoxKind boxes : group.boxes) {
              for (const int threads : group.threads) {
                for (const auto& isa : group.isa) {
                  blocks.push_back({&group, scene, overrides, boxes, threads, isa});
                }
              }
            }
          }
        }
      }
    }
  }
  if (blocks.empty()) throw base::InputError("the campaign has no scene");
  return blocks;
}

std::string label(const Block& block, const scene::Scene& scene) {
  return fmt::format("{}, {} bodies, {} frames{}, {} boxes, {} thread{}{}", scene.name,
                     scene.size(), scene.frames, block.group->rebuild ? " rebuilt" : "",
                     to_string(block.boxes), block.threads, block.threads == 1 ? "" : "s",
                     block.isa ? fmt::format(", {} instructions", to_string(*block.isa)) : "");
}

// Limits the kernels to the block's instructions, in this process and those forked from it.
class IsaGuard {
 public:
  explicit IsaGuard(const Block& block) : before_(isa()) {
    if (block.isa) limit_isa(std::min(before_, *block.isa));
  }
  ~IsaGuard() { limit_isa(before_); }
  IsaGuard(const IsaGuard&) = delete;
  IsaGuard& operator=(const IsaGuard&) = delete;

 private:
  Isa before_;
};

// A warm start needs a frame before.
void expect_frames(const Block& block, const scene::Scene& scene) {
  const bool warm = std::ranges::any_of(block.group->narrow, &measure::NarrowChoice::warm);
  if (!warm || scene.frames > 1 || !scene.recording.empty()) return;
  throw base::InputError(
      block.scene_file.string(), 0,
      "has 1 frame, and the campaign wants warm starts; expected `frames` of 2 or "
      "more, in the scene or the campaign");
}

// The scenes of a campaign, each loaded once.
class Scenes {
 public:
  struct Loaded {
    scene::Scene scene;
    std::string hash;
  };
  explicit Scenes(const std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
      if (const auto at = loaded_.find(key(block)); at != loaded_.end()) {
        expect_frames(block, at->second.scene);
        continue;
      }
      scene::Scene scene = scene::load_scene(block.scene_file, block.overrides);
      expect_frames(block, scene);
      std::string hash = scene_hash(scene);
      loaded_.emplace(key(block), Loaded{std::move(scene), std::move(hash)});
    }
  }
  const Loaded& of(const Block& block) const { return loaded_.at(key(block)); }
  // Returns the hashes by name and count.
  std::map<std::string, std::string> hashes() const {
    std::map<std::string, std::string> hashes;
    for (const auto& [key, loaded] : loaded_) {
      std::string& hash =
          hashes[fmt::format("{}, {} bodies", loaded.scene.name, loaded.scene.size())];
      hash += (hash.empty() ? "" : " ") + loaded.hash;
    }
    return hashes;
  }

 private:
  using Key =
      std::tuple<std::filesystem::path, std::int64_t, std::int64_t, int, std::optional<double>>;
  static Key key(const Block& block) {
    const scene::SceneOverrides& overrides = block.overrides;
    return {block.scene_file, overrides.count, overrides.seed, overrides.frames, overrides.gap};
  }
  std::map<Key, Loaded> loaded_;
};

bool has_narrow(const RunContext& context) {
  return !context.block->group->narrow.empty() && context.scene->recording.empty();
}

// Returns true if narrow phases solve the pairs that each broad phase finds.
bool finds_pairs(const RunContext& context) {
  return context.block->group->pairing == Pairing::product && context.scene->pairs.empty();
}

// The sets of true pairs, and the sets of the broad phases' pairs.
struct NarrowInput {
  std::vector<measure::NarrowSet> checked, measured;
};

std::vector<std::vector<IndexPair>> true_pairs(const measure::BlockInput& input) {
  std::vector<std::vector<IndexPair>> pairs;
  for (const measure::BlockFrame& frame : input.frames) pairs.push_back(frame.truth);
  return pairs;
}

// Checks the broad phases and returns the pairs for the narrow phases. Rows go to
// `context.findings`. With `again` the rows are known, and only the pairs are needed.
NarrowInput check_broad_phases(const RunContext& context, const measure::BlockInput& input,
                               bool again) {
  const CampaignGroup& group = *context.block->group;
  const bool narrow = has_narrow(context);
  const bool product = narrow && finds_pairs(context);
  NarrowInput sets;
  if (narrow) sets.checked = measure::narrow_sets(input, "", true_pairs(input), group.tasks);
  if (!product) sets.measured = sets.checked;
  if (again && !product) return sets;
  for (const BroadPhaseEntry* entry : context.broad()) {
    const CheckedBroad check = check_broad(context, input, *entry, product);
    if (!product || !check.whole || entry == context.limit) continue;
    auto found = measure::narrow_sets(input, entry->info.name, check.pairs, group.tasks);
    // Pairs that differ from the true ones have answers of their own.
    if (!check.right) sets.checked.insert(sets.checked.end(), found.begin(), found.end());
    sets.measured.insert(sets.measured.end(), found.begin(), found.end());
  }
  return sets;
}

void run_block(RunContext context, bool checked, base::Progress& progress, RunFolder& files) {
  const IsaGuard guard(*context.block);
  const base::Stopwatch watch;
  const double budget = context.block->group->seconds;
  const measure::BlockInput input(*context.scene, context.block->boxes, has_narrow(context));
  const BroadPhaseEntry limit = lower_bound_entry(input);
  if (context.block->group->limit) context.limit = &limit;
  NarrowInput narrow;
  if (checked) {
    // The rows are there, but the broad phases' pairs have to be found again.
    record::Findings known;
    RunContext silent = context;
    silent.findings = &known;
    narrow = check_broad_phases(silent, input, true);
  } else {
    narrow = check_broad_phases(context, input, false);
    NarrowCheck(context, input, narrow.checked).run();
    files.commit(*context.findings);
  }
  const CheckTable table(context.findings->rows(), context.number, input.frames.size());
  BlockRun run(context, input, narrow.measured, table,
               make_schedule(context, input, narrow.measured, table));
  run.run([&] {
    files.commit(*context.findings);
    progress.part(std::min(watch.seconds() / budget, 1.0));
    return interrupt == 0;
  });
}

}  // namespace

RunResult run_campaign(const Campaign& campaign, const std::filesystem::path& folder,
                       record::FolderStart start) {
  process::expect_one_thread();
  const std::vector<Block> blocks = blocks_of(campaign);
  const Scenes scenes(blocks);
  RunResult result;
  RunFolder files(folder, campaign_facts(campaign, scenes.hashes()), start, result.findings);
  if (files.was_finished()) return result;
  const auto& rows = result.findings.rows();
  // The block at which the run stopped.
  const std::int64_t at = rows.empty() ? -1 : rows.back().block;
  {
    const InterruptGuard guard;
    base::Progress progress(blocks.size());
    for (std::size_t number = 0; number < blocks.size() && interrupt == 0; ++number) {
      const Block& block = blocks[number];
      const Scenes::Loaded& loaded = scenes.of(block);
      progress.start(label(block, loaded.scene));
      if (static_cast<std::int64_t>(number) < at) continue;
      run_block(
          {campaign.name, campaign.seed, static_cast<std::int64_t>(number), &block, &loaded.scene,
           loaded.hash, folder / "reproductions" / fmt::format("block-{}", number),
           &result.findings, blocks},
          static_cast<std::int64_t>(number) == at, progress, files);
    }
    result.interrupted = interrupt != 0;
  }
  if (!result.interrupted) files.finish();
  return result;
}

record::Findings check_campaign(const Campaign& campaign) {
  process::expect_one_thread();
  const std::vector<Block> blocks = blocks_of(campaign);
  const Scenes scenes(blocks);
  record::Findings findings;
  for (std::size_t number = 0; number < blocks.size(); ++number) {
    const Block& block = blocks[number];
    const Scenes::Loaded& loaded = scenes.of(block);
    RunContext context{campaign.name,
                       campaign.seed,
                       static_cast<std::int64_t>(number),
                       &block,
                       &loaded.scene,
                       loaded.hash,
                       {},
                       &findings,
                       blocks};
    const IsaGuard guard(block);
    const measure::BlockInput input(loaded.scene, block.boxes, has_narrow(context));
    const BroadPhaseEntry limit = lower_bound_entry(input);
    if (block.group->limit) context.limit = &limit;
    const NarrowInput narrow = check_broad_phases(context, input, false);
    NarrowCheck(context, input, narrow.checked).run();
  }
  return findings;
}

std::vector<PlannedBlock> plan_campaign(const Campaign& campaign) {
  const std::vector<Block> blocks = blocks_of(campaign);
  const Scenes scenes(blocks);
  std::vector<PlannedBlock> plan;
  for (std::size_t number = 0; number < blocks.size(); ++number) {
    const Block& block = blocks[number];
    const CampaignGroup& group = *block.group;
    const Scenes::Loaded& loaded = scenes.of(block);
    const RunContext context{campaign.name,
                             campaign.seed,
                             static_cast<std::int64_t>(number),
                             &block,
                             &loaded.scene,
                             loaded.hash,
                             {},
                             nullptr,
                             blocks};
    const IsaGuard guard(block);
    PlannedBlock& planned = plan.emplace_back();
    planned.label = label(block, loaded.scene);
    planned.seconds = group.seconds;
    const auto add = [&](std::string name, std::vector<std::string> contestants) {
      if (!contestants.empty()) planned.sets.push_back({std::move(name), std::move(contestants)});
    };
    std::vector<std::string> broad;
    for (const BroadPhaseEntry* entry : context.broad()) broad.push_back(entry->info.name);
    std::vector<std::string> listed = broad;
    if (group.limit && !broad.empty()) listed.emplace_back(stats::limit_label);
    add("broad phases", listed);
    // Without narrow phases the first frames determine the time of all.
    const bool has_pairs = has_narrow(context);
    scene::Scene scene = loaded.scene;
    const auto frames = static_cast<std::size_t>(
        scene.recording.empty() ? scene.frames : static_cast<int>(scene.recording.size()));
    if (!has_pairs) {
      scene.frames = std::min(scene.frames, tried_frames);
      if (!scene.recording.empty()) {
        scene.recording.resize(std::min<std::size_t>(frames, tried_frames));
      }
    }
    const base::Stopwatch watch;
    const measure::BlockInput input(scene, block.boxes, has_pairs);
    planned.check_seconds =
        watch.seconds() * static_cast<double>(frames) / static_cast<double>(input.frames.size());
    std::vector<measure::NarrowSet> sets;
    if (has_pairs) sets = measure::narrow_sets(input, "", true_pairs(input), group.tasks);
    planned.check_seconds += price_of_check(context, input, frames, sets);
    if (!has_pairs) continue;
    if (!finds_pairs(context)) broad.assign(1, "");
    for (const std::string& source : broad) {
      for (const measure::NarrowSet& set : sets) {
        std::vector<std::string> narrow;
        for (const measure::NarrowChoice& choice : group.narrow) {
          if (offers(*choice.entry, set.kind_a, set.kind_b, set.task) &&
              context.admits(choice, source, set.task, set.kind_name())) {
            narrow.push_back(Candidate{.broad = nullptr, .narrow = &choice}.label());
          }
        }
        add(fmt::format("{} {}{}{}", to_string(set.task), set.kind_name(),
                        source.empty() ? "" : " on the pairs of ", source),
            std::move(narrow));
      }
    }
  }
  return plan;
}

}  // namespace touchstone::campaign
