// Lists the blocks of a campaign and loads their scenes.
#include "harness/campaign/blocks.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "harness/base/error.h"

namespace touchstone::campaign {
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
  return fmt::format("{}, {} bodies, {} frames{}, {} boxes, {} thread{}{}", scene.name,
                     scene.size(), scene.frames, block.group->rebuild ? " rebuilt" : "",
                     to_string(block.boxes), block.threads, block.threads == 1 ? "" : "s",
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
