// Tests of `touchstone report`. What a browser shows is tested in plots/page/test.
#include <string>

#include "tests/harness/commands/program.h"
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

  void make_results() {
    std::filesystem::create_directory(results);
    folder.write("results/times.csv", "algorithm,seconds\nmine,1\n");
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

TEST_F(Report, PlaysTheScenesOfACampaign) {
  const std::string scene = std::string(project_folder) + "/datasets/uniform.toml";
  const std::string campaign =
      folder
          .write("campaign.toml", "name = \"two\"\n[[group]]\nscenes = [\"" + scene +
                                      "\"]\ncounts = [20, 30]\nframes = 2\n[[group]]\nscenes = "
                                      "[\"" +
                                      scene + "\"]\ncounts = 20\nframes = 2\n")
          .string();
  const Ran ran = run_program("report --scene " + campaign + page + out);
  EXPECT_EQ(ran.status, 0) << ran.text;
  expect_refusal("report --count 5 --scene " + campaign + page + out, "is a campaign", folder);
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
