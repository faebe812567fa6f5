// The benchmarks: what they are given, and that all are there and run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "algorithms/registry.h"
#include "harness/bench/placed_pairs.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

// The program's standard output, or an empty string if it fails.
std::string bench(const std::string& arguments) {
  std::FILE* const pipe = popen((TOUCHSTONE_BENCH " " + arguments + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 4096> bytes;
  for (std::size_t got; (got = fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
    text.append(bytes.data(), got);
  }
  const int status = pclose(pipe);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : std::string();
}

// Adds the names that the filter takes. Google Benchmark's time for a list grows with its square, so
// it is asked for parts of it.
void add_listed(const std::string& filter, std::set<std::string>& names) {
  std::istringstream lines(bench("--benchmark_list_tests --benchmark_filter='" + filter + "'"));
  for (std::string line; std::getline(lines, line);) {
    // It adds how the time was taken.
    names.insert(line.substr(0, line.find("/manual_time")));
  }
}

std::set<std::string> listed() {
  std::set<std::string> names;
  add_listed("^(broad|kernels|meshes|oracle)/", names);
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>())
    add_listed("^narrow/" + std::string(entry.info.name) + "/", names);
  return names;
}

TEST(PlacedPairs, StandAtTheDistanceOfTheirRegime) {
  oracle::Oracle oracle;
  for (const char* name : {"sphere", "box", "cone", "hull-32", "icosphere-42"}) {
    for (const bench::PairRegime& regime : bench::pair_regimes()) {
      SCOPED_TRACE(std::string(name) + " " + std::string(regime.name));
      const bench::PlacedPairs pairs({bench::find_family(name), bench::find_family(name)}, regime);
      ASSERT_EQ(pairs.first.size(), bench::PlacedPairs::count);
      std::set<std::array<double, 3>> places;
      for (std::size_t i = 0; i < bench::PlacedPairs::count; ++i) {
        const std::uint32_t a = pairs.first[i], b = pairs.second[i];
        const oracle::Solid solid_a(pairs.shapes[pairs.shape_of[a]]);
        const oracle::Solid solid_b(pairs.shapes[pairs.shape_of[b]]);
        const double is =
            oracle.measure({solid_a, pairs.poses[a]}, {solid_b, pairs.poses[b]}).middle();
        EXPECT_NEAR(is, regime.distance, 2e-6 * std::abs(regime.distance));
        const Vec3d& at = pairs.poses[b].translation;
        places.insert({at.x(), at.y(), at.z()});
      }
      EXPECT_EQ(places.size(), bench::PlacedPairs::count);
    }
  }
}

TEST(PlacedPairs, HoldEveryTwoKindsAndEachFamilyOfHulls) {
  std::set<std::pair<ShapeKind, ShapeKind>> kinds;
  std::set<std::string> names;
  for (const bench::FamilyPair& pair : bench::family_pairs()) {
    EXPECT_LE(pair.a->kind, pair.b->kind);
    kinds.insert({pair.a->kind, pair.b->kind});
    EXPECT_TRUE(names.insert(pair.name()).second) << pair.name();
  }
  EXPECT_EQ(kinds.size(), all_shape_kinds.size() * (all_shape_kinds.size() + 1) / 2 - 1);
  for (const char* name : {"box-box", "sphere-box", "box-hull-32", "hull-8", "hull-32", "hull-128",
                           "hull-512", "icosphere-42", "icosphere-162", "hull-32-halfspace"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(Bench, ListsEveryRegisteredAlgorithm) {
  const std::set<std::string> names = listed();
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    for (const char* rest : {"/uniform/1000/build", "/clustered/10000/find-pairs",
                             "/mixed/1000/update", "/city/10000/find-pairs-updated"}) {
      EXPECT_EQ(names.contains("broad/" + entry.info.name + rest), is_built(entry.info))
          << entry.info.name << rest;
    }
  }
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    for (const Precision scalar : entry.scalars) {
      for (const Task task : entry.tasks) {
        for (const bench::FamilyPair& pair : bench::family_pairs()) {
          const bool offered =
              is_built(entry.info) && offers(entry, pair.a->kind, pair.b->kind, task);
          for (const bench::PairRegime& regime : bench::pair_regimes()) {
            const std::string name = "narrow/" + entry.info.name + "/" +
                                     std::string(to_string(scalar)) + "/" + pair.name() + "/" +
                                     std::string(to_string(task)) + "/" + std::string(regime.name);
            EXPECT_EQ(names.contains(name), offered && regime.fits(task)) << name;
          }
        }
      }
    }
  }
  for (const MidPhaseEntry& entry : registry::entries<MidPhaseEntry>()) {
    for (const char* rest : {"/torus-2000/build", "/trefoil-10000/refit"}) {
      EXPECT_TRUE(names.contains("meshes/mid/" + entry.info.name + rest)) << entry.info.name;
    }
  }
  for (const char* name :
       {"meshes/concave/fused/torus-2000/build", "meshes/ray/wide-bvh/trefoil-100000/build",
        "meshes/point/wide-bvh/trefoil-10000/build", "kernels/support/float/hull-128/coherent",
        "kernels/support/double/ellipsoid/random", "kernels/radix-sort/100000",
        "kernels/insertion-sort/1000", "kernels/box-scan/avx2/1000",
        "kernels/box-sweep/baseline/10000", "kernels/box-axes/float/gap-0.1",
        "oracle/verdict/box-box/1e-9", "oracle/depth/hull-128/-1e-3"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

TEST(Bench, RunsWhatTheFilterTakesAndWritesJson) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out.json";
  const std::string filter =
      "'^(broad/(naive|sweep-one-axis)/(uniform|city)/1000/|"
      "narrow/(gjk|sat|closed-form)/double/(box-box|sphere-box|capsule-capsule)/|"
      "kernels/(support/float/(box|hull-32)|radix-sort/1000$|insertion-sort/1000$|"
      "box-(scan|sweep)/baseline/1000|box-axes)|meshes/mid/[a-z-]+/torus-2000/|oracle/verdict/"
      "box-box/)'";
  bench("--benchmark_min_time=1e-6 --benchmark_filter=" + filter +
        " --benchmark_out_format=json --benchmark_out=" + out.string());
  std::ifstream file(out);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  int narrow = 0, broad = 0, kernels = 0;
  for (const auto& run : json.at("benchmarks")) {
    const auto name = run.at("name").get<std::string>();
    EXPECT_FALSE(run.contains("error_message")) << name;
    EXPECT_GT(run.at("real_time").get<double>(), 0) << name;
    narrow += name.starts_with("narrow/");
    broad += name.starts_with("broad/");
    kernels += name.starts_with("kernels/");
    if (name.starts_with("narrow/")) {
      EXPECT_EQ(run.at("wrong").get<double>(), 0) << name;
    }
    if (name.starts_with("broad/")) {
      EXPECT_GT(run.at("pairs").get<double>(), 100) << name;
    }
  }
  EXPECT_EQ(broad, 2 * 2 * 4);
  EXPECT_GT(narrow, 30);
  EXPECT_GT(kernels, 12);
}

TEST(Bench, RefusesWhatItDoesNotKnow) { EXPECT_EQ(bench("--no-such-option"), ""); }

TEST(Instructions, AreCountedTheSameTwice) {
  if (std::system("valgrind --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no valgrind";
  const TemporaryFolder folder;
  const std::string filter = "narrow/(gjk|sat)/double/box-box/intersect/(far|deep)";
  std::array<std::string, 2> counts;
  for (std::string& count : counts) {
    const std::string file = (folder.path() / "instructions.csv").string();
    bench("'--instructions=" + file + "' '--benchmark_filter=" + filter + "'");
    count = folder.read("instructions.csv");
    EXPECT_EQ(std::ranges::count(count, '\n'), 5) << count;
    EXPECT_THAT(count, testing::HasSubstr("narrow/gjk/double/box-box/intersect/deep,256,"));
  }
  EXPECT_EQ(counts[0], counts[1]);
}

TEST(Instructions, ABadRequestIsRefused) {
  EXPECT_EQ(std::system((TOUCHSTONE_BENCH " --instructions=x.csv --benchmark_filter=nothing/such "
                                          ">/dev/null 2>&1")),
            2 << 8);
  EXPECT_EQ(std::system((TOUCHSTONE_BENCH " --instructions=x.csv '--benchmark_filter=(' "
                                          ">/dev/null 2>&1")),
            2 << 8);
}

}  // namespace
}  // namespace touchstone
