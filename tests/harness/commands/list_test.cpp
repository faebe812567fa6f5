// Tests of touchstone list.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

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
  ASSERT_EQ(rows.size(), broad_phases().size() + narrow_phases().size() +
                             contact_manifolds().size() + ray_casts().size() +
                             point_queries().size());
  std::set<std::pair<std::string, std::string>> names;
  for (const auto& row : rows) {
    EXPECT_TRUE(names.insert({row[1], row[0]}).second) << row[0];
    ASSERT_TRUE(row[1] == "broad" || row[1] == "narrow" || row[1] == "manifold" ||
                row[1] == "ray" || row[1] == "point");
    const AlgorithmInfo& info = row[1] == "broad"    ? find_broad_phase(row[0])->info
                                : row[1] == "narrow" ? find_narrow_phase(row[0])->info
                                : row[1] == "ray"    ? find_ray_cast(row[0])->info
                                : row[1] == "point"  ? find_point_query(row[0])->info
                                                     : find_contact_manifold(row[0])->info;
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
  }
  for (const ManifoldEntry& entry : contact_manifolds()) {
    EXPECT_THAT(ran.text, HasSubstr(entry.info.name));
  }
  for (const RayCastEntry& entry : ray_casts()) {
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
