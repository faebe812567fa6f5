// Lists the blocks of a campaign and loads their scenes; rows, places and algorithms of a block.
#include "harness/campaign/blocks.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "harness/base/error.h"

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
          .ours = is_answerable(info.origin),
          .known = !info.known_defect.empty(),
          .where = std::move(where),
          .what = "",
          .reproduction = ""};
}

namespace {

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

// A warm start needs a frame before.
void expect_frames(const Block& block, const scene::Scene& scene) {
  const bool warm = std::ranges::any_of(block.group->narrow, &measure::NarrowChoice::warm);
  if (!warm || scene.frames > 1 || !scene.recording.empty()) return;
  throw base::InputError(
      block.scene_file.string(), 0,
      "has 1 frame, and the campaign wants warm starts; expected `frames` of 2 or "
      "more, in the scene or the campaign");
}

}  // namespace

CampaignBlocks::CampaignBlocks(const Campaign& campaign, std::optional<base::UnitRange> range)
    : campaign_(campaign), blocks_(blocks_of(campaign)) {
  range_ = range.value_or(base::UnitRange{0, size()});
  if (range_.first < 0 || range_.end > size() || range_.empty()) {
    throw base::InputError(
        fmt::format("the campaign has the blocks 0-{}; expected a part of them, not {}", size(),
                    to_string(range_)));
  }
  for (std::int64_t number = range_.first; number < range_.end; ++number) {
    const Block& block = this->block(number);
    auto at = scenes_.find(key(block));
    if (at == scenes_.end()) {
      scene::Scene scene = scene::load_scene(block.scene_file, block.overrides);
      std::string hash = scene_hash(scene);
      at = scenes_.emplace(key(block), Loaded{std::move(scene), std::move(hash)}).first;
    }
    expect_frames(block, at->second.scene);
  }
}

CampaignBlocks::Key CampaignBlocks::key(const Block& block) {
  const scene::SceneOverrides& overrides = block.overrides;
  return {block.scene_file, overrides.count, overrides.seed, overrides.frames, overrides.gap};
}

RunContext CampaignBlocks::context(std::int64_t number, record::Findings* findings) const {
  const Block& block = this->block(number);
  const Loaded& loaded = scene_of(block);
  return {campaign_.name, campaign_.seed, number, &block, &loaded.scene, loaded.hash, {},
          findings,       blocks_};
}

std::string CampaignBlocks::label(std::int64_t number) const {
  const Block& block = this->block(number);
  const scene::Scene& scene = scene_of(block).scene;
  return fmt::format("{}, {} bodies, {} frame{}{}, {} boxes, {} thread{}{}", scene.name,
                     scene.size(), scene.frames, scene.frames == 1 ? "" : "s",
                     block.group->rebuild ? " rebuilt" : "", to_string(block.boxes), block.threads,
                     block.threads == 1 ? "" : "s",
                     block.isa ? fmt::format(", {} instructions", to_string(*block.isa)) : "");
}

bool CampaignBlocks::belongs_to_previous(std::int64_t number) const {
  if (number == 0) return false;
  const Block& before = block(number - 1);
  const Block& here = block(number);
  return before.group == here.group && key(before) == key(here) && before.boxes == here.boxes;
}

std::map<std::string, std::string> CampaignBlocks::scene_hashes() const {
  std::map<std::string, std::string> hashes;
  for (const auto& [key, loaded] : scenes_) {
    std::string& hash =
        hashes[fmt::format("{}, {} bodies", loaded.scene.name, loaded.scene.size())];
    hash += (hash.empty() ? "" : " ") + loaded.hash;
  }
  return hashes;
}

}  // namespace touchstone::campaign
