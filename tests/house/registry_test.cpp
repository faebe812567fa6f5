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

TEST(Registry, BroadPhasesAreWellDescribed) { check_info(broad_phases()); }

TEST(Registry, NarrowPhasesAreWellDescribed) {
  check_info(narrow_phases());
  for (const NarrowPhaseEntry& entry : narrow_phases()) {
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
  }
}

TEST(Registry, ContactManifoldsAreWellDescribed) {
  check_info(contact_manifolds());
  for (const ManifoldEntry& entry : contact_manifolds()) {
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
    EXPECT_TRUE(offers(entry, ShapeKind::box, ShapeKind::box)) << entry.info.name;
  }
}

TEST(Registry, RayCastsAreWellDescribed) {
  check_info(ray_casts());
  for (const RayCastEntry& entry : ray_casts()) {
    EXPECT_TRUE(offers(entry, RayTask::closest)) << entry.info.name;
    EXPECT_FALSE(entry.scalars.empty()) << entry.info.name;
  }
}

TEST(Registry, PointQueriesAreWellDescribed) {
  check_info(point_queries());
  for (const PointQueryEntry& entry : point_queries()) {
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
    EXPECT_EQ(find_point_query(entry.info.name), &entry);
  }
  EXPECT_EQ(find_point_query("gjk"), nullptr);
}

TEST(Registry, FindsByNameAndOnlyWhatIsThere) {
  for (const BroadPhaseEntry& entry : broad_phases()) {
    EXPECT_EQ(find_broad_phase(entry.info.name), &entry);
  }
  for (const NarrowPhaseEntry& entry : narrow_phases()) {
    EXPECT_EQ(find_narrow_phase(entry.info.name), &entry);
  }
  for (const ManifoldEntry& entry : contact_manifolds()) {
    EXPECT_EQ(find_contact_manifold(entry.info.name), &entry);
  }
  for (const RayCastEntry& entry : ray_casts()) {
    EXPECT_EQ(find_ray_cast(entry.info.name), &entry);
  }
  EXPECT_EQ(find_ray_cast("gjk"), nullptr);
  EXPECT_EQ(find_contact_manifold("gjk"), nullptr);
  EXPECT_EQ(find_broad_phase("no such"), nullptr);
  EXPECT_EQ(find_narrow_phase(""), nullptr);
}

TEST(Registry, OffersAskForTheKindsInEitherOrder) {
  for (const NarrowPhaseEntry& entry : narrow_phases()) {
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
