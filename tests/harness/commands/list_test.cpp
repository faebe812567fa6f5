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
  expect_all("broad", registry::entries<BroadPhaseEntry>());
  expect_all("narrow", registry::entries<NarrowPhaseEntry>());
  expect_all("manifold", registry::entries<ManifoldEntry>());
  expect_all("ray", registry::entries<RayCastEntry>());
  expect_all("scene-ray", registry::entries<SceneRayCastEntry>());
  expect_all("point", registry::entries<PointQueryEntry>());
  expect_all("mid", registry::entries<MidPhaseEntry>());
  expect_all("concave", registry::entries<ConcaveEntry>());
  expect_all("cast", registry::entries<CastEntry>());
  expect_all("ccd", registry::entries<CcdEntry>());
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
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
    if (!is_built(entry.info)) {
      EXPECT_THAT(ran.text, HasSubstr("not built, because " + entry.info.reason));
    }
  }
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
    if (!entry.tolerance.empty()) {
      EXPECT_THAT(ran.text, HasSubstr("tolerance: " + entry.tolerance));
    }
  }
  for (const ManifoldEntry& entry : registry::entries<ManifoldEntry>()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  }
  for (const RayCastEntry& entry : registry::entries<RayCastEntry>()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  }
  for (const CastEntry& entry : registry::entries<CastEntry>())
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
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
