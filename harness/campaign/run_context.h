// Data on the current block that the parts of a run share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/campaign/campaign.h"
#include "harness/record/findings.h"
#include "harness/scene/scene.h"

namespace touchstone::campaign {

// One block: a scene as it is played, for every algorithm of a group.
struct Block {
  const CampaignGroup* group = nullptr;
  std::filesystem::path scene_file;
  scene::SceneOverrides overrides;
  scene::BoxKind boxes = scene::BoxKind::tight;
  int threads = 2;
  std::optional<Isa> isa = {};  // the most that the kernels may use, where the campaign says
};

struct RunContext {
  std::string campaign;
  std::uint64_t seed = 1;   // the campaign's
  std::int64_t number = 0;  // the block's, in the campaign's order
  const Block* block = nullptr;
  const scene::Scene* scene = nullptr;
  std::string scene_hash;
  std::filesystem::path reproductions;  // folder for files that show a discrepancy; empty: none
  record::Findings* findings = nullptr;
  std::span<const Block> blocks = {};      // all of the campaign, by their numbers
  const BroadPhaseEntry* limit = nullptr;  // the lower bound, where the campaign asks for it

  // A row with the columns that the block decides.
  record::RawRow row(std::size_t frame) const;
  // A row of an algorithm.
  record::RawRow row(std::size_t frame, const BroadPhaseEntry& entry, record::Phase phase) const;
  record::RawRow row(std::size_t frame, const measure::NarrowChoice& choice) const;
  // The broad phases of the group that its rules admit, the lower bound last.
  std::vector<const BroadPhaseEntry*> broad() const;
  // True where the campaign's rules let it take part.
  bool admits(const BroadPhaseEntry& entry) const;
  bool admits(const measure::NarrowChoice& choice, const std::string& broad, Task task,
              const std::string& pair_kind) const;
  // "home, 85 bodies, frame 3"
  std::string place(std::size_t frame) const;
  // The text with '_' for each blank: names of scenes may have some.
  static std::string file_name(std::string text);
  // A discrepancy of this algorithm in this block.
  record::Departure departure(const AlgorithmInfo& info, std::string label,
                              std::string where) const;
};

}  // namespace touchstone::campaign
