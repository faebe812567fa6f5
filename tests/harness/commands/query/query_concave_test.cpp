// Tests of touchstone query with meshes and compounds.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

// Two triangles that cross, two that touch in a corner, two apart, and a ball over a compound.
constexpr const char* concave_cases =
    R"({"id":"cross","a":{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]}},)"
    R"("b":{"shape":{"type":"mesh","vertices":[[0.2,0.2,-1],[0.2,0.2,1],[1,1,1],[5,5,5]],"triangles":[[3,3,3],[0,1,2]]}}})"
    "\n"
    R"({"id":"touch","a":{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]}},)"
    R"("b":{"shape":{"type":"mesh","vertices":[[0,0,0],[-1,0,1],[0,-1,1]],"triangles":[[0,1,2]]},"translation":[1,0,0]}})"
    "\n"
    R"({"id":"apart","a":{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]}},)"
    R"("b":{"shape":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]],"triangles":[[0,1,2]]},"translation":[0,0,0.5]}})"
    "\n"
    R"({"id":"compound","a":{"shape":{"type":"compound","parts":[)"
    R"({"shape":{"type":"box","half_extents":[1,1,1]},"translation":[-2,0,0]},)"
    R"({"shape":{"type":"box","half_extents":[1,1,1]},"translation":[2,0,0]}]}},)"
    R"("b":{"shape":{"type":"sphere","radius":1},"translation":[2,0,2]}})"
    "\n";

class ConcaveQueryCommand : public ::testing::Test {
 protected:
  Ran run(const std::string& more, const std::string& cases = concave_cases) {
    const auto file = folder.write("in.jsonl", cases);
    return run_program("query " + file.string() + " --out " + (folder.path() / "out.csv").string() +
                       " " + more);
  }
  std::vector<std::vector<std::string>> rows(const std::vector<std::string>& columns,
                                             const char* file = "out.csv") {
    return read_rows(folder.path() / file, columns);
  }
  TemporaryFolder folder;
};

TEST_F(ConcaveQueryCommand, CertificatesAreSavedAndVerified) {
  const std::string proofs = (folder.path() / "proofs.jsonl").string();
  for (const std::string task : {"intersect", "distance", "contacts"}) {
    const Ran saved = run("--narrow fused --task " + task + " --save-certificates " + proofs);
    ASSERT_EQ(saved.status, 0) << saved.text;
    EXPECT_THAT(saved.text, HasSubstr("4 certificates in"));
    const Ran verified = run_program("query --certificates " + proofs);
    EXPECT_EQ(verified.status, 0) << verified.text;
    EXPECT_THAT(verified.text, HasSubstr("4 certificates verified, 0 refused"));
  }
  std::string text = folder.read("proofs.jsonl");
  const auto place = text.find("\"answer\":\"separated\"");
  ASSERT_NE(place, std::string::npos);
  const auto changed =
      folder.write("changed.jsonl", text.replace(place, 20, "\"answer\":\"unknown\""));
  const Ran refused = run_program("query --certificates " + changed.string());
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.text, HasSubstr("changed.jsonl:3: apart: "));
  EXPECT_THAT(refused.text, HasSubstr("3 certificates verified, 1 refused"));
  const auto broken = folder.write("broken.jsonl", R"({"id":"x"})");
  EXPECT_THAT(run_program("query --certificates " + broken.string()).text,
              HasSubstr("broken.jsonl:1: no \"a\""));
  EXPECT_EQ(run_program("query --certificates " + proofs + " --narrow fused").status, 2);
}

// Exact distances take very long where every triangle may be the nearest one to rounding.
TEST_F(ConcaveQueryCommand, CertificatesThatTakeTooLongAreLeftOut) {
  std::string vertices, triangles;
  constexpr int side = 20;
  for (int i = 0; i <= side * side; ++i) {
    vertices += fmt::format("{}[{},{},{}]", i > 0 ? "," : "", i % side, i / side, i % 7);
    if (i > 1) triangles += fmt::format("{}[{},{},{}]", i > 2 ? "," : "", i - 2, i - 1, i);
  }
  const std::string surface =
      R"("shape":{"type":"mesh","vertices":[)" + vertices + R"(],"triangles":[)" + triangles + "]}";
  const std::string ball = R"("shape":{"type":"sphere","radius":1})";
  const auto apart = [](const std::string& id, const std::string& shape, const std::string& x) {
    return R"({"id":")" + id + R"(","a":{)" + shape + R"(},"b":{)" + shape + R"(,"translation":[)" +
           x + ",0,0]}}\n";
  };
  const std::string proofs = (folder.path() / "proofs.jsonl").string();
  const Ran saved =
      run("--narrow fused --task distance --time-limit 1 --save-certificates " + proofs,
          apart("first", ball, "3") + apart("huge", surface, "1e300") + apart("last", ball, "4"));
  EXPECT_EQ(saved.status, 0) << saved.text;
  EXPECT_THAT(saved.text, HasSubstr("certificates, case 'huge': no answer in time"));
  EXPECT_THAT(saved.text, HasSubstr("2 certificates in"));
  EXPECT_THAT(run_program("query --certificates " + proofs).text,
              HasSubstr("2 certificates verified, 0 refused"));
}

// Convex cases have them too, but not for a depth.
TEST_F(ConcaveQueryCommand, CertificatesOfConvexCases) {
  const std::string balls = R"({"id":"balls","a":{"shape":{"type":"sphere","radius":1}},)"
                            R"("b":{"shape":{"type":"sphere","radius":1},"translation":[2,0,0]}})";
  const std::string proofs = (folder.path() / "proofs.jsonl").string();
  const std::string save = " --save-certificates " + proofs;
  for (const std::string task : {"intersect", "distance"}) {
    const Ran saved = run("--narrow certified --task " + task + save, balls);
    ASSERT_EQ(saved.status, 0) << saved.text;
    EXPECT_EQ(run_program("query --certificates " + proofs).status, 0);
  }
  const Ran depth = run("--narrow certified --task penetration" + save, balls);
  EXPECT_EQ(depth.status, 2);
  EXPECT_THAT(depth.text, HasSubstr("--save-certificates was given with --task penetration"));
}

TEST_F(ConcaveQueryCommand, Contacts) {
  const Ran ran = run("--narrow fused,part-pairs,exact --task contacts --pairs " +
                      (folder.path() / "pairs.csv").string());
  ASSERT_EQ(ran.status, 0) << ran.text;
  std::string header;
  std::getline(std::ifstream(folder.path() / "out.csv"), header);
  EXPECT_EQ(header,
            "id,algorithm,scalar,task,answer,status,distance,lower,upper,normal_x,normal_y,"
            "normal_z,a_x,a_y,a_z,b_x,b_y,b_z,iterations,support_calls,pair_count,pair_hash");
  const auto all = rows({"id", "algorithm", "answer", "status", "pair_count", "pair_hash"});
  ASSERT_EQ(all.size(), 12u);
  const std::vector<std::string> answers = {"overlapping", "overlapping", "separated",
                                            "overlapping"};
  const std::vector<std::string> hashes = {"910a2dec89025cc1", "e220a8397b1dcdaf",
                                           "0000000000000000", ""};
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i][2], answers[i / 3]) << all[i][1];
    EXPECT_EQ(all[i][3], "ok");
    EXPECT_EQ(all[i][4], answers[i / 3] == "separated" ? "0" : "1");
    if (!hashes[i / 3].empty()) {
      EXPECT_EQ(all[i][5], hashes[i / 3]);
    }
  }
  const auto pairs = rows({"id", "algorithm", "a_part", "b_part"}, "pairs.csv");
  ASSERT_EQ(pairs.size(), 9u);
  EXPECT_EQ(pairs[0], (std::vector<std::string>{"cross", "fused", "0", "1"}));
  EXPECT_EQ(pairs[8], (std::vector<std::string>{"compound", "exact", "1", "0"}));
}

TEST_F(ConcaveQueryCommand, ContactsWithDepths) {
  const Ran ran = run("--narrow fused,exact --task contacts --contacts " +
                      (folder.path() / "contacts.csv").string());
  ASSERT_EQ(ran.status, 0) << ran.text;
  // The oracle has none; a ball touches the second of two boxes.
  const auto contacts = rows(
      {"id", "algorithm", "a_part", "b_part", "status", "depth", "normal_z", "point_x", "point_z"},
      "contacts.csv");
  ASSERT_EQ(contacts.size(), 3u);
  EXPECT_EQ(contacts[2],
            (std::vector<std::string>{"compound", "fused", "1", "0", "ok", "0", "1", "2", "1"}));
}

TEST_F(ConcaveQueryCommand, EveryMidPhaseAndAlgorithm) {
  for (const MidPhaseEntry& mid : registry::entries<MidPhaseEntry>()) {
    const Ran ran = run("--narrow all --task intersect --mid " + mid.info.name);
    ASSERT_EQ(ran.status, 0) << ran.text;
    for (const auto& row : rows({"id", "algorithm", "answer", "status"})) {
      const ConcaveEntry* entry = registry::find<ConcaveEntry>(row[1]);
      ASSERT_NE(entry, nullptr);
      if (entry->info.origin == Origin::peer) continue;
      if (entry->approximate) {
        EXPECT_TRUE(row[3] == "not_reported" || row[3] == "unsupported") << row[0] << " " << row[3];
        continue;
      }
      EXPECT_EQ(row[2], row[0] == "apart" ? "separated" : "overlapping") << row[0] << " " << row[1];
      EXPECT_EQ(row[3], "ok");
    }
  }
}

TEST_F(ConcaveQueryCommand, Distance) {
  const Ran ran = run("--narrow fused,exact --task distance");
  ASSERT_EQ(ran.status, 0) << ran.text;
  const auto all = rows({"id", "algorithm", "distance", "normal_z", "status"});
  ASSERT_EQ(all.size(), 8u);
  EXPECT_EQ(all[4], (std::vector<std::string>{"apart", "fused", "0.5", "1", "ok"}));
  EXPECT_EQ(all[5][2], "0.5");
  EXPECT_EQ(all[0][2], "");
}

// Two convex bodies go to narrow phases, unless a name or the task is that of concave ones.
TEST_F(ConcaveQueryCommand, ConvexCases) {
  const std::string convex =
      R"({"id":"x","a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"sphere","radius":1},"translation":[3,0,0]}})";
  ASSERT_EQ(run("--narrow exact --task penetration", convex).status, 0);
  ASSERT_EQ(run("--narrow fused --task distance", convex).status, 0);
  EXPECT_EQ(rows({"distance"}).at(0).at(0), "1");
  ASSERT_EQ(run("--narrow exact --task contacts", convex).status, 0);
  EXPECT_EQ(rows({"pair_count"}).at(0).at(0), "0");
}

TEST_F(ConcaveQueryCommand, Faults) {
  const auto fault = [&](const std::string& more) {
    const Ran ran = run(more);
    EXPECT_EQ(ran.status, 2);
    return ran.text;
  };
  EXPECT_THAT(fault("--narrow gjk --task intersect"),
              HasSubstr("no concave phase is called 'gjk'"));
  EXPECT_THAT(fault("--narrow fused --task penetration"),
              HasSubstr("expected intersect, distance"));
  EXPECT_THAT(fault("--narrow fused --task contacts --mid tree"),
              HasSubstr("no mid-phase is called 'tree'"));
  EXPECT_THAT(fault("--narrow fused --task contacts --parts x"),
              HasSubstr("no narrow phase is called 'x'"));
  EXPECT_THAT(fault("--narrow fused --task intersect --pairs p.csv"),
              HasSubstr("--pairs was given"));
  EXPECT_THAT(fault("--narrow fused --task distance --contacts c.csv"),
              HasSubstr("--contacts was given"));
}

}  // namespace
}  // namespace touchstone
