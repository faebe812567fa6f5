// Tests of what each algorithm declares in the registry.
#include "algorithms/registry.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace {

using namespace touchstone;

template <class Entry>
void check_info(std::span<const Entry> entries) {
  static const std::regex form("[a-z0-9]+(-[a-z0-9]+)*");
  std::set<std::string> names;
  for (const Entry& entry : entries) {
    const AlgorithmInfo& info = entry.info;
    EXPECT_TRUE(names.insert(info.name).second) << info.name << " is there twice";
    EXPECT_TRUE(std::regex_match(info.name, form)) << info.name;
    EXPECT_NE(info.name, "all");
    EXPECT_NE(info.name, "none");
    EXPECT_NE(info.name, "ours");
    EXPECT_NE(info.name, "peers");
    EXPECT_FALSE(info.citation.empty()) << info.name;
    EXPECT_EQ(is_built(info), static_cast<bool>(entry.make)) << info.name;
    EXPECT_EQ(info.citation.find('\n'), std::string::npos) << info.name;
    EXPECT_TRUE(info.origin != Origin::ours || is_built(info)) << info.name;
  }
}

TEST(Registry, BroadPhasesAreWellDescribed) { check_info(registry::entries<BroadPhaseEntry>()); }

TEST(Registry, NarrowPhasesAreWellDescribed) {
  check_info(registry::entries<NarrowPhaseEntry>());
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
    EXPECT_EQ(entry.tolerance.find('\n'), std::string::npos) << entry.info.name;
  }
}

TEST(Registry, ContactManifoldsAreWellDescribed) {
  check_info(registry::entries<ManifoldEntry>());
  for (const ManifoldEntry& entry : registry::entries<ManifoldEntry>()) {
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
    EXPECT_TRUE(offers(entry, ShapeKind::box, ShapeKind::box)) << entry.info.name;
  }
}

TEST(Registry, RayCastsAreWellDescribed) {
  check_info(registry::entries<RayCastEntry>());
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    EXPECT_TRUE(offers(entry, RayTask::closest)) << entry.info.name;
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
  }
}

TEST(Registry, SceneRayCastsAreWellDescribed) {
  check_info(registry::entries<SceneRayCastEntry>());
  for (const SceneRayCastEntry& entry : registry::entries<SceneRayCastEntry>()) {
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
  }
}

TEST(Registry, MidPhasesAndConcavePhasesAreWellDescribed) {
  check_info(registry::entries<MidPhaseEntry>());
  check_info(registry::entries<ConcaveEntry>());
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    const bool in_float = offers(entry, ConcaveTask::intersect, Precision::float32);
    EXPECT_TRUE(offers(entry, ConcaveTask::intersect, Precision::float64) ||
                (entry.info.origin == Origin::peer && in_float))
        << entry.info.name;
  }
}

TEST(Registry, CastsAreWellDescribed) {
  check_info(registry::entries<CastEntry>());
  for (const CastEntry& entry : registry::entries<CastEntry>()) {
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
    EXPECT_TRUE(offers(entry, ShapeKind::sphere, ShapeKind::sphere, false) ||
                offers(entry, ShapeKind::hull, ShapeKind::hull, false))
        << entry.info.name;
    EXPECT_EQ(offers(entry, ShapeKind::hull, ShapeKind::box, true),
              offers(entry, ShapeKind::box, ShapeKind::hull, true))
        << entry.info.name;
  }
}

TEST(Registry, PointQueriesAreWellDescribed) {
  check_info(registry::entries<PointQueryEntry>());
  for (const PointQueryEntry& entry : registry::entries<PointQueryEntry>())
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
}

TEST(Registry, ContinuousCollisionIsWellDescribed) { check_info(registry::entries<CcdEntry>()); }

TEST(Registry, FindsByNameAndOnlyWhatIsThere) {
  registry::for_each_kind([]<class Entry>() {
    for (const Entry& entry : registry::entries<Entry>()) {
      EXPECT_EQ(registry::find<Entry>(entry.info.name), &entry);
    }
    EXPECT_EQ(registry::find<Entry>("no such"), nullptr);
    EXPECT_EQ(registry::find<Entry>(""), nullptr);
  });
}

TEST(Registry, AWordNamesOneKind) {
  std::set<std::string_view> words;
  std::vector<std::string_view> kinds;
  registry::for_each_kind([&]<class Entry>() {
    const KindWords& kind = kind_words<Entry>;
    EXPECT_FALSE(registry::entries<Entry>().empty()) << kind.word;
    EXPECT_FALSE(kind.title.empty()) << kind.word;
    kinds.push_back(kind.word);
    std::vector<std::string_view> all(kind.other.begin(), kind.other.end());
    all.push_back(kind.word);
    for (const std::string_view word : all) {
      if (word.empty()) continue;
      EXPECT_TRUE(words.insert(word).second) << word << " names two kinds";
      const auto named = registry::kind_named(word);
      ASSERT_TRUE(named) << word;
      EXPECT_EQ(named->word, kind.word);
    }
  });
  EXPECT_EQ(kinds, (std::vector<std::string_view>{"box", "pair", "manifold", "ray", "scene-ray",
                                                  "point", "mid-phase", "mesh", "cast", "feature",
                                                  "configuration"}));
  EXPECT_FALSE(registry::kind_named(""));
  EXPECT_FALSE(registry::kind_named("sphere"));
}

TEST(Registry, OffersAskForTheKindsInEitherOrder) {
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    for (const ShapeKind a : all_shape_kinds) {
      for (const ShapeKind b : all_shape_kinds) {
        for (const Task task : entry.tasks) {
          EXPECT_EQ(offers(entry, a, b, task), offers(entry, b, a, task)) << entry.info.name;
        }
      }
    }
  }
}

}  // namespace
