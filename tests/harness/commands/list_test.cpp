// Tests of touchstone list.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

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
  registry::for_each_kind([&]<class Entry>() {
    for (const Entry& entry : registry::entries<Entry>()) {
      infos[{std::string(kind_words<Entry>.word), entry.info.name}] = &entry.info;
    }
  });
  std::set<std::pair<std::string, std::string>> names;
  std::size_t adapters = 0;
  for (const auto& row : rows) {
    EXPECT_TRUE(names.insert({row[1], row[0]}).second) << row[0];
    if (row[0].find('@') != std::string::npos) {
      ++adapters;
      EXPECT_EQ(row[3], "false") << "no --with asks " << row[0];
      EXPECT_THAT(row[4], ::testing::AnyOf(StartsWith("not installed: npm ci --ignore-scripts "),
                                           StartsWith("not installed: apt-get install python3-"),
                                           StartsWith("not installed: python3 -m venv "),
                                           "`--peer " + row[0] + "` asks it"));
      continue;
    }
    ASSERT_TRUE(infos.contains({row[1], row[0]})) << row[1] << " " << row[0];
    const AlgorithmInfo& info = *infos[{row[1], row[0]}];
    EXPECT_EQ(row[2], to_string(info.origin));
    EXPECT_EQ(row[3], is_built(info) ? "true" : "false");
    EXPECT_EQ(row[4], is_built(info) ? info.lacking : info.reason);
    EXPECT_EQ(row[7], info.citation);
    if (row[1] == "box") {
      EXPECT_EQ(row[5], "pairs");
      EXPECT_EQ(row[6], "float");
    }
    if (row[1] == "manifold") {
      EXPECT_EQ(row[5], "manifold");
    }
    if (row[1] == "feature") {
      EXPECT_EQ(row[5], "vertex-face;edge-edge");
    }
  }
  EXPECT_GT(adapters, 10U);
  EXPECT_EQ(rows.size(), infos.size() + adapters);
}

// Returns the names of algorithms, without adapters, in the rows that `list --format csv` prints with these options.
std::vector<std::string> names_of(const std::string& options) {
  const Ran ran = run_program("list --format csv" + options);
  EXPECT_EQ(ran.status, 0) << ran.text;
  const TemporaryFolder folder;
  std::vector<std::string> names;
  for (const auto& row : read_rows(folder.write("list.csv", ran.text), {"name"})) {
    if (row[0].find('@') == std::string::npos) names.push_back(row[0]);
  }
  return names;
}

TEST(ListCommand, AKindIsListedByItsWordAndByItsOtherWords) {
  std::size_t all = 0;
  registry::for_each_kind([&]<class Entry>() {
    std::vector<std::string> names;
    for (const Entry& entry : registry::entries<Entry>()) names.push_back(entry.info.name);
    all += names.size();
    EXPECT_EQ(names_of(fmt::format(" --kind {}", kind_words<Entry>.word)), names);
  });
  EXPECT_EQ(names_of("").size(), all);
  EXPECT_EQ(names_of(" --kind broad"), names_of(" --kind box"));
  EXPECT_EQ(names_of(" --kind narrow"), names_of(" --kind pair"));
  EXPECT_EQ(names_of(" --kind mid"), names_of(" --kind mid-phase"));
  EXPECT_EQ(names_of(" --kind concave"), names_of(" --kind mesh"));
  EXPECT_EQ(names_of(" --kind ccd"), names_of(" --kind feature"));
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
  const Ran unknown = run_program("list --kind sphere");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.text, HasSubstr("no kind is called 'sphere'; expected one of box, pair,"));
  EXPECT_EQ(run_program("").status, 2);
  EXPECT_EQ(run_program("lists").status, 2);
  EXPECT_EQ(run_program("list >/dev/full").status,
            2);  // its message cannot be written either
}

}  // namespace
}  // namespace touchstone
