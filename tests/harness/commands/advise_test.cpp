// Tests of touchstone advise.
#include <string>

#include "tests/harness/commands/program.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

const std::string spheres =
    "generator = \"uniform\"\ncount = 60\noverlaps = 6\nframes = 4\nshapes = [\"sphere\"]\n";
const std::string still = "generator = \"uniform\"\ncount = 40\noverlaps = 6\nmoving = 0\n";

TEST(AdviseCommand, WritesAFileThatMeasuresItsChoiceAgain) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", spheres).string();
  const std::string out = (folder.path() / "out").string();
  const Ran ran =
      run_program("advise " + scene +
                  " --max-error 0 --no-false-negatives --threads 1 --seconds 1 --out " + out);
  ASSERT_EQ(ran.status, 0) << ran.text;
  const std::string advice = folder.read("out/advice.txt");
  EXPECT_THAT(ran.text, HasSubstr(advice));
  EXPECT_THAT(advice, HasSubstr("verdicts at most 0, no contact missed"));
  // The advice has the scene's requirements, and nothing more.
  EXPECT_THAT(advice, HasSubstr("error          0 (verdicts)"));
  EXPECT_THAT(advice, HasSubstr("needs          0 hulls built"));
  EXPECT_THAT(advice, HasSubstr(" queries, 0 witness points"));
  EXPECT_THAT(advice, HasSubstr("0 missed"));

  const Ran again = run_program("run " + out + "/advice.toml --out " + out + "/again");
  ASSERT_EQ(again.status, 0) << again.text;
  const auto rows = read_rows(folder.path() / "out/again/points.csv",
                              {"point", "error", "false_negatives", "hulls_built"});
  ASSERT_FALSE(rows.empty());
  EXPECT_THAT(advice, HasSubstr("Cheapest: " + rows[0][0] + "\n"));
  EXPECT_EQ(rows[0][1], "0");
  EXPECT_EQ(rows[0][2], "0");
  EXPECT_EQ(rows[0][3], "0");
}

TEST(AdviseCommand, ItsFolderIsShownAndReported) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", spheres).string();
  const std::string out = (folder.path() / "out").string();
  const Ran ran =
      run_program("advise " + scene + " --max-error 0.05 --threads 1 --seconds 1 --out " + out);
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("  tested         0 of "));
  const Ran shown = run_program("show " + out);
  EXPECT_EQ(shown.status, 0) << shown.text;
  EXPECT_THAT(shown.text, HasSubstr("Cheapest: "));
  const auto rows =
      read_rows(folder.path() / "out/advice.csv", {"role", "wrong", "tested", "ratio"});
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows[0][0], "cheapest");
  EXPECT_EQ(rows[0][1], "0");
  EXPECT_EQ(rows[0][3], "1");
  const std::string page = folder.write("page.html", "<!--BUNDLE-->").string();
  const Ran report =
      run_program("report " + out + " --page " + page + " --out " + out + "/report.html");
  EXPECT_EQ(report.status, 0) << report.text;
}

TEST(AdviseCommand, OnePairIsNoTest) {
  const TemporaryFolder folder;
  const std::string scene =
      folder
          .write("scene.toml",
                 "[[body]]\nshape = {type = \"box\", half_extents = [1, 1, 1]}\n"
                 "[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [1.9, 0, 0]\n")
          .string();
  const std::string out = (folder.path() / "out").string();
  for (const char* most : {"0", "0.001"}) {
    const Ran ran = run_program("advise " + scene + " --max-error " + most +
                                " --threads 1 --seconds 1 --out " + out);
    EXPECT_EQ(ran.status, 1) << ran.text;
    EXPECT_THAT(ran.text, HasSubstr("Cannot know: 1 pair tests nothing: move the bodies, or give "
                                    "more frames.\n"));
    if (std::string(most) == "0") {
      EXPECT_THAT(ran.text, testing::Not(HasSubstr("inner")));
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/advice.toml"));
    EXPECT_EQ(read_rows(folder.path() / "out/advice.csv", {"role"}).at(0).at(0), "untested");
  }
}

TEST(AdviseCommand, WhatRestsIsNotUpdatedAndDistancesHaveWitnessPoints) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.toml", still).string();
  const std::string out = (folder.path() / "out").string();
  const Ran ran = run_program(
      "advise " + scene + " --task distance --max-error 1e-6 --threads 1 --seconds 1 --out " + out);
  ASSERT_EQ(ran.status, 0) << ran.text;
  const std::string advice = folder.read("out/advice.txt");
  EXPECT_THAT(advice, HasSubstr("(greatest)"));
  EXPECT_THAT(advice, HasSubstr(" 0 updates, "));
  EXPECT_THAT(advice, testing::Not(HasSubstr(", 0 witness points")));
}

TEST(AdviseCommand, VerifiesAListOfScenes) {
  const TemporaryFolder folder;
  folder.write("scene.toml", spheres);
  const std::string list = folder
                               .write("list.toml",
                                      "[[scene]]\nfile = \"scene.toml\"\nmax_error = 0\n"
                                      "[[scene]]\nfile = \"scene.toml\"\nname = \"loose\"\n"
                                      "max_error = 1\n")
                               .string();
  const std::string out = (folder.path() / "out").string();
  const Ran ran = run_program("advise --list " + list +
                              " --verify --seeds 2 --threads 1 --seconds 1 --out " + out);
  // A busy machine may leave open whether its time is within 10 %.
  ASSERT_TRUE(ran.status == 0 || ran.status == 1) << ran.text;
  const auto rows = read_rows(folder.path() / "out/verification.csv",
                              {"scene", "max_error", "error", "held_out", "error_1", "error_2",
                               "within_budget", "verified", "within_time", "choice"});
  ASSERT_EQ(rows.size(), 2u);
  bool all = true;
  for (const auto& row : rows) {
    EXPECT_EQ(row[0], "scene");
    EXPECT_EQ(row[3], "seeds 1002 to 1003");
    EXPECT_EQ(row[6], "yes");
    EXPECT_EQ(row[7] == "yes", row[8] == "yes");
    all = all && row[7] == "yes";
  }
  EXPECT_EQ(ran.status, all ? 0 : 1);
  EXPECT_EQ(rows[0][2], "0");
  EXPECT_EQ(rows[0][4], "0");
  EXPECT_EQ(rows[0][5], "0");
  EXPECT_THAT(folder.read("out/scene/advice.txt"), HasSubstr("Cheapest: " + rows[0][9] + "\n"));
  for (const char* file : {"scene/advice.toml", "scene/grid/points.csv", "loose/advice.toml"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / file)) << file;
  }
}

TEST(AdviseCommand, BadRequestsAreRefused) {
  const TemporaryFolder folder;
  const std::string at = folder.path().string() + "/";
  const std::string scene = folder.write("scene.toml", spheres).string();
  const std::string list = folder.write("list.toml", "[[scene]]\nfile = \"none.toml\"\n").string();
  const std::string out = " --out " + at + "out";
  for (const char* bad : {"nan", "-1e-3", "inf", "none", "\"\""}) {
    expect_refusal("advise " + scene + " --max-error=" + bad + out, "--max-error", folder);
  }
  for (const char* bad : {"nan", "0", "-1"}) {
    expect_refusal("advise " + scene + " --seconds=" + bad + out, "--seconds", folder);
  }
  expect_refusal("advise" + out, "expected a scene file, or --list", folder);
  expect_refusal("advise " + at + "none.toml" + out, "none.toml: no such file", folder);
  expect_refusal("advise " + scene + " --error luck" + out, "--error", folder);
  expect_refusal("advise " + scene + " --seeds 2" + out, "--seeds", folder);
  expect_refusal("advise " + scene + " --verify --seeds 0" + out, "--seeds", folder);
  expect_refusal("advise " + scene + " --list " + list + out, "--list", folder);
  expect_refusal("advise --list " + list + out, "list.toml:2: scene 1: file", folder);
  expect_refusal("advise --list " + list + " --max-error 1" + out, "--max-error", folder);
  folder.write("bad.toml", "generator = \"nobody\"\n");
  expect_refusal("advise " + at + "bad.toml" + out, "bad.toml:1", folder);
}

}  // namespace
}  // namespace touchstone
