// The blocks of a campaign, with their scenes.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "harness/base/unit_range.h"
#include "harness/campaign/run_context.h"

namespace touchstone::campaign {

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
