// Tests of touchstone list.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ListCommand, CsvHasOneRowForEachAlgorithm) {
  const Ran ran = run_program("list --format csv");
  EXPECT_EQ(ran.status, 0);
  EXPECT_THAT(ran.text, StartsWith("name,kind,origin,built,reason,tasks,scalars,citation\n"));
  const TemporaryFolder folder;
  const auto rows =
      read_rows(folder.write("list.csv", ran.text),
                {"name", "kind", "origin", "built", "reason", "tasks", "scalars", "citation"});
  std::map<std::pair<std::string, std::string>, const AlgorithmInfo*> infos;
  const auto expect_all = [&](const std::string& kind, const auto& entries) {
    for (const auto& entry : entries) infos[{kind, entry.info.name}] = &entry.info;
  };
  expect_all("broad", broad_phases());
  expect_all("narrow", narrow_phases());
  expect_all("manifold", contact_manifolds());
  expect_all("ray", ray_casts());
  expect_all("scene-ray", scene_ray_casts());
  expect_all("point", point_queries());
  expect_all("mid", mid_phases());
  expect_all("concave", concave_phases());
  expect_all("cast", casts());
  expect_all("ccd", ccds());
  ASSERT_EQ(rows.size(), infos.size());
  std::set<std::pair<std::string, std::string>> names;
  for (const auto& row : rows) {
    EXPECT_TRUE(names.insert({row[1], row[0]}).second) << row[0];
    ASSERT_TRUE(infos.contains({row[1], row[0]})) << row[1] << " " << row[0];
    const AlgorithmInfo& info = *infos[{row[1], row[0]}];
    EXPECT_EQ(row[2], to_string(info.origin));
    EXPECT_EQ(row[3], is_built(info) ? "true" : "false");
    EXPECT_EQ(row[4], is_built(info) ? info.lacking : info.reason);
    EXPECT_EQ(row[7], info.citation);
    if (row[1] == "broad") {
      EXPECT_EQ(row[5], "pairs");
      EXPECT_EQ(row[6], "float");
    }
    if (row[1] == "manifold") {
      EXPECT_EQ(row[5], "manifold");
    }
    if (row[1] == "ccd") {
      EXPECT_EQ(row[5], "vertex-face;edge-edge");
    }
  }
}

TEST(ListCommand, TableNamesEveryAlgorithm) {
  const Ran ran = run_program("list");
  EXPECT_EQ(ran.status, 0);
  for (const BroadPhaseEntry& entry : broad_phases()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
    if (!is_built(entry.info)) {
      EXPECT_THAT(ran.text, HasSubstr("not built, because " + entry.info.reason));
    }
  }
  for (const NarrowPhaseEntry& entry : narrow_phases()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
    if (!entry.tolerance.empty()) {
      EXPECT_THAT(ran.text, HasSubstr("tolerance: " + entry.tolerance));
    }
  }
  for (const ManifoldEntry& entry : contact_manifolds()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  }
  for (const RayCastEntry& entry : ray_casts()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  }
  for (const CastEntry& entry : casts()) EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  for (const ConcaveEntry& entry : concave_phases()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  }
}

TEST(ListCommand, WrongRequests) {
  EXPECT_EQ(run_program("list --format xml").status, 2);
  EXPECT_EQ(run_program("list more").status, 2);
  EXPECT_EQ(run_program("").status, 2);
  EXPECT_EQ(run_program("lists").status, 2);
  EXPECT_EQ(run_program("list >/dev/full").status,
            2);  // its message cannot be written either
}

}  // namespace
}  // namespace touchstone
