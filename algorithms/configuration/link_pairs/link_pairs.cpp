// Link pairs: bounds of the parts of links and obstacles, then a narrow phase for the pairs that they leave open.
// Paper:   Pan, Chitta, Manocha, "FCL: A general purpose library for collision and proximity queries", ICRA 2012 (what a
//          planner asks); Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (boxes); Thomason, Kingston, Kavraki,
//          "Motions in microseconds via vectorized sampling-based planning", ICRA 2024 (balls of links).
// Steps:   1. Bind: a ball and a box around each part in the frame of its link; the phases are bound to all parts.
//          2. free: the pair that was in contact in the configuration before is asked first.
//          3. `world-tree` looks in a tree of the obstacles' boxes for a ball around each link, and compares such balls of
//             two links. `pose-lanes` compares balls of links, and then of parts, in sixteen configurations at
//             once, in floats; balls that are surely in a box or another ball end a lane.
//          4. Each pair that is left: the two balls, the ball of each with the box of the other, the two boxes.
//             Balls with balls and with boxes are decided so, unless rounding might matter.
//          5. Pairs that are left open are asked, those first whose parts were most often in contact: convex
//             ones by the narrow phase, others by the concave phase. The first contact ends it. What a pair answered
//             holds until one of its parts moves: a base that stands on a table is asked once.
//          6. motion: step by step, until one is in contact.
//          7. distance, by `fixed-pairs`: lower bounds by balls and boxes; pairs are measured in their order, until
//             the next bound is beyond the least distance.
// Departs: VAMP's lanes are configurations spread over a motion; here they follow each other, since the first contact is
//          asked.
// Fails:   unknown where the narrow phase or the concave phase is. Which pair is named depends on what was asked
//          before.
// Cost:    a few dozen operations for each pair that bounds decide, and that of the phases for others. The same
//          configuration twice in a row costs no phase the second time.
#include "algorithms/configuration/link_pairs/lane_search.h"
#include "algorithms/configuration/link_pairs/pair_search.h"
#include "algorithms/configuration/link_pairs/world_tree.h"

namespace touchstone {
namespace {

class FixedPairs final : public PairSearch {
 public:
  using PairSearch::PairSearch;

 private:
  void prepare(const ConfigurationModel&) override {}
  IndexPair search(std::span<const Pose>) override { return settle(model_.pairs()); }
};

template <class Search>
ConfigurationEntry entry(const char* name, const char* citation,
                         std::vector<ConfigurationTask> tasks) {
  return {.info = {.name = name, .citation = citation},
          .tasks = std::move(tasks),
          .make = [](const ConfigurationSettings& settings) {
            return std::make_unique<Search>(settings);
          }};
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<ConfigurationEntry> configuration_link_pairs() {
  using enum ConfigurationTask;
  return {
      entry<FixedPairs>("fixed-pairs",
                        "all pairs that are asked, by balls and boxes, then a narrow phase",
                        {free, distance, motion}),
      entry<WorldTree>("world-tree",
                       "a tree of the obstacles, asked for a ball around each link; else as "
                       "fixed-pairs",
                       {free, motion}),
      entry<PoseLanes>("pose-lanes",
                       "W. Thomason, Z. Kingston, L. E. Kavraki, \"Motions in microseconds via "
                       "vectorized sampling-based planning\", ICRA 2024: sixteen configurations "
                       "at once, by balls; else as fixed-pairs",
                       {free, motion})};
}

}  // namespace touchstone::entries
