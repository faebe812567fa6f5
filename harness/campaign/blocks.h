// The blocks of a campaign, with their scenes, and what the parts of a run share about a block.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/base/unit_range.h"
#include "harness/campaign/campaign.h"
#include "harness/measure/block_input.h"
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

// This is the data on the current block that the parts of a run share.
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
  bool counts_allocations = true;          // in passes of their own

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

class CampaignBlocks {
 public:
  // Loads each scene of the range once; without a range, of all blocks. Throws InputError for a
  // faulty scene, if the campaign has none, or if it lacks a block of the range. The campaign must
  // outlive the object.
  explicit CampaignBlocks(const Campaign& campaign, std::optional<base::UnitRange> range = {});

  std::int64_t size() const { return static_cast<std::int64_t>(blocks_.size()); }  // of all blocks
  // The blocks whose scenes are loaded; the others have no context and no label.
  const base::UnitRange& range() const { return range_; }
  // Returns the context of a block, without a results folder.
  RunContext context(std::int64_t number, record::Findings* findings) const;
  // Returns a label such as "uniform, 1000 bodies, 64 frames, tight boxes, 2 threads".
  std::string label(std::int64_t number) const;
  // Returns whether a block differs from the one before in threads or instructions alone, so that
  // their times are compared.
  bool belongs_to_previous(std::int64_t number) const;
  // Returns the hashes of the loaded scenes by name and count.
  std::map<std::string, std::string> scene_hashes() const;

 private:
  struct Loaded {
    scene::Scene scene;
    std::string hash;
  };
  using Key =
      std::tuple<std::filesystem::path, std::int64_t, std::int64_t, int, std::optional<double>>;
  static Key key(const Block& block);
  const Block& block(std::int64_t number) const {
    return blocks_[static_cast<std::size_t>(number)];
  }
  const Loaded& scene_of(const Block& block) const { return scenes_.at(key(block)); }

  const Campaign& campaign_;
  std::vector<Block> blocks_;
  base::UnitRange range_;
  std::map<Key, Loaded> scenes_;
};

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

}  // namespace touchstone::campaign
