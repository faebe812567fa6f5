// Tests of `touchstone report`. What a browser shows is tested in plots/page/test.
#include <string>
#include <vector>

#include "tests/harness/commands/program.h"
#include "tests/harness/report/unpacked.h"
#include "tests/harness/stats/sample_file.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

// A page that is nothing but the place of its data.
struct Report : testing::Test {
  TemporaryFolder folder;
  std::string page = " --page " + folder.write("page.html", "<!--BUNDLE-->").string();
  std::string out = " --out " + (folder.path() / "report.html").string();
  std::string results = (folder.path() / "results").string();

  void make_results(const std::string& name = "results") {
    std::filesystem::create_directories(folder.path() / name);
    folder.write(name + "/times.csv", "algorithm,seconds\nmine,1\n");
  }
  // Runs the command, and returns what it put into the page.
  nlohmann::json bundle(const std::string& arguments) {
    const Ran ran = run_program("report " + arguments + page + out);
    EXPECT_EQ(ran.status, 0) << ran.text;
    return ran.status == 0 ? bundle_of(folder.read("report.html")) : nlohmann::json();
  }
  std::vector<std::string> names(const std::string& arguments) {
    std::vector<std::string> all;
    const nlohmann::json whole = bundle(arguments);
    for (const auto& each : whole["results"]) all.push_back(each["name"]);
    return all;
  }
};

TEST_F(Report, IsOneFile) {
  make_results();
  const std::string scene = std::string(project_folder) + "/datasets/shapes.toml";
  const Ran ran = run_program("report " + results + " --scene " + scene + page + out);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("report.html"));
  EXPECT_GT(folder.read("report.html").size(), 1000U);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"page.html", "report.html", "results"}));
}

TEST_F(Report, MakesTheTablesOfARunThatHasRowsAlone) {
  FakeRun run;
  FakeBlock block;
  block.scene = "uniform";
  block.bodies = 1000;
  block.threads = 1;
  block.scene_hash = "hash";
  block.contestants = {{"sweep-one-axis", 1e-6}, {"naive", 1e-5}};
  run.blocks.push_back(block);
  run.write(results);
  const nlohmann::json whole = bundle(results);
  const nlohmann::json& files = whole["results"][0]["files"];
  EXPECT_TRUE(files.contains("raw.csv"));
  EXPECT_THAT(std::string(files.value("times.csv", "")), HasSubstr("sweep-one-axis"));
  EXPECT_THAT(std::string(files.value("ratios.csv", "")), HasSubstr("naive"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results/times.csv"));
}

TEST_F(Report, PlaysTheScenesOfACampaign) {
  const std::string scene = std::string(project_folder) + "/datasets/uniform.toml";
  const std::string campaign =
      folder
          .write("campaign.toml", "name = \"two\"\n[[group]]\nscenes = [\"" + scene +
                                      "\"]\ncounts = [20, 30]\nframes = 2\n[[group]]\nscenes = "
                                      "[\"" +
                                      scene + "\"]\ncounts = 20\nframes = 2\n")
          .string();
  const nlohmann::json scenes = bundle("--scene " + campaign)["scenes"];
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_EQ(scenes[0]["bodies"], 20);
  EXPECT_EQ(scenes[1]["bodies"], 30);
  EXPECT_EQ(scenes[1]["frames"], 2);
  expect_refusal("report --count 5 --scene " + campaign + page + out, "is a campaign", folder);
}

TEST_F(Report, TakesItsOptions) {
  const std::string scene = std::string(project_folder) + "/datasets/uniform.toml";
  const nlohmann::json made =
      bundle("--scene " + scene + " --count 40 --frames 3 --narrow sat,exact --broad kd-tree");
  const nlohmann::json& played = made["scenes"][0];
  EXPECT_EQ(played["bodies"], 40);
  EXPECT_EQ(played["frames"], 3);
  EXPECT_EQ(played["algorithms"], nlohmann::json({"sat", "exact"}));
  ASSERT_EQ(played["structures"].size(), 1U);
  EXPECT_EQ(played["structures"][0]["broad"], "kd-tree");
  EXPECT_EQ(made["origins"]["bullet-sat"].is_null(), false);
  EXPECT_EQ(made["origins"]["sat"], "ours");
  EXPECT_THAT(made["approximate"].get<std::vector<std::string>>(), testing::Contains("sat-faces"));
  EXPECT_THAT(std::string(made["made"]["date"]), HasSubstr(" UTC"));
}

TEST_F(Report, NamesFoldersByTheirOwnNames) {
  make_results();
  make_results("other/results");
  make_results("grids/a/grid");
  make_results("grids/b/grid");
  const std::string path = folder.path().string();
  EXPECT_THAT(names(results), testing::ElementsAre("results"));
  EXPECT_THAT(names(results + "/"), testing::ElementsAre("results"));
  EXPECT_THAT(names(results + " " + path + "/other/results"),
              testing::ElementsAre(results, path + "/other/results"));
  EXPECT_THAT(names(path + "/grids"), testing::ElementsAre("grids/a/grid", "grids/b/grid"));
}

TEST_F(Report, TakesFoldersOfVersions) {
  make_results();
  expect_refusal("report --versions " + results + page + out, "results: no versions.csv in it",
                 folder);
  folder.write("results/versions.csv", "library,version\nlib,1\n");
  const nlohmann::json whole = bundle("--versions " + results);
  EXPECT_TRUE(whole["results"][0]["files"].contains("versions.csv"));
  EXPECT_THAT(std::string(whole["made"]["command"]), HasSubstr("report --versions"));
}

TEST_F(Report, SaysWhatIsMissing) {
  make_results();
  expect_refusal("report" + page + out, "nothing to report", folder);
  expect_refusal("report " + results + page, "--out is required", folder);
  expect_refusal("report " + results + out + " --page nowhere.html", "./touchstone report", folder);
  expect_refusal("report " + results + "-none" + page + out, "expected a folder of results",
                 folder);
  std::filesystem::create_directory(folder.path() / "empty");
  expect_refusal("report " + (folder.path() / "empty").string() + page + out, "no CSV file",
                 folder);
  expect_refusal("report --scene nowhere.toml" + page + out, "nowhere.toml", folder);
  expect_refusal("report " + results + " --narrow none-such" + page + out, "none-such", folder);
  expect_refusal("report " + results + page + " --out /dev/full", "No space left", folder);
  expect_refusal("report " + results + page + " --out " + results + "/none/x.html", "x.html",
                 folder);
}

}  // namespace
}  // namespace touchstone
