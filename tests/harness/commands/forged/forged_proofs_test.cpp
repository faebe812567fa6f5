// Proofs that were made up, of what is not so, and numbers of questions that are not theirs.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* flat = R"("rotation":[1,0,0,0,1,0,0,0,0])";

std::string halfspace(double z, double offset, const std::string& more) {
  return fmt::format(R"({{"shape":{{"type":"halfspace","normal":[0,0,{}],"offset":{}}}{}{}}})", z,
                     offset, more.empty() ? "" : ",", more);
}

std::string cast_proof(const std::string& a, const std::string& b, const std::string& claim) {
  return fmt::format(
      R"({{"id":"x","a":{},"b":{},{},"generators_a":[],"generators_b":[],"closest":[],)"
      R"("surface":{{"points":[],"triangles":[]}},"feature":[],"polynomial":["0","0","0"]}})"
      "\n",
      a, b, claim);
}

const std::string hit_at_once = R"("answer":"hit","lower":["0","1"],"upper":["0","1"],"planes":[])";

class ForgedProofs : public ::testing::Test {
 protected:
  Ran verify(const std::string& command, const std::string& text) {
    const auto file = folder.write("proofs.jsonl", text);
    return run_program(command + " --certificates " + file.string());
  }
  void expect_refused(const Ran& ran, const std::string& why) {
    EXPECT_EQ(ran.status, 1) << ran.text;
    EXPECT_THAT(ran.text, HasSubstr(why));
    EXPECT_THAT(ran.text, HasSubstr("0 certificates verified, 1 refused"));
  }
  TemporaryFolder folder;
};

// Both matrices flatten a half-space to a plane, or one does; the planes are metres apart.
TEST_F(ForgedProofs, SingularHalfSpacesDoNotMeet) {
  const std::string singular = "the matrix of a half-space is singular";
  const std::string low = halfspace(1, 0, ""), high = halfspace(-1, -5, "");
  const std::string flat_low = halfspace(1, 0, flat),
                    flat_high = halfspace(-1, 0, std::string(flat) + R"(,"translation":[0,0,5])");
  expect_refused(verify("query", cast_proof(flat_low, flat_high, hit_at_once)), singular);
  expect_refused(verify("query", cast_proof(low, flat_high, hit_at_once)), singular);
  expect_refused(verify("query", cast_proof(flat_low, high, hit_at_once)), singular);
  expect_refused(verify("query", cast_proof(low, high, hit_at_once)), "the half-spaces are apart");
}

// It turns about x by 1.5 radians and sweeps the ball, which its plane passed at the start.
TEST_F(ForgedProofs, AHalfSpaceDoesNotTurn) {
  const Ran ran =
      verify("query", cast_proof(halfspace(1, 0, R"("rotation_vector":[1.5,0,0])"),
                                 R"({"shape":{"type":"sphere","radius":1},"translation":[0,20,3]})",
                                 R"("answer":"miss","lower":["0","1"],"upper":["0","1"],)"
                                 R"("planes":[{"until":["1","1"],"direction":["0","0","1"]}])"));
  expect_refused(ran, "a half-space turns");
}

std::string scene_ray(const std::string& ordered, int body, int t) {
  return fmt::format(
      R"({{"bodies":[{{"shape":{{"type":"sphere","radius":0.5}},"translation":[0,0,5]}},)"
      R"({{"shape":{{"type":"sphere","radius":0.5}},"translation":[0,0,10]}}]}})"
      "\n"
      R"({{"ray":0,"task":"closest","origin":[0,0,0],"direction":[0,0,1],"t_max":"inf",)"
      R"("ordered":{},"answer":"hit","lower":["0","1"],"upper":["{}","1"],"body":{},"part":0,)"
      R"("generators":[],"surface":{{"points":[],"triangles":[]}},)"
      R"("cover":{{"order":[],"steps":[]}},"of_bodies":[]}})"
      "\n",
      ordered, t, body);
}

// The bracket reaches from the start to within the second body.
TEST_F(ForgedProofs, TheSecondBodyOnTheWayIsNotTheFirst) {
  expect_refused(verify("query", scene_ray("true", 1, 10)), "the order has not as many parts");
  const Ran ran = verify("query", scene_ray("false", 1, 10));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("1 of them claim a hit without order"));
}

TEST_F(ForgedProofs, TheNumberOfAQuestionIsThatOfTheFile) {
  folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string header =
      "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,t_max\n";
  const std::string down = "0.1,0.1,1,0,0,-1,inf\n", up = "0.1,0.1,1,0,0,1,inf\n";
  const std::string rays = folder.write("rays.csv", header + down + up);
  const std::string proofs = folder.path() / "saved.jsonl";
  const Ran saved =
      run_program("query " + rays + " --in " + (folder.path() / "mesh.obj").string() +
                  " --cast exact --task closest --out " + (folder.path() / "out.csv").string() +
                  " --save-certificates " + proofs);
  ASSERT_EQ(saved.status, 0) << saved.text;
  EXPECT_THAT(saved.text, HasSubstr("3 vertices in a box of 1 x 1 x 0, taken as metres"));
  const std::string text = folder.read("saved.jsonl");
  EXPECT_EQ(verify("query " + rays, text).status, 0);
  const std::string exchanged = folder.write("exchanged.csv", header + up + down);
  const Ran other = verify("query " + exchanged, text);
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.text, HasSubstr("ray 1: FILE has another ray of that number, or none"));
  EXPECT_THAT(other.text, HasSubstr("0 certificates verified, 2 refused"));
  // A question that is there twice.
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  const Ran twice = verify("query", text + last);
  EXPECT_EQ(twice.status, 1);
  EXPECT_THAT(twice.text, HasSubstr("its number is not above that of the certificate before it"));
  // What was verified before a line that cannot be read is counted.
  const Ran cut = verify("query", text + "{}\n");
  EXPECT_EQ(cut.status, 2);
  EXPECT_THAT(cut.text,
              HasSubstr("2 certificates verified, 0 refused, before what cannot be read"));
}

TEST_F(ForgedProofs, ACaseIsThatOfTheFile) {
  const auto pair = [](double x) {
    return fmt::format(R"({{"id":"p","a":{{"shape":{{"type":"sphere","radius":1}}}},)"
                       R"("b":{{"shape":{{"type":"sphere","radius":1}},"translation":[{},0,0]}}}})"
                       "\n",
                       x);
  };
  const std::string cases = folder.write("cases.jsonl", pair(3)),
                    other = folder.write("other.jsonl", pair(4));
  const std::string proofs = folder.path() / "saved.jsonl",
                    out = (folder.path() / "out.csv").string();
  for (const std::string how : {" --narrow exact --task distance", " --kind cast --cast exact"}) {
    const std::string asked = "query";
    const Ran saved =
        run_program(asked + " " + cases + how + " --out " + out + " --save-certificates " + proofs);
    ASSERT_EQ(saved.status, 0) << saved.text;
    const std::string verify_saved = " --certificates " + proofs;
    EXPECT_EQ(run_program(asked + verify_saved).status, 0);
    EXPECT_EQ(run_program(asked + " " + cases + verify_saved).status, 0);
    const Ran refused = run_program(asked + " " + other + verify_saved);
    EXPECT_EQ(refused.status, 1) << refused.text;
    EXPECT_THAT(refused.text, HasSubstr("FILE has no such case"));
  }
}

// A slip in a key is told, and a key of the user's own is not.
TEST_F(ForgedProofs, AKeyThatIsNearlyAKnownOneIsTold) {
  const std::string cases =
      folder.write("cases.jsonl",
                   R"({"id":"p","note":1,"a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":)"
                   R"({"type":"sphere","radius":1},"translation":[4,0,0],"displacment":[-4,0,0]}})"
                   "\n");
  const Ran ran = run_program("query " + cases + " --kind cast --cast exact --out " +
                              (folder.path() / "out.csv").string());
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("cases.jsonl:1: warning: the key \"displacment\" is ignored; "
                                  "perhaps \"displacement\" was meant"));
  EXPECT_THAT(ran.text, Not(HasSubstr("note")));
}

TEST_F(ForgedProofs, MeshFilesInCases) {
  folder.write("tetra.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const auto body = [](const std::string& more) {
    return R"({"shape":{"mesh":"tetra.obj")" + more + "}}";
  };
  const std::string ball =
      R"({"shape":{"type":"sphere","radius":0.1},"translation":[0.2,0.2,0.2]})";
  const auto line = [&](const std::string& id, const std::string& more) {
    return R"({"id":")" + id + R"(","a":)" + body(more) + R"(,"b":)" + ball + "}\n";
  };
  const std::string cases = folder.write(
      "cases.jsonl", line("surface", "") + line("solid", R"(,"as":"solid")") +
                         line("hull", R"(,"as":"hull")") + line("great", R"(,"scale":10)"));
  const std::string out = folder.path() / "out.csv";
  const Ran ran = run_program("query " + cases + " --narrow fused --task intersect --out " + out);
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("tetra.obj: 4 vertices in a box of 10 x 10 x 10"));
  const auto rows = read_rows(out, {"id", "answer"});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0][1], "separated");
  EXPECT_EQ(rows[1][1], "overlapping");
  EXPECT_EQ(rows[2][1], "overlapping");
  EXPECT_EQ(rows[3][1], "separated");
  folder.write("none.jsonl", R"({"id":"x","a":{"shape":{"mesh":"none.obj"}},"b":)" + ball + "}\n");
  const Ran none = run_program("query " + (folder.path() / "none.jsonl").string() +
                               " --narrow fused --task intersect --out " + out);
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.text, HasSubstr("none.jsonl:1: a.shape.mesh: no file "));
}

}  // namespace
}  // namespace touchstone
