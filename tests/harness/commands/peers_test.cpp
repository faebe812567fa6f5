// Tests of --peer, --answers and --export.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "harness/files/cases.h"
#include "harness/files/json_line.h"
#include "harness/files/text_file.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class Peers : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  static std::string example(const std::string& name) {
    return std::string(project_folder) + "/datasets/adapters/examples/" + name;
  }
  std::string python() const { return "--peer 'python3 " + example("spheres.py") + "'"; }
  static std::string hostile(const std::string& fault) {
    return "--peer 'python3 " + std::string(project_folder) + "/tests/harness/peer/hostile.py " +
           fault + " 1'";
  }
  // Three pairs of spheres, 1, 2 and 3 m apart.
  std::string pairs() const {
    std::string text;
    for (int gap = 1; gap <= 3; ++gap) {
      text += fmt::format(
          R"({{"id":"{0}","a":{{"shape":{{"type":"sphere","radius":1}}}},"b":{{"shape":{{"type":"sphere",)"
          R"("radius":1}},"translation":[{1},0,0]}}}})"
          "\n",
          gap, gap + 2);
    }
    files::write_text(path("pairs.jsonl"), text);
    return path("pairs.jsonl");
  }
  // Asks one that has a fault from the second question on.
  std::vector<std::string> statuses(const std::string& fault, const std::string& limit = "20") {
    ran = run_program("query " + pairs() + " --task distance --with none --time-limit " + limit +
                      " " + hostile(fault) + " --out " + path("out.csv"));
    EXPECT_EQ(ran.status, 0) << ran.text;
    std::vector<std::string> all;
    for (const auto& row : read_rows(path("out.csv"), {"status"})) all.push_back(row[0]);
    return all;
  }

  TemporaryFolder folder;
  Ran ran;
};

TEST_F(Peers, AreAskedBesideOthers) {
  const Ran asked = run_program("query " + pairs() + " --with exact " + python());
  EXPECT_EQ(asked.status, 0) << asked.text;
  EXPECT_THAT(asked.text, HasSubstr("spheres-in-python@1.0        1 (exact)"));
  EXPECT_THAT(asked.text, HasSubstr("spheres-in-python@1.0        3 (exact)"));
}

TEST_F(Peers, WhatTheyDoNotTakeIsUnsupported) {
  files::write_text(path("box.jsonl"),
                    R"({"a":{"shape":{"type":"box","half_extents":[1,1,1]}},)"
                    R"("b":{"shape":{"type":"sphere","radius":1},"translation":[3,0,0]}})"
                    "\n");
  const Ran asked = run_program("query " + path("box.jsonl") + " --with exact " + python());
  EXPECT_EQ(asked.status, 0) << asked.text;
  EXPECT_THAT(asked.text, HasSubstr("not taken by spheres-in-python@1.0"));
}

TEST_F(Peers, ExamplesAreRight) {
  ASSERT_EQ(run_shell("cc -O2 -o " + path("spheres") + " " + example("spheres.c") + " -lm").status,
            0);
  ran = run_program("check --groups gap,depth,random,scale --cases 40 " + python() + " --peer " +
                    path("spheres") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::map<std::string, int> answers;
  for (const auto& row :
       read_rows(path("out/grades.csv"), {"algorithm", "kind_a", "kind_b", "status", "verdict"})) {
    ++answers[row[0]];
    EXPECT_THAT(
        row, ElementsAre(row[0], "sphere", "sphere", "ok", ::testing::AnyOf("right", "unscored")));
  }
  EXPECT_GT(answers["spheres-in-python@1.0"], 20);
  EXPECT_EQ(answers["spheres-in-python@1.0"], answers["spheres-in-c@1.0"]);
}

TEST_F(Peers, SayWhatTheyTook) {
  ASSERT_EQ(run_shell("cc -O2 -o " + path("spheres") + " " + example("spheres.c") + " -lm").status,
            0);
  const std::string query = "query " + pairs() + " --with exact --task distance --peer " +
                            path("spheres") + " " + python() + " --repeat 1000";
  ran = run_program(query);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("They belong in no table with times that are measured here."));
  EXPECT_THAT(ran.text, ::testing::ContainsRegex("spheres-in-c@1.0 +1000 +3 +[0-9.e-]+ us"));
  EXPECT_THAT(ran.text, ::testing::ContainsRegex("spheres-in-python@1.0 +1000 +0 +-"))
      << "it knows no repeats";
  EXPECT_THAT(ran.text, HasSubstr("spheres-in-c@1.0             3 (exact)"));
  ran = run_program("check --groups gap --cases 5 " + python() + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  for (const auto& row :
       read_rows(path("out/peers.csv"), {"peer", "starts", "peak_memory", "repeat"})) {
    EXPECT_EQ(row[0] + row[3], "spheres-in-python@1.00");
    EXPECT_GT(std::stoi(row[1]), 1);
    EXPECT_GT(std::stod(row[2]), 1e6);
  }
  expect_refusal("query " + pairs() + " --repeat 5", "--repeat requires --peer", folder);
}

TEST_F(Peers, AWrongSignIsASilentError) {
  ran = run_program("check --groups gap,depth --cases 100 " + hostile("wrong-sign") + " --out " +
                    path("out"));
  EXPECT_EQ(ran.status, 0) << "no algorithm of ours is wrong\n" << ran.text;
  std::map<std::string, int> verdicts;
  for (const auto& row : read_rows(path("out/grades.csv"), {"verdict"})) ++verdicts[row[0]];
  EXPECT_GT(verdicts["silent_error"], 5);
}

TEST_F(Peers, FaultsBecomeRowsAndTheWorkGoesOn) {
  EXPECT_THAT(statuses("none"), ElementsAre("ok", "ok", "ok"));
  // A new program answers the question after.
  EXPECT_THAT(statuses("exit"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(ran.text, HasSubstr("the program left with status 3: the last words"));
  EXPECT_THAT(statuses("signal"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(statuses("closed-output"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(statuses("hang", "5"), ElementsAre("ok", "timed_out", "ok"));
  EXPECT_THAT(statuses("no-line", "5"), ElementsAre("ok", "timed_out", "ok"));
  EXPECT_THAT(statuses("garbage"), ElementsAre("ok", "garbage", "ok"));
  EXPECT_THAT(ran.text, HasSubstr("found 'Traceback (most recent call last):'"));
  EXPECT_THAT(statuses("nan"), ElementsAre("ok", "garbage", "ok"));
  EXPECT_THAT(statuses("wrong-type"), ElementsAre("ok", "garbage", "ok"));
  EXPECT_THAT(ran.text, HasSubstr("distance: found \"1\"; expected a number"));
  EXPECT_THAT(statuses("endless-line"), ElementsAre("ok", "garbage", "ok"));
  EXPECT_THAT(statuses("endless-lines"), ElementsAre("ok", "garbage", "ok"));
  // The line too many is found by the question behind it.
  EXPECT_THAT(statuses("extra-line"), ElementsAre("ok", "ok", "garbage"));
  EXPECT_THAT(statuses("fork-bomb"), ElementsAre("ok", "ok", "ok"));
}

TEST_F(Peers, ACrashAtTheThousandthQuestionLosesThatOne) {
  std::string text;
  for (int i = 0; i < 1100; ++i) {
    text += R"({"a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"sphere",)"
            R"("radius":1},"translation":[3,0,0]}})"
            "\n";
  }
  files::write_text(path("many.jsonl"), text);
  ran = run_program("query " + path("many.jsonl") +
                    " --task distance --with none --peer 'python3 " + std::string(project_folder) +
                    "/tests/harness/peer/hostile.py signal 999' --out " + path("out.csv"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  const auto rows = read_rows(path("out.csv"), {"status"});
  ASSERT_EQ(rows.size(), 1100U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][0], i == 999 ? "crashed" : "ok") << i;
  }
}

TEST_F(Peers, AnswerRaysPointsAndCasts) {
  const std::string further =
      "--peer 'python3 " + std::string(project_folder) + "/tests/harness/peer/further_kinds.py'";
  files::write_text(path("mesh.off"), "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n");
  files::write_text(path("points.csv"), "x,y,z\n0.25,0.25,-2\n-1,0,0\n");
  const std::string with = " --with exact " + further;
  ran = run_program("query " + path("points.csv") + " --in " + path("mesh.off") + with +
                    " --task closest --out " + path("points.out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(read_rows(path("points.out"), {"algorithm", "distance", "status"}),
              ElementsAre(ElementsAre("exact", "2", "ok"), ElementsAre("further@1", "2", "ok"),
                          ElementsAre("exact", "1", "ok"), ElementsAre("further@1", "1", "ok")));
  ran = run_program(
      "check --regimes rays-face,rays-vertex,rays-in-plane,points-off-1e-3,casts-pass-1e-1 "
      "--scalar double --cases 15 " +
      further + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::map<std::string, int> right, others;  // by family
  for (const auto& row :
       read_rows(path("out/families.csv"), {"family", "form", "right", "cases", "failed"})) {
    EXPECT_EQ(row[4], "0") << row[0];
    if (row[1] != "as drawn") continue;
    right[row[0]] += std::stoi(row[2]);
    others[row[0]] += std::stoi(row[3]) - std::stoi(row[2]);
  }
  EXPECT_EQ(right["rays-face"], 30) << "of both tasks";
  EXPECT_EQ(right["points-off-1e-3"], 15);
  EXPECT_GT(right["casts-pass-1e-1"], 0) << "of spheres";
  EXPECT_EQ(others["casts-pass-1e-1"], 0);
  EXPECT_GT(others["rays-vertex"] + others["rays-in-plane"], 0) << "rounding decides there";
}

TEST_F(Peers, AnswerMeshesAndFeatures) {
  const std::string further =
      "python3 " + std::string(project_folder) + "/tests/harness/peer/further_kinds.py";
  const std::string same =
      "check --kind mesh,feature --regimes triangles-generic,triangles-edges-1e-3,"
      "triangles-coplanar,vertex-face-inside,vertex-face-random,edge-edge-inside --scalar double "
      "--cases 15 ";
  ran = run_program(same + "--with none --peer '" + further + "' --out " + path("live"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  const auto rows = [&](const std::string& run) {
    return read_rows(path(run + "/families.csv"),
                     {"family", "algorithm", "form", "cases", "contacts", "right", "gave_up"});
  };
  struct Count {
    int cases = 0, contacts = 0, right = 0, gave_up = 0;
  };
  std::map<std::string, Count> counts;
  for (const auto& row : rows("live")) {
    if (row[2] != "as drawn") continue;
    Count& count = counts[row[0]];
    count.cases += std::stoi(row[3]);
    count.contacts += std::stoi(row[4]);
    count.right += std::stoi(row[5]);
    count.gave_up += std::stoi(row[6]);
  }
  for (const std::string family : {"triangles-generic", "triangles-edges-1e-3"}) {
    EXPECT_EQ(counts[family].right, 30) << "of both tasks";
    EXPECT_GT(counts[family].contacts, 0);
    EXPECT_LT(counts[family].contacts, 30);
  }
  EXPECT_GT(counts["triangles-coplanar"].gave_up, 0);
  EXPECT_GT(counts["vertex-face-inside"].right, 10);
  EXPECT_GT(counts["vertex-face-random"].right, 10);
  EXPECT_EQ(counts["edge-edge-inside"].right, 0) << "not offered";

  ran = run_program(same + "--export " + path("questions.jsonl"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  const std::string elsewhere =
      further + " < " + path("questions.jsonl") + " > " + path("answers.jsonl");
  ASSERT_EQ(run_shell(elsewhere).status, 0);
  ran = run_program(same + "--with none --answers " + path("answers.jsonl") + " --out " +
                    path("elsewhere"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_EQ(rows("live"), rows("elsewhere"));

  ran = run_program("check --kind mesh,scene-ray --export " + path("none.jsonl"));
  EXPECT_EQ(ran.status, 2);
  EXPECT_THAT(ran.text, HasSubstr("'scene-ray'; expected some of pair, "));
}

TEST_F(Peers, FindThePairsOfPackedBoxes) {
  const std::string boxes = "--peer 'python3 " + example("boxes.py") + "'";
  ran = run_program("check --kind box --with none " + boxes + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("1 of 1 broad phases find all pairs"));
  // Three boxes that touch in a row, in two frames.
  files::write_text(path("boxes.csv"),
                    "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n"
                    "0,0,0,0,0,1,1,1\n0,1,1,0,0,2,1,1\n0,2,2,0,0,3,1,1\n"
                    "1,0,0,0,0,1,1,1\n1,1,1,0,0,2,1,1\n1,2,2.5,0,0,3,1,1\n");
  const auto statuses_of = [&](const std::string& peer, const std::string& limit) {
    ran = run_program("query " + path("boxes.csv") + " --with none --time-limit " + limit + " " +
                      peer + " --out " + path("out.csv"));
    EXPECT_EQ(ran.status, 0) << ran.text;
    std::vector<std::string> all;
    for (const auto& row : read_rows(path("out.csv"), {"status", "pair_count", "seconds"})) {
      EXPECT_EQ(row[2], "") << "its time has the pipe in it";
      all.push_back(row[0] + " " + row[1]);
    }
    return all;
  };
  EXPECT_THAT(statuses_of(boxes, "20"), ElementsAre("ok 2", "ok 1"));
  const auto with = [&](const std::string& fault, const std::string& limit = "20") {
    return statuses_of("--peer 'python3 " + std::string(project_folder) +
                           "/tests/harness/peer/hostile_boxes.py " + fault + " 1'",
                       limit);
  };
  for (const char* fault :
       {"swapped", "absent-box", "too-many", "fraction", "wrong-id", "no-json", "endless"}) {
    SCOPED_TRACE(fault);
    EXPECT_THAT(with(fault), ElementsAre("ok 2", "garbage "));
  }
  EXPECT_THAT(with("exit"), ElementsAre("ok 2", "crashed "));
  EXPECT_THAT(with("short"), ElementsAre("ok 2", "crashed "));
  EXPECT_THAT(with("hang", "5"), ElementsAre("ok 2", "timed_out "));
  EXPECT_THAT(with("missing"), ElementsAre("ok 2", "ok 0"));
  EXPECT_THAT(with("unsupported"), ElementsAre("ok 2", ::testing::StartsWith("unsupported")));
  ran = run_program("check --kind box --with none --peer 'python3 " + std::string(project_folder) +
                    "/tests/harness/peer/hostile_boxes.py missing 3' --out " + path("wrong"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("hostile-missing is wrong on: "));
}

TEST_F(Peers, AdaptersInPythonAnswerThroughStandIns) {
  const std::string root = project_folder;
  if (run_shell("/usr/bin/python3 -c 'import numpy'").status != 0) {
    GTEST_SKIP() << "no numpy (Debian: python3-numpy)";
  }
  files::write_text(path("spheres.jsonl"),
                    R"({"a":{"shape":{"type":"sphere","radius":1}},)"
                    R"("b":{"shape":{"type":"sphere","radius":2},"translation":[0,4,3]}})"
                    "\n"
                    R"({"a":{"shape":{"type":"sphere","radius":1},"translation":[1,0,0]},)"
                    R"("b":{"shape":{"type":"sphere","radius":2},"translation":[1,0,2.5]}})"
                    "\n");
  for (const std::string name : {"coal", "python-fcl", "mujoco-python", "drake", "pybullet"}) {
    SCOPED_TRACE(name);
    ran = run_program("query " + path("spheres.jsonl") +
                      " --with exact --task signed --peer 'PYTHONPATH=" + root +
                      "/tests/harness/peer/stand_ins /usr/bin/python3 -B " + root +
                      "/datasets/adapters/" + name + "/peer.py 1.0' --out " + path("out.csv"));
    EXPECT_EQ(ran.status, 0) << ran.text;
    const auto rows = read_rows(path("out.csv"), {"algorithm", "answer", "distance"});
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_THAT(rows[1], ElementsAre(name + "@1.0", "separated", "2"));
    EXPECT_THAT(rows[3], ElementsAre(name + "@1.0", "overlapping", "-0.5"));
  }
}

TEST_F(Peers, ARunGradesThemWithoutTimes) {
  const std::string scene = std::string(project_folder) + "/datasets/mixed.toml";
  ran = run_program(
      "run --scene " + scene +
      " --count 100 --frames 1 --broad none --concave none --narrow gjk --scalar double "
      "--task distance --seconds 0.2 " +
      python() + " --out " + path("run"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  int graded = 0, of_gjk = 0;
  for (const auto& row : read_rows(path("run/raw.csv"), {"narrow", "kind", "seconds", "pair_kind",
                                                         "compared", "allocations"})) {
    of_gjk += row[0] == "gjk" && row[1] == "sample" ? 1 : 0;
    if (row[0] != "spheres-in-python@1.0") continue;
    EXPECT_EQ(row[1], "check") << "a sample of a peer";
    EXPECT_EQ(row[2] + row[5], "") << "its time has the pipe in it";
    graded += row[3] == "sphere-sphere" && row[4] != "" && row[4] != "0" ? 1 : 0;
  }
  EXPECT_GT(of_gjk, 0);
  EXPECT_EQ(graded, 1);
}

TEST_F(Peers, AreGradedByWhatTheyAnsweredElsewhere) {
  const std::string same = "check --groups gap,depth --cases 20 --seed 5 ";
  const Ran wrote = run_program(same + "--export " + path("questions.jsonl"));
  ASSERT_EQ(wrote.status, 0) << wrote.text;
  ASSERT_EQ(run_shell("python3 " + example("spheres.py") + " < " + path("questions.jsonl") + " > " +
                      path("answers.jsonl"))
                .status,
            0);
  const Ran asked =
      run_program("query " + path("questions.jsonl") + " --with gjk --out " + path("gjk.csv"));
  EXPECT_EQ(asked.status, 0) << asked.text;
  EXPECT_THAT(asked.text, Not(HasSubstr("warning")));
  EXPECT_GT(read_rows(path("gjk.csv"), {"id"}).size(), 1000U) << "questions are cases";
  const Ran live = run_program(same + "--scalar double " + python() + " --out " + path("live"));
  const Ran graded = run_program(same + "--scalar double --answers " + path("answers.jsonl") +
                                 " --out " + path("elsewhere"));
  EXPECT_EQ(live.status, 0) << live.text;
  EXPECT_EQ(graded.status, 0) << graded.text;
  const auto rows = [&](const std::string& run) {
    return read_rows(path(run + "/grades.csv"), {"regime", "index", "task", "answer", "verdict"});
  };
  EXPECT_GT(rows("live").size(), 20U);
  EXPECT_EQ(rows("live"), rows("elsewhere"));
}

// An adapter of a library whose sign is wrong in some versions.
class Adapters : public Peers {
 protected:
  Adapters() {
    std::filesystem::create_directory(path("lib"));
    files::write_text(path("lib/peer.sh"),
                      "case $1 in 1.*) fault=wrong-sign;; *) fault=none;; esac\n"
                      "exec python3 " +
                          std::string(project_folder) +
                          "/tests/harness/peer/hostile.py $fault 0 lib $1\n");
    files::write_text(path("lib/peer.toml"), R"(about = "A library"
licence = "MIT"
kinds = ["pair"]
command = "sh peer.sh {version}"
install = "install lib {version}"
installed = "lib-{version}"
versions = ["1.0", "1.10", "2.0", "3.0"]
settings = "None."
lacks = "Most."
)");
    for (const char* version : {"1.0", "1.10", "2.0"}) {
      files::write_text(path(std::string("lib/lib-") + version), "");
    }
  }
};

TEST_F(Adapters, AreAskedInTheLatestVersionThatIsInstalled) {
  const Ran asked = run_program("query " + pairs() + " --with none --peer " + path("lib"));
  EXPECT_EQ(asked.status, 0) << asked.text;
  EXPECT_THAT(asked.text, HasSubstr("lib@2.0                      separated"));
  const std::string pairs = "query " + this->pairs() + " --peer " + path("lib");
  expect_refusal(pairs + "@3.0", "is not installed; expected it after `install lib 3.0`", folder);
  expect_refusal(pairs + "@4.0", "found the version '4.0'; expected one of 1.0, 1.10, 2.0, 3.0",
                 folder);
}

TEST_F(Adapters, TellInWhichVersionAnswersChanged) {
  ran = run_program("check --groups gap,depth --cases 100 --peer " + path("lib") + "@all --out " +
                    path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("lib double, from 1.10 to 2.0: "));
  EXPECT_THAT(ran.text, Not(HasSubstr("from 1.0 to 1.10")));
  std::vector<std::string> versions;
  for (const auto& row :
       read_rows(path("out/versions.csv"), {"version", "answers", "wrong", "group"})) {
    if (row[3] != "gap") continue;
    versions.push_back(row[0]);
    EXPECT_GT(std::stoi(row[1]), 10);
    EXPECT_EQ(std::stoi(row[2]) > 0, row[0] != "2.0") << row[0];
  }
  EXPECT_THAT(versions, ElementsAre("1.0", "1.10", "2.0"));
  // Each count of wrong answers has a pair, which says what all versions answered.
  std::set<std::string> kept, counted;
  files::for_each_json_line(path("out/wrong_pairs.jsonl"), "a pair", [&](const auto& line) {
    EXPECT_EQ(line.value()["answers"].size(), 3U);
    for (const auto& answer : line.value()["answers"]) {
      const bool is_wrong = answer["grade"] == "wrong";
      EXPECT_EQ(is_wrong, answer["error"].template get<double>() > 1e-4);
      if (!is_wrong) continue;
      kept.insert(answer["algorithm"].template get<std::string>() + " " +
                  line.value()["group"].template get<std::string>());
    }
  });
  for (const auto& row : read_rows(path("out/versions.csv"), {"algorithm", "group", "wrong"})) {
    if (row[2] != "0") counted.insert(row[0] + " " + row[1]);
  }
  EXPECT_GT(counted.size(), 1U);
  EXPECT_EQ(kept, counted);
  EXPECT_FALSE(files::read_cases(path("out/wrong_pairs.jsonl")).empty());
  int changes = 0, right = 0;
  for (const auto& row :
       read_rows(path("out/version_changes.csv"), {"from", "to", "became", "exact"})) {
    EXPECT_THAT(row, ElementsAre("1.10", "2.0", ::testing::AnyOf("right", "other"), ::testing::_));
    ++changes;
    right += row[2] == "right" ? 1 : 0;
  }
  EXPECT_GT(right, 0);
  EXPECT_GT(changes, right) << "tiny gaps are no gross errors";
}

TEST_F(Adapters, AreComparedOnPairsOfAFile) {
  ran = run_program("check " + pairs() + " --with exact --peer " + path("lib") + "@all --out " +
                    path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("lib double, from 1.10 to 2.0: 3 answers became right, 0 wrong"));
  std::map<std::string, int> answers;
  for (const auto& row : read_rows(path("out/grades.csv"), {"algorithm", "regime"})) {
    EXPECT_EQ(row[1], "pairs");
    ++answers[row[0]];
  }
  EXPECT_EQ(answers["lib@2.0"], 3);
  EXPECT_EQ(answers["exact"], 12) << "of four tasks";
  expect_refusal("check " + pairs() + " --kind ray", "FILE has pairs; expected an algorithm",
                 folder);
  expect_refusal("check " + path("absent.jsonl") + " --with gjk", "absent.jsonl", folder);
}

TEST_F(Adapters, FaultsOfTheirFilesHaveTheirPlace) {
  files::write_text(path("lib/peer.toml"), "about = \"A library\"\nlicence = 3\n");
  expect_refusal("query " + pairs() + " --peer " + path("lib"), "peer.toml:2: licence: found 3",
                 folder);
}

TEST_F(Peers, WrongRequestsAreRefused) {
  const std::string pairs = "query " + this->pairs() + " ";
  expect_refusal(pairs + "--peer /nowhere/at-all", "the program left with status 127", folder);
  expect_refusal(pairs + hostile("no-json"), "found 'hello'; expected a first line of JSON",
                 folder);
  const auto says = [&](const std::string& line) {
    files::write_text(path("line"), line + "\n");
    return pairs + "--peer 'cat " + path("line") + "'";
  };
  files::write_text(path("line"), "");
  expect_refusal(says(R"({"name":"x","kinds":{}})"), "no \"protocol\"", folder);
  expect_refusal(says(R"({"protocol":2,"name":"x","kinds":{}})"), "protocol: found 2; expected 1",
                 folder);
  expect_refusal(says(R"({"protocol":1,"name":"X","kinds":{}})"), "name: found 'X'", folder);
  expect_refusal(says(R"({"protocol":1,"name":"gjk","kinds":{"pair":{"tasks":["distance"]}}})"),
                 "an algorithm is called 'gjk' already", folder);
  expect_refusal(says(R"({"protocol":1,"name":"x","kinds":{"pear":{}}})"), "kinds: found \"pear\"",
                 folder);
  expect_refusal(says(R"({"protocol":1,"name":"x","kinds":{"pair":{"tasks":["far"]}}})"),
                 "kinds.pair.tasks[0]: found \"far\"; expected one of intersect, distance", folder);
}

}  // namespace
}  // namespace touchstone
