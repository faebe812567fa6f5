// Tests that no name of a scene keeps a wrong answer from being recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/campaign/runner.h"
#include "harness/record/findings.h"
#include "tests/harness/campaign/fakes.h"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class SceneNames : public testing::Test {
 protected:
  SceneNames() {
    fakes.fakes = {fake("good", [](int, PairSink&) {}),
                   fake("bad", [](int, PairSink& sink) { sink.chunk(0).push(0, 0); })};
  }
  record::Departure run(const std::string& name) {
    const campaign::Campaign campaign = fakes.campaign(6);
    std::ofstream(fakes.folder.path() / "scene.toml", std::ios::app) << "name = '" << name << "'\n";
    const campaign::RunResult result = campaign::run_campaign(campaign, fakes.out());
    EXPECT_THAT(result.findings.departures(), Not(IsEmpty()));
    const auto rows = record::read_rows<record::Departure>(fakes.out() / "departures.csv");
    return rows.empty() ? record::Departure{} : rows.front();
  }
  FakeCampaign fakes;
};

TEST_F(SceneNames, AFileThatReproducesADepartureIsInItsFolder) {
  for (const std::string& name : {std::string("../../../a/b"), std::string(256, 'x')}) {
    const record::Departure departure = run(name);
    const std::filesystem::path file = departure.reproduction;
    EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
    EXPECT_EQ(file.parent_path().lexically_normal(), fakes.out() / "reproductions/block-0");
  }
}

TEST_F(SceneNames, AFileThatCannotBeWrittenIsANote) {
  std::filesystem::create_directories(fakes.out());
  fakes.folder.write("out/reproductions", "somebody's file");
  const record::Departure departure = run("scene");
  EXPECT_EQ(departure.reproduction, "");
  EXPECT_THAT(departure.what, HasSubstr("; without a file that shows it: "));
  EXPECT_EQ(fakes.folder.read("out/reproductions"), "somebody's file");
}

}  // namespace
}  // namespace touchstone
