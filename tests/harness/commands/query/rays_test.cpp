// Tests of touchstone query with rays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "algorithms/registry.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> columns_of_rays = {"ray",      "algorithm", "scalar", "hit",   "t",
                                                  "triangle", "u",         "v",      "status"};
// Two triangles, one behind the other.
const std::string two_triangles =
    "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 0 2 1\nf 1 2 3\nf 4 5 6\n";
const std::string header = "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,t_max\n";

TEST(RaysCommand, OneRowForEachRayAndCast) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("two.obj", two_triangles);
  const auto rays = folder.write(
      "rays.csv", header + "0.5,0.25,3,0,0,-1,inf\n0.5,0.25,3,0,0,-4,0.25\n5,5,3,0,0,-1,inf\n");
  const auto out = folder.path() / "out.csv";
  for (const std::string scalar : {"float", "double"}) {
    const Ran ran = run_program("query " + rays.string() + " --in " + mesh.string() +
                                " --cast wide-bvh,exact --task closest --scalar " + scalar +
                                " --out " + out.string());
    EXPECT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(out, columns_of_rays);
    ASSERT_EQ(rows.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string name = i % 2 == 0 ? "wide-bvh" : "exact";
      using Row = std::vector<std::string>;
      const std::vector<Row> expected = {{"0", name, scalar, "1", "2", "1", "0.25", "0.125", "ok"},
                                         {"1", name, scalar, "0", "", "", "", "", "ok"},
                                         {"2", name, scalar, "0", "", "", "", "", "ok"}};
      EXPECT_EQ(rows[i], expected[i / 2]);
    }
  }
}

TEST(RaysCommand, AllAnswerWhetherThereIsAnyHit) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("two.obj", two_triangles);
  const auto rays = folder.write("rays.csv", header + "0.5,0.25,3,0,0,-1,4\n5,5,3,0,0,-1,inf\n");
  const auto out = folder.path() / "out.csv";
  const Ran ran = run_program("query " + rays.string() + " --in " + mesh.string() +
                              " --cast all --task any --scalar float --out " + out.string());
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::size_t asked = 0;
  for (const auto& row : read_rows(out, columns_of_rays)) {
    const RayCastEntry& entry = *registry::find<RayCastEntry>(row[1]);
    if (!offers(entry, RayTask::any) || !offers(entry, Precision::float32)) {
      EXPECT_EQ(row[8], "unsupported");
      continue;
    }
    ++asked;
    EXPECT_EQ(row[3], row[0] == "0" ? "1" : "0") << row[1];
  }
  EXPECT_GE(asked, 6u);
}

TEST(RaysCommand, WrongRequests) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("two.obj", two_triangles);
  const auto good = folder.write("rays.csv", header + "0,0,0,0,0,1,inf\n");
  const std::string out = " --out " + (folder.path() / "out.csv").string();
  const auto rays = [&](const std::string& text) {
    const auto file = folder.write("bad.csv", text);
    return run_program("query " + file.string() + " --in " + mesh.string() +
                       " --cast exact --task any" + out);
  };
  for (const auto& [line, said] : {std::pair{"0,0,0,0,0,0,1", "direction is zero"},
                                   {"0,0,nan,0,0,1,1", "finite"},
                                   {"0,0,0,0,0,1,-1", "t_max"},
                                   {"0,0,0,0,0,1,nan", "t_max"},
                                   {"0,0,0,0,0,x,1", "direction_z"}}) {
    const Ran ran = rays(header + "0,0,0,0,0,1,inf\n" + line + "\n");
    EXPECT_EQ(ran.status, 2);
    EXPECT_THAT(ran.text, HasSubstr("bad.csv:3:"));
    EXPECT_THAT(ran.text, HasSubstr(said));
  }
  EXPECT_EQ(rays("origin_x,origin_y\n0,0\n").status, 2);
  const std::string base = "query " + good.string() + " --in " + mesh.string();
  EXPECT_THAT(run_program(base + " --cast nobody --task any" + out).text, HasSubstr("wide-bvh"));
  EXPECT_EQ(run_program(base + " --cast nobody --task any" + out).status, 2);
  EXPECT_EQ(run_program(base + " --cast exact --task all" + out).status, 2);
  EXPECT_EQ(
      run_program("query " + good.string() + " --in none.obj --cast exact --task any" + out).status,
      2);
}

TEST(RaysCommand, CertificatesAreSavedAndVerified) {
  const TemporaryFolder folder;
  const auto mesh = folder.write("two.obj", two_triangles);
  const auto rays = folder.write(
      "rays.csv", header + "0.5,0.25,3,0,0,-1,inf\n0.1,0.7,3,0,0,-4,0.25\n0.1,0.1,3,0,0,-1,9\n");
  const std::string out = " --out " + (folder.path() / "out.csv").string();
  const auto proofs = folder.path() / "proofs.jsonl";
  const std::string base = "query " + rays.string() + " --in " + mesh.string() +
                           " --cast wide-bvh" + out + " --save-certificates " + proofs.string();
  const auto verify = [&](const std::filesystem::path& file) {
    return run_program("query --certificates " + file.string());
  };
  for (const std::string options : {" --task any --scalar float", " --task closest"}) {
    const Ran saved = run_program(base + options);
    ASSERT_EQ(saved.status, 0) << saved.text;
    EXPECT_THAT(saved.text, HasSubstr("3 certificates in"));
    const Ran verified = verify(proofs);
    EXPECT_EQ(verified.status, 0) << verified.text;
    EXPECT_THAT(verified.text, HasSubstr("3 certificates verified, 0 refused"));
  }
  std::string text = folder.read("proofs.jsonl");
  const auto place = text.find("\"triangle\":1");
  ASSERT_NE(place, std::string::npos);
  const Ran refused =
      verify(folder.write("changed.jsonl", text.replace(place, 12, "\"triangle\":0")));
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.text, HasSubstr("changed.jsonl:2: ray 0: "));
  EXPECT_THAT(refused.text, HasSubstr("2 certificates verified, 1 refused"));
  const Ran no_mesh = verify(folder.write("broken.jsonl", text.substr(text.find('\n') + 1)));
  EXPECT_EQ(no_mesh.status, 2);
  EXPECT_THAT(no_mesh.text, HasSubstr("broken.jsonl:1: a certificate before any mesh"));
  EXPECT_EQ(
      run_program("query --in " + mesh.string() + " --certificates " + proofs.string()).status, 2);
}

// A ball, and one behind it that hides nothing of it.
TEST(RaysCommand, CertificatesOfRaysAtScenes) {
  const TemporaryFolder folder;
  const std::string ball = "{shape = {type = \"sphere\", radius = 1}, translation = [4, 0, 0]}";
  const std::string scene = "frames = 1\ntime_step = 1.0\nbody = [";
  const auto one = folder.write("one.toml", scene + ball + "]\n");
  const auto two =
      folder.write("two.toml", scene +
                                   "{shape = {type = \"box\", half_extents = [1, 1, 1]}, "
                                   "translation = [4, 0, -2]}, " +
                                   ball + "]\n");
  const auto rays = folder.write("rays.csv", header + "4,0,3,0,0,-2,inf\n9,0,3,0,0,-1,inf\n");
  const std::string proofs = (folder.path() / "proofs.jsonl").string();
  const std::string asked = " --with exact --task closest --out " +
                            (folder.path() / "out.csv").string() + " --save-certificates " + proofs;
  for (const auto& file : {one, two}) {
    const Ran saved = run_program("query " + rays.string() + " --in " + file.string() + asked);
    ASSERT_EQ(saved.status, 0) << saved.text;
    EXPECT_THAT(saved.text, HasSubstr("2 certificates in"));
    const Ran verified = run_program("query --certificates " + proofs);
    EXPECT_EQ(verified.status, 0) << verified.text;
    EXPECT_THAT(verified.text, HasSubstr("2 certificates verified, 0 refused"));
    EXPECT_THAT(folder.read("proofs.jsonl"),
                HasSubstr(file == one ? "\"body\":0,\"part\":0" : "\"body\":1,\"part\":0"));
  }
  std::string text = folder.read("proofs.jsonl");
  EXPECT_THAT(text, HasSubstr("\"answer\":\"hit\""));
  const auto place = text.find("\"answer\":\"hit\"");
  const auto changed =
      folder.write("changed.jsonl", text.replace(place, 14, "\"answer\":\"miss\""));
  const Ran refused = run_program("query --certificates " + changed.string());
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.text, HasSubstr("changed.jsonl:2: ray 0: "));
}

// A box and a ball beside it; the mouse's ray at each, past them, and at a later frame of the ball.
TEST(RaysCommand, OneRowForEachRayAtAScene) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.toml",
                                  "frames = 2\ntime_step = 1.0\nbody = [\n"
                                  "{shape = {type = \"box\", half_extents = [1, 1, 0.5]}, "
                                  "translation = [0, 0, 0], moving = false},\n"
                                  "{shape = {type = \"sphere\", radius = 1}, translation = [4, 0, "
                                  "0], velocity = [0, 0, 1]}]\n");
  const auto rays = folder.write(
      "rays.csv", header + "0.25,0,3,0,0,-1,inf\n4,0,3,0,0,-2,inf\n9,0,3,0,0,-1,inf\n");
  const auto out = folder.path() / "out.csv";
  std::vector<std::string> columns = columns_of_rays;
  for (const char* name : {"body", "part", "normal_x", "normal_y", "normal_z"}) {
    columns.emplace_back(name);
  }
  for (const std::string frame : {"0", "1"}) {
    const Ran ran =
        run_program("query " + rays.string() + " --in " + scene.string() +
                    " --cast all --task closest --frame " + frame + " --out " + out.string());
    EXPECT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(out, columns);
    ASSERT_EQ(rows.size(), 6u);
    for (const auto& row : rows) {
      EXPECT_EQ(row[8], "ok");
      EXPECT_EQ(row[3], row[0] == "2" ? "0" : "1");
      EXPECT_EQ(row[9], row[0] == "2" ? "" : row[0]);
      if (row[0] == "0") {
        EXPECT_EQ(row[4], "2.5");
      }
      if (row[0] == "1") {
        EXPECT_EQ(row[4], frame == "0" ? "1" : "0.5");
      }
      if (row[0] == "0" && row[1] == "wide-bvh") {
        EXPECT_EQ(row[13], "1");
      }
    }
  }
  for (const std::string wrong : {" --frame 2", " --scalar float"}) {
    const Ran ran = run_program("query " + rays.string() + " --in " + scene.string() +
                                " --cast all --task closest --out " + out.string() + wrong);
    EXPECT_EQ(ran.status, 2) << wrong;
  }
}

// A mesh collides as its triangles, not as its hull: a ray through the hole of a torus meets nothing.
TEST(RaysCommand, AtAMeshOfASceneNameItsTriangle) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.toml",
                                  "[[body]]\nshape = {type = \"torus\", tube_radius = 0.25, "
                                  "around = 16}\ntranslation = [0, 0, 0]\n");
  const auto rays = folder.write("rays.csv", header + "0,0,9,0,0,-1,inf\n1,0.01,9,0,0,-1,inf\n");
  const auto out = folder.path() / "out.csv";
  const Ran ran = run_program("query " + rays.string() + " --in " + scene.string() +
                              " --cast all --task closest --out " + out.string());
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::vector<std::string> columns = columns_of_rays;
  for (const char* name : {"body", "part", "normal_x", "normal_y", "normal_z"}) {
    columns.emplace_back(name);
  }
  const auto rows = read_rows(out, columns);
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& row : rows) {
    EXPECT_EQ(row[8], "ok");
    EXPECT_EQ(row[3], row[0]);
    EXPECT_EQ(row[5], row[10]);
    EXPECT_EQ(row[5].empty(), row[0] == "0");
  }
}

}  // namespace
}  // namespace touchstone
