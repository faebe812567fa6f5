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
#include "harness/measure/phases/block_input.h"
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
  std::optional<Isa> isa = {};  // the highest level for the kernels, if the campaign limits it
};

struct RunContext {
  std::string campaign;
  std::uint64_t seed = 1;   // the campaign's seed
  std::int64_t number = 0;  // the block's number, in the campaign's order
  const Block* block = nullptr;
  const scene::Scene* scene = nullptr;
  std::string scene_hash;
  // The results folder, for files that reproduce a departure; empty: none.
  std::filesystem::path results;
  record::Findings* findings = nullptr;
  std::span<const Block> blocks = {};      // all blocks of the campaign, by their numbers
  const BroadPhaseEntry* limit = nullptr;  // the lower bound, if the campaign measures it

  // Returns a row with the columns that the block decides.
  record::RawRow row(std::size_t frame) const;
  // Returns a row of an algorithm.
  record::RawRow row(std::size_t frame, const BroadPhaseEntry& entry, record::Phase phase) const;
  record::RawRow row(std::size_t frame, const measure::NarrowChoice& choice) const;
  // Returns the broad phases of the group that its rules admit, the lower bound last.
  std::vector<const BroadPhaseEntry*> broad() const;
  // Returns the executors on which each algorithm is timed; a single empty one at one thread.
  std::vector<std::optional<ExecutorKind>> executors() const;
  // Returns true if the campaign's rules let it take part.
  bool admits(const BroadPhaseEntry& entry) const;
  bool admits(const measure::NarrowChoice& choice, const std::string& broad, record::QueryTask task,
              const std::string& pair_kind) const;
  // Returns true if narrow phases or concave phases run on the block.
  bool has_narrow() const;
  // Returns true if narrow phases solve the pairs that each broad phase finds.
  bool finds_pairs() const;
  // Returns the sets of the true pairs.
  std::vector<measure::NarrowSet> true_sets(const measure::BlockInput& input) const;
  // Returns a place such as "home, 85 bodies, frame 3".
  std::string place(std::size_t frame) const;
  // Returns a departure of this algorithm in this block.
  record::Departure departure(const AlgorithmInfo& info, std::string label,
                              std::string where) const;
};

}  // namespace touchstone::campaign
