// What the runners of a block share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/run/campaign.h"
#include "harness/run/findings.h"
#include "harness/scene/scene.h"

namespace touchstone {

// One block: a scene as it is played, for every algorithm of a group.
struct Block {
  const CampaignGroup* group = nullptr;
  std::filesystem::path scene_file;
  SceneOverrides overrides;
  BoxKind boxes = BoxKind::tight;
  int threads = 2;
};

struct RunContext {
  const Block* block = nullptr;
  const Scene* scene = nullptr;
  std::string scene_hash;
  std::filesystem::path reproductions;  // the folder for files that show a departure
  Findings* findings = nullptr;

  // A row with the columns that the block decides.
  RawRow row(int frame) const {
    RawRow row;
    row.scene = scene->name;
    row.scene_hash = scene_hash;
    row.bodies = static_cast<std::int64_t>(scene->size());
    row.boxes = to_string(block->boxes);
    row.frame = frame;
    row.threads = block->threads;
    return row;
  }
  std::string place(int frame) const;
};

}  // namespace touchstone
