// Rows, places and algorithms of the current block.
#include "harness/campaign/run_context.h"

#include <fmt/core.h>

#include <utility>

namespace touchstone::campaign {

record::RawRow RunContext::row(std::size_t frame) const {
  record::RawRow row;
  row.campaign = campaign;
  row.block = number;
  row.scene = scene->name;
  row.scene_hash = scene_hash;
  row.seed = block->overrides.seed;
  row.bodies = static_cast<std::int64_t>(scene->size());
  row.boxes = block->boxes;
  row.frame = static_cast<std::int64_t>(frame);
  row.threads = block->threads;
  row.isa = isa();
  row.isa_limit = block->isa;
  return row;
}

record::RawRow RunContext::row(std::size_t frame, const BroadPhaseEntry& entry,
                               record::Phase phase) const {
  record::RawRow result = row(frame);
  result.broad = entry.info.name;
  result.origin =
      &entry == limit ? record::RowOrigin::limit : record::row_origin(entry.info.origin);
  result.phase = phase;
  result.status = record::RowStatus::ok;
  if (block->group->rebuild) result.rebuild = true;
  return result;
}

record::RawRow RunContext::row(std::size_t frame, const measure::NarrowChoice& choice) const {
  record::RawRow result = row(frame);
  result.narrow = choice.name();
  result.origin = record::row_origin(choice.info().origin);
  result.scalar = choice.settings.scalar;
  result.tolerance = choice.settings.tolerance.value_or(Outcome::none);
  result.duality_gap = choice.settings.duality_gap.value_or(Outcome::none);
  if (choice.warm) result.warm = true;
  if (choice.batch != measure::usual_batch) result.batch = choice.batch;
  if (choice.entry != nullptr && choice.entry->traits.depth_is_bound) result.depth_bound = true;
  result.phase = record::Phase::narrow;
  return result;
}

std::vector<const BroadPhaseEntry*> RunContext::broad() const {
  std::vector<const BroadPhaseEntry*> entries;
  for (const BroadPhaseEntry* entry : block->group->broad) {
    if (admits(*entry)) entries.push_back(entry);
  }
  if (limit != nullptr && !entries.empty() && scene->pairs.empty()) entries.push_back(limit);
  return entries;
}

std::vector<std::optional<ExecutorKind>> RunContext::executors() const {
  if (block->threads == 1) return {std::nullopt};
  std::vector<std::optional<ExecutorKind>> kinds;
  for (const ExecutorKind kind : block->group->executors) {
    if (std::ranges::find(kinds, std::optional(kind)) == kinds.end()) kinds.emplace_back(kind);
  }
  return kinds;
}

bool RunContext::admits(const BroadPhaseEntry& entry) const {
  // The scene lists its pairs, so a broad phase has no work.
  if (!scene->pairs.empty()) return false;
  return block->group->admits({.scene = scene->name,
                               .bodies = static_cast<std::int64_t>(scene->size()),
                               .boxes = block->boxes,
                               .threads = block->threads,
                               .broad = entry.info.name,
                               .narrow = {},
                               .scalar = {},
                               .task = {},
                               .pair_kind = {}});
}

bool RunContext::admits(const measure::NarrowChoice& choice, const std::string& broad,
                        record::QueryTask task, const std::string& pair_kind) const {
  return block->group->admits({.scene = scene->name,
                               .bodies = static_cast<std::int64_t>(scene->size()),
                               .boxes = block->boxes,
                               .threads = block->threads,
                               .broad = broad,
                               .narrow = choice.name(),
                               .scalar = choice.settings.scalar,
                               .task = task,
                               .pair_kind = pair_kind,
                               .warm = choice.warm,
                               .batch = choice.batch});
}

bool RunContext::has_narrow() const {
  const bool concave = !block->group->concave.empty() && !scene->concave.empty();
  return (!block->group->narrow.empty() || concave) && scene->recording.empty();
}

bool RunContext::finds_pairs() const {
  return block->group->pairing == Pairing::product && scene->pairs.empty();
}

std::vector<measure::NarrowSet> RunContext::true_sets(const measure::BlockInput& input) const {
  std::vector<std::vector<IndexPair>> pairs;
  for (const measure::BlockFrame& frame : input.frames) pairs.push_back(frame.truth);
  return measure::narrow_sets(input, "", pairs, block->group->tasks);
}

std::string RunContext::place(std::size_t frame) const {
  return fmt::format("{}, {} bodies, frame {}", scene->name, scene->size(), frame);
}

record::Departure RunContext::departure(const AlgorithmInfo& info, std::string label,
                                        std::string where) const {
  return {.block = number,
          .row = -1,
          .algorithm = std::move(label),
          .ours = info.origin == Origin::ours,
          .known = !info.known_defect.empty(),
          .where = std::move(where),
          .what = "",
          .reproduction = ""};
}

}  // namespace touchstone::campaign
