// Concave phases on the pairs of scenes.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "harness/measure/narrow_sampler.h"
#include "tests/harness/scene/scene_text.h"

namespace touchstone::measure {
namespace {

constexpr std::array doubles = {Precision::float64};

std::vector<NarrowChoice> ours() {
  std::vector<const ConcaveEntry*> entries;
  std::vector<const MidPhaseEntry*> mids;
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (entry.info.origin == Origin::ours) entries.push_back(&entry);
  }
  for (const MidPhaseEntry& mid : registry::entries<MidPhaseEntry>()) mids.push_back(&mid);
  return concave_choices(entries, mids, doubles);
}

std::vector<NarrowSet> sets_of(const BlockInput& input, std::span<const record::QueryTask> tasks) {
  std::vector<std::vector<IndexPair>> pairs;
  for (const BlockFrame& frame : input.frames) pairs.push_back(frame.truth);
  return narrow_sets(input, "", pairs, tasks);
}

SampleReply sample(const NarrowChoice& choice, const BlockInput& input,
                   std::span<const NarrowSet> sets, std::uint32_t set, int threads) {
  Executor executor(threads);
  NarrowSampler sampler(choice, input, sets, executor);
  return sampler.sample({.set = set, .frames = static_cast<std::uint32_t>(input.frames.size())});
}

// Two linked rings: `shift` metres along x from where they hang free.
std::string rings(const std::string& meshes, double shift) {
  return "meshes = \"" + meshes + "\"\nbody = [\n" +
         "{shape = {type = \"torus\", tube_radius = 0.2}},\n" +
         "{shape = {type = \"torus\", tube_radius = 0.2}, rotation = [1, 0, 0, 0, 0, -1, 0, 1, 0], "
         "translation = [" +
         std::to_string(1 + shift) + ", 0, 0]}]\n";
}

TEST(ConcavePairs, ATorusCollidesAsATorus) {
  constexpr std::array tasks = {record::QueryTask::intersect};
  for (const char* use : {"surface", "solid"}) {
    for (const double shift : {0.0, 0.9}) {
      const scene::Scene scene = load_text(rings(use, shift));
      const BlockInput input(scene, scene::BoxKind::tight, true);
      const std::vector<NarrowSet> sets = sets_of(input, tasks);
      ASSERT_EQ(sets.size(), 1u);
      EXPECT_EQ(sets[0].kind_name(), use == std::string("solid") ? "solid-solid" : "mesh-mesh");
      for (const NarrowChoice& choice : ours()) {
        const SampleReply reply = sample(choice, input, sets, 0, 1);
        EXPECT_EQ(reply.contacts, shift == 0 ? 0 : 1) << choice.label() << shift;
      }
    }
  }
  // Their hulls overlap where they hang free.
  const scene::Scene scene = load_text(rings("hull", 0));
  const BlockInput input(scene, scene::BoxKind::tight, true);
  const std::vector<NarrowSet> sets = sets_of(input, tasks);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].kind_name(), "hull-hull");
  const NarrowChoice gjk{.entry = registry::find<NarrowPhaseEntry>("gjk"), .settings = {}};
  EXPECT_EQ(sample(gjk, input, sets, 0, 1).contacts, 1);
}

constexpr const char* mixed = R"(
generator = "uniform"
count = 60
frames = 2
overlaps = 6
shapes = [
  {type = "gear", teeth = 6, scale = 0.5},
  {type = "torus", around = 12, across = 6, as = "surface", scale = 0.5},
  "sphere",
  {type = "compound", parts = [{shape = {type = "box", half_extents = [0.5, 0.1, 0.1]}},
                               {shape = {type = "box", half_extents = [0.1, 0.5, 0.1]}}]},
]
)";

TEST(ConcavePairs, EachKindIsASetAndNoPairIsLost) {
  const scene::Scene scene = load_text(mixed);
  const BlockInput input(scene, scene::BoxKind::tight, true);
  constexpr std::array tasks = {record::QueryTask::intersect, record::QueryTask::penetration,
                                record::QueryTask::contacts};
  const std::vector<NarrowSet> sets = sets_of(input, tasks);
  std::set<std::string> kinds;
  std::size_t pairs = 0;
  for (const NarrowSet& set : sets) {
    EXPECT_TRUE(set.is_concave() ? record::concave_task(set.task).has_value()
                                 : record::narrow_task(set.task).has_value());
    if (set.task != record::QueryTask::intersect) continue;
    kinds.insert(set.kind_name());
    pairs += set.pairs();
  }
  EXPECT_EQ(pairs, input.frames[0].truth.size() + input.frames[1].truth.size());
  for (const char* kind : {"sphere-sphere", "mesh-mesh", "mesh-solid", "compound-compound",
                           "compound-sphere", "solid-sphere", "mesh-sphere", "compound-mesh"}) {
    EXPECT_TRUE(kinds.contains(kind)) << kind;
  }
}

TEST(ConcavePairs, TwoThreadsGiveTheSameAnswers) {
  const scene::Scene scene = load_text(mixed);
  const BlockInput input(scene, scene::BoxKind::tight, true);
  constexpr std::array tasks = {record::QueryTask::intersect, record::QueryTask::contacts};
  const std::vector<NarrowSet> sets = sets_of(input, tasks);
  std::int64_t hits = 0, misses = 0, parts = 0;
  for (std::uint32_t set = 0; set < sets.size(); ++set) {
    for (const NarrowChoice& choice : ours()) {
      if (offer(choice, sets[set], input) != Offer::taken) continue;
      const SampleReply one = sample(choice, input, sets, set, 1);
      const SampleReply two = sample(choice, input, sets, set, 2);
      EXPECT_EQ(one.outcome_hash, two.outcome_hash) << choice.label() << sets[set].kind_name();
      EXPECT_EQ(one.pair_hash, two.pair_hash);
      EXPECT_EQ(one.part_pairs, two.part_pairs);
      hits += one.contacts;
      misses += one.pairs - one.contacts;
      parts += std::max<std::int64_t>(one.part_pairs, 0);
    }
  }
  EXPECT_GT(hits, 0);
  EXPECT_GT(misses, 0);
  EXPECT_GT(parts, hits);
}

}  // namespace
}  // namespace touchstone::measure
