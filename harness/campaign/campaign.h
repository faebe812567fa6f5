// A campaign: which algorithms run on which scenes, with which settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "harness/measure/narrow_choice.h"
#include "harness/scene/scene.h"
#include "harness/stats/published.h"

namespace touchstone::campaign {

// The combination of broad and narrow phases.
enum class Pairing : std::uint8_t {
  separate,  // each narrow phase once a frame, on the true pairs
  product,   // each narrow phase on the pairs of each broad phase, as reported
};

// A rule applies to the cells that match every criterion it has.
struct CampaignRule {
  // A rule with one of them matches no cell of the other. A concave phase is a narrow one here, with
  // or without the name of its mid-phase.
  std::optional<std::string> broad, narrow;
  std::optional<std::string> scene;  // a scene's name, with or without the gap
  std::optional<Precision> scalar;
  std::optional<record::QueryTask> task;
  std::optional<std::string> pair_kind;  // "box-sphere"
  std::optional<scene::BoxKind> boxes;
  std::optional<int> threads;
  std::optional<bool> warm;
  std::optional<int> batch;
  std::optional<std::int64_t> counts_above, counts_below;  // limits of the number of bodies

  bool operator==(const CampaignRule&) const = default;
};

// One algorithm in one set of a block. If it is a broad phase, the fields from `narrow` on are
// empty; if it is a narrow phase, `broad` is the broad phase that found the pairs, or empty.
struct CampaignCell {
  std::string scene;
  std::int64_t bodies = 0;
  scene::BoxKind boxes = scene::BoxKind::tight;
  int threads = 1;
  std::string broad, narrow;
  std::optional<Precision> scalar;
  std::optional<record::QueryTask> task;
  std::string pair_kind;
  std::optional<bool> warm = {};
  std::optional<int> batch = {};
};

// A grid: every scene x count x seed x gap x boxes x threads x isa is a block, in which every
// algorithm of the group meets the same frames.
struct CampaignGroup {
  std::vector<std::filesystem::path> scenes;
  std::vector<std::int64_t> counts = {-1};  // -1: the scene's own
  std::vector<std::int64_t> seeds = {-1};
  std::vector<std::optional<double>> gaps = {std::nullopt};  // metres; none: the scene's own
  int frames = -1;
  std::vector<scene::BoxKind> boxes = {scene::BoxKind::tight};
  std::vector<int> threads = {2};
  // Each algorithm on each of them is a contestant of the same sets, where there are several threads.
  std::vector<ExecutorKind> executors = {usual_executor};
  // The highest level of vector instructions for our kernels; none: the limit of the run.
  std::vector<std::optional<Isa>> isa = {std::nullopt};
  bool rebuild = false;  // true if every frame is built anew instead of updated
  std::vector<const BroadPhaseEntry*> broad;
  bool limit = false;  // true if the lower bound (algorithms/limit.h) is measured too
  std::vector<measure::NarrowChoice> narrow;
  std::vector<measure::NarrowChoice> concave;  // for pairs with a body that is not convex
  std::vector<record::QueryTask> tasks = {record::QueryTask::intersect};
  Pairing pairing = Pairing::separate;
  std::vector<CampaignRule> include, exclude;
  // The limit for one frame, seconds; a slower algorithm is left out of the block.
  double time_limit = 10;
  std::size_t memory_limit = std::size_t{4} << 30;  // bytes that one algorithm may take
  // Repetition ends if the half-width of every ratio's interval is at most `width`, or these
  // seconds are spent, shared over the sets of a block, or this number of squares is done.
  double width = 0.02;
  double seconds = 10;
  std::optional<int> squares;
  std::optional<int> rounds;  // rounds of each square that run; none: all
  int processes = 3;          // the number for each contestant before the intervals are looked at

  bool admits(const CampaignCell& cell) const;
  // The narrow phases, then the concave phases.
  std::vector<const measure::NarrowChoice*> choices() const;
};

struct Campaign {
  std::string name;
  std::uint64_t seed = 1;  // the seed of the order in which algorithms run
  std::vector<CampaignGroup> groups;
  stats::Published published;
};

// Reads a campaign file: datasets/README.md documents the keys. Keys at the top level are defaults
// of each [[group]]; scenes are relative to the folder `home`, without one to that of the file.
// Throws InputError with file, line and what was expected.
Campaign read_campaign(const std::filesystem::path& file, const std::filesystem::path& home = {});

// Returns the facts that decide a campaign's rows: its name, seed and content, and the hashes of its
// scenes and of the program.
std::vector<std::pair<std::string, std::string>> campaign_identity(
    const Campaign& campaign, const std::map<std::string, std::string>& scene_hashes);
// Returns these facts and those of the machine, which decide the times.
std::vector<std::pair<std::string, std::string>> campaign_facts(
    const Campaign& campaign, const std::map<std::string, std::string>& scene_hashes);

// Returns the campaign's settings as one text, which is equal for equal campaigns only.
std::string description(const Campaign& campaign);

}  // namespace touchstone::campaign
