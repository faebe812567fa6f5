// The blocks of a campaign, with their scenes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "harness/campaign/run_context.h"

namespace touchstone::campaign {

class CampaignBlocks {
 public:
  // Loads each scene once. Throws InputError for a faulty scene, or if the campaign has none. The
  // campaign must outlive the object.
  explicit CampaignBlocks(const Campaign& campaign);

  std::size_t size() const { return blocks_.size(); }
  // Returns the context of a block, without a folder of reproductions.
  RunContext context(std::size_t number, record::Findings* findings) const;
  // Returns a label such as "uniform, 1000 bodies, 64 frames, tight boxes, 2 threads".
  std::string label(std::size_t number) const;
  // Returns the scenes' hashes by name and count.
  std::map<std::string, std::string> scene_hashes() const;

 private:
  struct Loaded {
    scene::Scene scene;
    std::string hash;
  };
  using Key =
      std::tuple<std::filesystem::path, std::int64_t, std::int64_t, int, std::optional<double>>;
  static Key key(const Block& block);
  const Loaded& scene_of(const Block& block) const { return scenes_.at(key(block)); }

  const Campaign& campaign_;
  std::vector<Block> blocks_;
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
