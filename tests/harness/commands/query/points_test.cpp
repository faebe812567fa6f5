// Tests of touchstone query with points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

const std::vector<std::string> columns_of_points = {
    "point", "algorithm", "task", "side", "distance", "triangle", "x", "y", "z", "status"};
const std::string tetrahedron =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(PointsCommand, OneRowForEachPointAndQuery) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("tetrahedron.obj", tetrahedron);
  const auto points = folder.write("points.csv", "x,y,z\n1,1,-2\n0.5,0.5,0.25\n1,1,0\n");
  const auto out = folder.path() / "out.csv";
  const std::string asked =
      "query " + points.string() + " --in " + mesh.string() + " --out " + out.string();
  Ran ran = run_program(asked);
  EXPECT_EQ(ran.status, 0) << ran.text;
  auto rows = read_rows(out, columns_of_points);
  ASSERT_GE(rows.size(), 6u);
  for (const auto& row : rows) {
    EXPECT_EQ(row[2], "closest");
    EXPECT_EQ(row[4], row[0] == "0" ? "2" : row[0] == "1" ? "0.25" : "0");
    EXPECT_TRUE(row[9] == "ok" || row[9] == "not_reported") << row[1];
  }
  ran = run_program(asked + " --task side");
  EXPECT_EQ(ran.status, 0) << ran.text;
  for (const auto& row : read_rows(out, columns_of_points)) {
    EXPECT_EQ(row[9] == "unsupported", row[1] == "embree");
  }
  ran = run_program(asked + " --task side --with wide-bvh,exact");
  EXPECT_EQ(ran.status, 0) << ran.text;
  rows = read_rows(out, columns_of_points);
  ASSERT_EQ(rows.size(), 6u);
  for (const auto& row : rows) {
    EXPECT_EQ(row[3], row[0] == "0" ? "outside" : row[0] == "1" ? "inside" : "surface");
  }
}

TEST(PointsCommand, CertificatesAreSavedAndVerified) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("tetrahedron.obj", tetrahedron);
  const auto points = folder.write("points.csv", "x,y,z\n1,1,-2\n0.5,0.5,0.25\n1,1,0\n");
  const std::string proofs = (folder.path() / "proofs.jsonl").string();
  const std::string asked = "query " + points.string() + " --in " + mesh.string() + " --out " +
                            (folder.path() / "out.csv").string() +
                            " --with wide-bvh --save-certificates " + proofs;
  for (const std::string task : {"closest", "side"}) {
    const Ran saved = run_program(asked + " --task " + task);
    EXPECT_EQ(saved.status, 0) << saved.text;
    EXPECT_THAT(saved.text, ::testing::HasSubstr("3 certificates in"));
    const Ran verified = run_program("query --certificates " + proofs);
    EXPECT_EQ(verified.status, 0) << verified.text;
    EXPECT_THAT(verified.text, ::testing::HasSubstr("3 certificates verified, 0 refused"));
  }
  std::string text = folder.read("proofs.jsonl");
  const auto place = text.find("\"winding\":1");
  ASSERT_NE(place, std::string::npos);
  const auto changed = folder.write("changed.jsonl", text.replace(place, 11, "\"winding\":2"));
  const Ran refused = run_program("query --certificates " + changed.string());
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.text, ::testing::HasSubstr("changed.jsonl:3: point 1: "));
  EXPECT_THAT(refused.text, ::testing::HasSubstr("2 certificates verified, 1 refused"));
  EXPECT_EQ(run_program("query --certificates " + proofs + " --task side").status, 2);
  EXPECT_THAT(run_program("query --in " + mesh.string()).text,
              ::testing::HasSubstr("FILE is missing; expected it, or --certificates alone"));
  EXPECT_THAT(run_program("query " + points.string()).text,
              ::testing::HasSubstr("--in is missing; expected the mesh"));
}

TEST(PointsCommand, WrongRequests) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("tetrahedron.obj", tetrahedron);
  const auto points = folder.write("points.csv", "x,y,z\n1,nan,-2\n");
  const std::string end = " --out " + (folder.path() / "out.csv").string();
  Ran ran = run_program("query " + points.string() + " --in " + mesh.string() + end);
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, ::testing::HasSubstr("finite"));
  ran = run_program("query " + points.string() + " --in " + mesh.string() + " --with nobody" + end);
  EXPECT_EQ(ran.status, 2);
  const auto open = folder.write("open.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 3 2\n");
  folder.write("points.csv", "x,y,z\n1,1,-2\n");
  const std::string asked = "query " + points.string() + " --in " + open.string() + end;
  EXPECT_EQ(run_program(asked).status, 0);
  ran = run_program(asked + " --task side");
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, ::testing::HasSubstr("open.obj: the surface is open at the edge from"));
}

}  // namespace
}  // namespace touchstone
