// A campaign: which algorithms run on which scenes, with which settings.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/scene/scene.h"

namespace touchstone {

struct NarrowChoice {
  const NarrowPhaseEntry* entry = nullptr;
  NarrowPhaseSettings settings;
};

// How broad and narrow phases are put together.
enum class Pairing : std::uint8_t {
  separate,  // each narrow phase once a frame, on the true pairs
  product,   // each narrow phase on the pairs of each broad phase, as that one reports them
};

// A grid: every scene x count x seed x boxes x threads is a block, in which every algorithm of the
// group meets the same frames.
struct CampaignGroup {
  std::vector<std::filesystem::path> scenes;
  std::vector<std::int64_t> counts = {-1};  // -1: as the scene says
  std::vector<std::int64_t> seeds = {-1};
  int frames = -1;
  std::vector<BoxKind> boxes = {BoxKind::tight};
  std::vector<int> threads = {2};
  bool rebuild = false;  // every frame is built anew instead of updated
  std::vector<const BroadPhaseEntry*> broad;
  std::vector<NarrowChoice> narrow;
  std::vector<Task> tasks = {Task::intersect};
  Pairing pairing = Pairing::separate;
  double time_limit =
      10;  // seconds, for one frame of one algorithm; then it is left out of the block
};

struct Campaign {
  std::string name;
  std::uint64_t seed = 1;  // of the order in which algorithms run
  std::vector<CampaignGroup> groups;
};

// Reads a campaign file: the keys are documented in datasets/README.md. Keys at the top level are
// defaults of each [[group]]; scenes are relative to the file. Throws InputError with file, line
// and what was expected.
Campaign read_campaign(const std::filesystem::path& file);

}  // namespace touchstone
