// Tests of --with and a module.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "harness/files/text_file.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/modules/built_module.h"
#include "tests/harness/temporary_folder.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class ModuleFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  std::string module_with(const std::string& fault) const {
    return built_module(folder.path(), fault);
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
  // Two frames: of two boxes that overlap, and with a third that overlaps both.
  std::string boxes() const {
    files::write_text(path("boxes.csv"),
                      "frame,id,min_x,min_y,min_z,max_x,max_y,max_z\n0,0,0,0,0,1,1,1\n"
                      "0,1,1,0,0,2,1,1\n1,0,0,0,0,1,1,1\n1,1,1,0,0,2,1,1\n1,2,0,0,0,2,1,1\n");
    return path("boxes.csv");
  }
  std::string scene() const {
    files::write_text(path("spheres.toml"),
                      "generator = \"uniform\"\ncount = 60\noverlaps = 2\nshapes = [\"sphere\"]\n");
    return path("spheres.toml");
  }
  std::vector<std::string> statuses(const std::string& fault) {
    ran = run_program("query " + pairs() + " --task distance --time-limit 2 --with " +
                      module_with(fault) + " --out " + path("out.csv"));
    EXPECT_EQ(ran.status, 0) << ran.text;
    std::vector<std::string> all;
    for (const auto& row : read_rows(path("out.csv"), {"status"})) all.push_back(row[0]);
    return all;
  }

  TemporaryFolder folder;
  Ran ran;
};

TEST_F(ModuleFiles, TheTemplateIsBuiltOutsideOfTheTreeAndRight) {
  const std::string home = std::string(project_folder) + "/algorithms/module";
  std::filesystem::copy(home + "/template", folder.path() / "mine");
  ran =
      run_shell("cmake -S " + path("mine") + " -B " + path("mine/build") +
                " -DTOUCHSTONE_MODULE_INCLUDE=" + home + " && cmake --build " + path("mine/build"));
  ASSERT_EQ(ran.status, 0) << ran.text;
  const std::string file = path("mine/build/libmine.so");
  ran = run_program("check --with " + file + " --cases 100 --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("1 of 1 broad phases find all pairs"));
  std::map<std::string, int> verdicts;
  for (const auto& row : read_rows(path("out/grades.csv"), {"verdict"})) ++verdicts[row[0]];
  EXPECT_GT(verdicts["right"], 100);
  EXPECT_THAT(ran.text, HasSubstr("None of the modules' algorithms is wrong beyond its margin"));
  ran = run_program("query " + pairs() + " --with exact," + file);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("mine-spheres                 1 (exact)"));
  ran = run_program("query " + boxes() + " --with " + file + ",naive --out " + path("pairs.csv"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(
      read_rows(path("pairs.csv"), {"frame", "algorithm", "pair_count", "status"}),
      ElementsAre(ElementsAre("0", "mine-boxes", "1", "ok"), ElementsAre("0", "naive", "1", "ok"),
                  ElementsAre("1", "mine-boxes", "3", "ok"), ElementsAre("1", "naive", "3", "ok")));
}

TEST_F(ModuleFiles, TheTemplateIsBuiltByOneLine) {
  const std::string home = std::string(project_folder) + "/algorithms/module";
  ran = run_shell("cc -std=c99 -Wall -Wextra -Wpedantic -Werror -O2 -shared -fPIC -I" + home +
                  " -o " + path("libmine.so") + " " + home + "/template/mine.c -lm");
  ASSERT_EQ(ran.status, 0) << ran.text;
  ran = run_program("list --format csv --with " + path("libmine.so"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("mine-boxes,box,module,true,"));
  EXPECT_THAT(ran.text, HasSubstr("mine-spheres,pair,module,true,"));
}

TEST_F(ModuleFiles, AWrappedLibraryFindsAllPairs) {
  if (!std::filesystem::exists("/usr/include/spatialindex/SpatialIndex.h")) {
    GTEST_SKIP() << "libspatialindex is not installed (Debian: libspatialindex-dev)";
  }
  const std::string home = std::string(project_folder) + "/algorithms/module";
  ran = run_shell("c++ -std=c++17 -O2 -shared -fPIC -I" + home + " -o " + path("rtree.so") + " " +
                  home + "/spatialindex/spatialindex.cpp -lspatialindex");
  ASSERT_EQ(ran.status, 0) << ran.text;
  ran = run_program("check --with " + path("rtree.so") + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("1 of 1 broad phases find all pairs"));
}

TEST_F(ModuleFiles, OfFurtherKindsAreGraded) {
  const std::string file = compiled_module(folder.path(), "kinds.cpp", "kinds", "-O1");
  ran = run_program("check --scalar double --cases 40 --kind ray,point,mesh,cast,feature --with " +
                    file + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::map<std::string, int> right;  // by kind
  for (const auto& row : read_rows(path("out/families.csv"),
                                   {"algorithm", "right", "missed", "false_hits", "failed"})) {
    right[row[0].substr(0, row[0].find(' '))] += std::stoi(row[1]);
    EXPECT_THAT(row, ElementsAre(HasSubstr("easy"), row[1], "0", "0", "0"));
  }
  for (const char* kind : {"ray", "point", "mesh", "cast", "feature"})
    EXPECT_GT(right[kind], 10) << kind;
}

TEST_F(ModuleFiles, AModuleIsTimedBesideOthers) {
  const std::string file = module_with("none");
  ran = run_program("run --scene " + scene() +
                    " --broad naive,sweep-one-axis --narrow gjk --scalar double "
                    "--concave none --threads 1 --frames 1 --seconds 0.3 --noisy --with " +
                    file + " --out " + path("out"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::set<std::string> sampled;
  for (const auto& row :
       read_rows(path("out/raw.csv"), {"kind", "broad", "narrow", "origin", "status"})) {
    if (row[3] != "module") continue;
    EXPECT_EQ(row[4], "ok");
    if (row[0] == "sample") sampled.insert(row[2].empty() ? row[1] : row[2]);
  }
  EXPECT_THAT(sampled, Contains("mine-boxes"));
  EXPECT_THAT(sampled, Contains("mine-spheres"));
  EXPECT_THAT(ran.text, HasSubstr("YOURS     mine-boxes"));
}

TEST_F(ModuleFiles, AdviceTriesAModule) {
  const std::string file = module_with("none");
  ran = run_program("advise " + scene() +
                    " --front --no-figure --threads 1 --frames 1 --seconds 1 --with " + file +
                    " --out " + path("trade"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  std::set<std::string> tried;
  for (const auto& row : read_rows(path("trade/points.csv"), {"broad", "narrow"}))
    tried.insert(row.begin(), row.end());
  EXPECT_THAT(tried, Contains("mine-boxes"));
  EXPECT_THAT(tried, Contains("mine-spheres"));
  // Its file of the work names the module.
  EXPECT_THAT(files::read_text(path("trade/trade.toml")), HasSubstr("modules = [\"../none.so\"]"));
  ran = run_program("run " + path("trade/trade.toml") + " --out " + path("again"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(read_rows(path("again/points.csv"), {"broad"}), Contains(ElementsAre("mine-boxes")));
  expect_refusal("advise " + scene() + " --max-error 0 --with gjk --out " + path("no"),
                 "--with: found 'gjk'; expected the file of a module", folder);
}

TEST_F(ModuleFiles, APageShowsAModule) {
  const std::string file = module_with("none");
  files::write_text(path("page.html"), "<!--BUNDLE-->");
  ran = run_program("report --scene " + scene() + " --frames 1 --page " + path("page.html") +
                    " --with " + file + " --out " + path("report.html"));
  EXPECT_EQ(ran.status, 0) << ran.text;
  files::write_text(path("unpack.py"),
                    "import base64, re, sys, zlib\n"
                    "packed = re.search('[A-Za-z0-9+/=]{200,}', open(sys.argv[1]).read())[0]\n"
                    "print(zlib.decompress(base64.b64decode(packed)).decode())\n");
  ran = run_shell("python3 " + path("unpack.py") + " " + path("report.html"));
  EXPECT_THAT(ran.text, HasSubstr("\"mine-spheres\":\"module\""));
  const std::string kinds = compiled_module(folder.path(), "kinds.cpp", "kinds", "-O1");
  expect_refusal("report --scene " + scene() + " --page " + path("page.html") + " --with " + kinds +
                     " --out " + path("no.html"),
                 "has neither narrow nor broad phases", folder);
}

TEST_F(ModuleFiles, ACampaignNamesModules) {
  module_with("none");
  scene();
  files::write_text(
      path("campaign.toml"),
      "name = \"of-a-module\"\nmodules = [\"none.so\"]\nscenes = [\"spheres.toml\"]\n"
      "broad = [\"naive\", \"modules\"]\nnarrow = [\"mine-spheres\"]\nconcave = [\"none\"]\n"
      "frames = 1\nthreads = 1\nseconds = 0.3\n");
  ran = run_program("run " + path("campaign.toml") + " --dry-run");
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("naive, mine-boxes"));
  EXPECT_THAT(ran.text, HasSubstr("mine-spheres"));
  files::write_text(path("campaign.toml"),
                    "modules = [\"none-such.so\"]\nscenes = [\"spheres.toml\"]\n");
  expect_refusal("run " + path("campaign.toml"), "none-such.so: No such file or directory", folder);
}

TEST_F(ModuleFiles, WrongAnswersEndWithStatus1) {
  ran = run_program("check --groups gap,depth --cases 60 --with " + module_with("off") + " --out " +
                    path("out"));
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("mine-spheres"));
  ran = run_program("check --kind box --with " + module_with("drops") + " --out " + path("boxes"));
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("mine-boxes on boxes"));
  ran = run_program("run --scene " + scene() +
                    " --broad naive --narrow none --concave none --threads 1 --frames 1 "
                    "--seconds 0.3 --with " +
                    path("drops.so") + " --out " + path("run"));
  EXPECT_EQ(ran.status, 1) << ran.text;
  std::set<std::string> wrong;
  for (const auto& row : read_rows(path("run/departures.csv"), {"algorithm"})) wrong.insert(row[0]);
  EXPECT_THAT(wrong, ElementsAre("mine-boxes"));
}

TEST_F(ModuleFiles, FailuresBecomeRowsAndTheWorkGoesOn) {
  EXPECT_THAT(statuses("none"), ElementsAre("ok", "ok", "ok"));
  EXPECT_THAT(statuses("throws"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(ran.text, HasSubstr("threw: thrown by the module"));
  EXPECT_THAT(statuses("throws_number"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(statuses("crashes"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(ran.text, HasSubstr("killed by signal 11"));
  EXPECT_THAT(statuses("exits"), ElementsAre("ok", "crashed", "ok"));
  EXPECT_THAT(statuses("hangs"), ElementsAre("ok", "timed_out", "ok"));
  EXPECT_THAT(statuses("garbage"), ElementsAre("ok", "garbage", "ok"));
  EXPECT_THAT(statuses("prints"), ElementsAre("ok", "ok", "ok"));
  EXPECT_THAT(ran.text, Not(HasSubstr("printed by the module")));
}

TEST_F(ModuleFiles, FailuresOfBoxesAreRowsOfARun) {
  for (const char* fault :
       {"throws_boxes", "crashes_boxes", "exits_boxes", "wild", "status", "no_instance"}) {
    ran = run_program("run --scene " + scene() +
                      " --broad naive --narrow none --concave none --threads 1 --frames 1 "
                      "--seconds 0.3 --with " +
                      module_with(fault) + " --out " + path(fault));
    EXPECT_EQ(ran.status, 1) << fault << "\n" << ran.text;
    std::set<std::string> lost;
    for (const auto& row : read_rows(path(std::string(fault) + "/departures.csv"), {"algorithm"}))
      lost.insert(row[0]);
    EXPECT_THAT(lost, ElementsAre("mine-boxes")) << fault;
  }
}

TEST_F(ModuleFiles, WhatIsAskedOfModulesIsChecked) {
  expect_refusal("query " + pairs() + " --with ./none.so", "none.so: No such file or directory",
                 folder);
  const std::string file = module_with("none");
  pairs();
  files::write_text(
      path("rays.csv"),
      "origin_x,origin_y,origin_z,direction_x,direction_y,direction_z\n0,0,5,0,0,-1\n");
  files::write_text(path("mesh.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  expect_refusal("query " + path("rays.csv") + " --in " + path("mesh.off") + " --with " + file,
                 "has no ray cast", folder);
  expect_refusal("run --with gjk --out " + path("out"),
                 "--with: found 'gjk'; expected the file of a module", folder);
  expect_refusal("list --with gjk", "--with: found 'gjk'; expected the file of a module", folder);
}

}  // namespace
}  // namespace touchstone
