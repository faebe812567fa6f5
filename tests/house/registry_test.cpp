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
    EXPECT_EQ(entry.tolerance.find('\n'), std::string::npos) << entry.info.name;
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

TEST(Registry, SceneRayCastsAreWellDescribed) {
  check_info(scene_ray_casts());
  for (const SceneRayCastEntry& entry : scene_ray_casts()) {
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
  }
}

TEST(Registry, MidPhasesAndConcavePhasesAreWellDescribed) {
  check_info(mid_phases());
  check_info(concave_phases());
  for (const ConcaveEntry& entry : concave_phases()) {
    const bool in_float = offers(entry, ConcaveTask::intersect, Precision::float32);
    EXPECT_TRUE(offers(entry, ConcaveTask::intersect, Precision::float64) ||
                (entry.info.origin == Origin::peer && in_float))
        << entry.info.name;
  }
}

TEST(Registry, CastsAreWellDescribed) {
  check_info(casts());
  for (const CastEntry& entry : casts()) {
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
  check_info(point_queries());
  for (const PointQueryEntry& entry : point_queries())
    EXPECT_FALSE(entry.tasks.empty()) << entry.info.name;
}

TEST(Registry, ContinuousCollisionIsWellDescribed) { check_info(ccds()); }

// Each entry of a list is found by its name.
template <class Entry>
void expect_found(std::span<const Entry> entries, const Entry* (*find)(std::string_view)) {
  for (const Entry& entry : entries) EXPECT_EQ(find(entry.info.name), &entry);
  EXPECT_EQ(find("no such"), nullptr);
  EXPECT_EQ(find(""), nullptr);
}

TEST(Registry, FindsByNameAndOnlyWhatIsThere) {
  expect_found(broad_phases(), find_broad_phase);
  expect_found(narrow_phases(), find_narrow_phase);
  expect_found(contact_manifolds(), find_contact_manifold);
  expect_found(ray_casts(), find_ray_cast);
  expect_found(scene_ray_casts(), find_scene_ray_cast);
  expect_found(point_queries(), find_point_query);
  expect_found(mid_phases(), find_mid_phase);
  expect_found(concave_phases(), find_concave_phase);
  expect_found(casts(), find_cast);
  expect_found(ccds(), find_ccd);
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
