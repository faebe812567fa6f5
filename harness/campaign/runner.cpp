// Runs a campaign block by block: check pass, then samples.
#include "harness/campaign/runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/limit.h"
#include "harness/base/clock.h"
#include "harness/base/progress.h"
#include "harness/campaign/block_run.h"
#include "harness/campaign/blocks.h"
#include "harness/campaign/check_broad.h"
#include "harness/campaign/check_narrow.h"
#include "harness/process/child_process.h"
#include "harness/process/interrupt.h"
#include "harness/record/folder_files.h"
#include "harness/stats/samples.h"

namespace touchstone::campaign {
namespace {

constexpr std::size_t raw = 0, departures = 1;

}  // namespace

std::vector<record::RowFile> run_files() {
  return {{"raw.csv", record::header_of<record::RawRow>()},
          {"departures.csv", record::header_of<record::Departure>()}};
}

RunFolder::RunFolder(std::filesystem::path folder, record::Facts facts, record::FolderStart start,
                     record::Findings& findings)
    : folder_({.folder = std::move(folder),
               .files = run_files(),
               .identity = std::move(facts),
               .start = start,
               .work = "run",
               .made = {"tables.md"}}) {
  if (start != record::FolderStart::resume) return;
  for (record::RawRow& row : folder_.rows<record::RawRow>(raw)) findings.add(std::move(row));
  for (record::Departure& one : folder_.rows<record::Departure>(departures))
    findings.add(std::move(one));
  // A block that was stopped before its end is checked again, and writes these again.
  record::OwnFiles(folder_.path("")).remove([&](const std::string& name) {
    return std::ranges::none_of(findings.departures(), [&](const record::Departure& one) {
      return one.reproduction.ends_with(name);
    });
  });
  rows_ = findings.rows().size();
  departures_ = findings.departures().size();
}

void RunFolder::commit(const record::Findings& findings) {
  if (rows_ == findings.rows().size() && departures_ == findings.departures().size()) return;
  for (; departures_ < findings.departures().size(); ++departures_) {
    folder_.write(departures, findings.departures()[departures_]);
  }
  for (; rows_ < findings.rows().size(); ++rows_) folder_.write(raw, findings.rows()[rows_]);
  folder_.commit();
}

namespace {

// The lower bound of algorithms/limit.h, which only writes the pairs that the input holds.
class LowerBound final : public BroadPhase {
 public:
  LowerBound(Executor& executor, const measure::BlockInput& input)
      : bound_(make_broad_phase_limit(executor)), input_(input) {}

  void build(std::span<const Aabb> boxes) override {
    boxes_ = boxes;
    bound_->sort_and_gather(boxes);
  }
  void update(const FrameChange& change) override { build(change.boxes); }
  Status find_pairs(PairSink& sink) override {
    // The frame to which these boxes belong.
    const auto frame = std::ranges::find_if(input_.frames, [&](const measure::BlockFrame& own) {
      return own.boxes.data() == boxes_.data();
    });
    bound_->write(frame->truth, sink);
    return Status::ok;
  }

 private:
  std::unique_ptr<BroadPhaseLimit> bound_;
  const measure::BlockInput& input_;
  std::span<const Aabb> boxes_;
};

// Returns it as a broad phase that is measured like the others of the block, named
// stats::limit_label in its rows. It works only with the boxes of this input, which outlives it.
BroadPhaseEntry lower_bound_entry(const measure::BlockInput& input) {
  return {.info = {.name = stats::limit_label,
                   .citation = "a radix sort, a gather, and the writing of the pairs",
                   .origin = Origin::oracle},
          .make = [&input](Executor& executor) {
            return std::make_unique<LowerBound>(executor, input);
          }};
}

// The sets of true pairs, and the sets of the broad phases' pairs.
struct NarrowInput {
  std::vector<measure::NarrowSet> checked, measured;
};

// Checks the broad phases and returns the pairs for the narrow phases. Rows go to
// `context.findings`. With `again` the rows are known, and only the pairs are needed.
NarrowInput check_broad_phases(const RunContext& context, const measure::BlockInput& input,
                               bool again) {
  const bool narrow = context.has_narrow();
  const bool product = narrow && context.finds_pairs();
  NarrowInput sets;
  if (narrow) sets.checked = context.true_sets(input);
  if (!product) sets.measured = sets.checked;
  if (again && !product) return sets;
  for (const BroadPhaseEntry* entry : context.broad()) {
    const CheckedBroad check = check_broad(context, input, *entry, product);
    if (!product || !check.whole || entry == context.limit) continue;
    auto found =
        measure::narrow_sets(input, entry->info.name, check.pairs, context.block->group->tasks);
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
  const measure::BlockInput input(*context.scene, context.block->boxes, context.has_narrow());
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
    return !process::InterruptGuard::raised();
  });
}

}  // namespace

RunResult run_campaign(const Campaign& campaign, const std::filesystem::path& folder,
                       record::FolderStart start, const std::optional<record::Part>& part,
                       const std::function<bool()>& before) {
  process::expect_one_thread();
  const CampaignBlocks blocks(campaign, part ? std::optional(part->units) : std::nullopt);
  record::Facts facts = campaign_facts(campaign, blocks.scene_hashes());
  if (part) append_facts(*part, facts);
  RunResult result;
  RunFolder files(folder, std::move(facts), start, result.findings);
  if (files.was_finished()) return result;
  if (before && start != record::FolderStart::resume && !before()) {
    result.interrupted = true;
    result.stopped_at = "the first look";
    return result;
  }
  const auto& rows = result.findings.rows();
  // The block at which the run stopped.
  const std::int64_t at = rows.empty() ? -1 : rows.back().block;
  {
    const process::InterruptGuard guard;
    const base::UnitRange range = blocks.range();
    std::vector<double> expected;  // seconds of each block; those that are done take none
    for (std::int64_t number = range.first; number < range.end; ++number) {
      const RunContext context = blocks.context(number, nullptr);
      expected.push_back(number < at ? 0 : context.block->group->seconds);
    }
    base::Progress progress(std::move(expected));
    for (std::int64_t number = range.first; number < range.end; ++number) {
      if (process::InterruptGuard::raised()) break;
      progress.start(blocks.label(number));
      if (number < at) continue;
      RunContext context = blocks.context(number, &result.findings);
      context.results = folder;
      run_block(context, context.number == at, progress, files);
      const bool timed = !rows.empty() && rows.back().block == number &&
                         rows.back().kind == record::RowKind::sample;
      result.stopped_at = fmt::format("the {} of block {} of {}, {}", timed ? "samples" : "check",
                                      number + 1, range.end, blocks.label(number));
    }
    result.interrupted = process::InterruptGuard::raised();
  }
  if (!result.interrupted) files.finish();
  return result;
}

record::Findings check_campaign(const Campaign& campaign) {
  process::expect_one_thread();
  const CampaignBlocks blocks(campaign);
  record::Findings findings;
  for (std::int64_t number = 0; number < blocks.size(); ++number) {
    RunContext context = blocks.context(number, &findings);
    const IsaGuard guard(*context.block);
    const measure::BlockInput input(*context.scene, context.block->boxes, context.has_narrow());
    const BroadPhaseEntry limit = lower_bound_entry(input);
    if (context.block->group->limit) context.limit = &limit;
    const NarrowInput narrow = check_broad_phases(context, input, false);
    NarrowCheck(context, input, narrow.checked).run();
  }
  return findings;
}

}  // namespace touchstone::campaign
