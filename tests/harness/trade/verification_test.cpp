// Tests of the verification of advice, and of held-out scenes.
#include "harness/trade/advice/verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "harness/files/csv.h"
#include "harness/trade/advice/advice_files.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/trade/trade_scenes.h"
#include "tests/project_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

struct Small : SmallRequest {
  explicit Small(const std::string& text) : SmallRequest(text, 0.5) {}
  trade::Configuration named(const std::string& narrow) const {
    trade::Configuration configuration;
    configuration.broad = registry::find<BroadPhaseEntry>("sweep-one-axis");
    configuration.narrow = trade::parse_chain(narrow);
    return configuration;
  }
  trade::Verification verified(const trade::Configuration& choice,
                               const trade::ErrorBudget& budget) {
    trade::TradeScene scene(request, representing);
    trade::Configuration complete = choice;
    complete.representations = scene.library.complete(choice.representations);
    return trade::verify({request, scene, representing, budget, [](const auto&) {}}, complete, 3, 2,
                         folder.path() / "grid");
  }
};

const std::string moving = "generator = \"uniform\"\ncount = 80\noverlaps = 6\nframes = 5\n";

TEST(Verification, HoldsTheChoiceAgainstTheGridAndOtherSeeds) {
  Small small(moving);
  const trade::Verification found = small.verified(small.named("gjk"), {.most = 0});
  EXPECT_TRUE(found.within_budget);
  EXPECT_EQ(found.choice.error, 0);
  EXPECT_EQ(found.held_out_on, "seeds 4 to 5");
  ASSERT_EQ(found.held_out.size(), 2u);
  EXPECT_NE(found.held_out[0].errors.near, found.held_out[1].errors.near);
  EXPECT_EQ(found.configurations, 8u);
  EXPECT_GE(found.rivals, 2u);
  EXPECT_LT(found.rivals, 7u);
  EXPECT_FALSE(found.best.empty());
  EXPECT_GT(found.ratio.n, 0u);
  EXPECT_NEAR(found.ratio.median, found.seconds / found.best_seconds, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(small.folder.path() / "grid/points.csv"));
}

TEST(Verification, ABudgetThatIsNotMetIsSaid) {
  Small small(moving);
  const trade::Verification found = small.verified(small.named("none"), {.most = 1e-3});
  EXPECT_FALSE(found.within_budget);
  EXPECT_FALSE(found.holds());
  EXPECT_GT(found.choice.error, 1e-3);
  for (const trade::HeldOutGrade& grade : found.held_out) EXPECT_FALSE(grade.within);
  EXPECT_THAT(trade::verification_text(found), HasSubstr("Not verified"));
}

TEST(Verification, TimesAreJudgedByTheWholeInterval) {
  EXPECT_EQ(trade::time_verdict({1.0, 0.9, 1.1, 9}), trade::TimeVerdict::within);
  EXPECT_EQ(trade::time_verdict({1.0, 0.9, 1.11, 9}), trade::TimeVerdict::undecided);
  EXPECT_EQ(trade::time_verdict({1.2, 1.11, 1.3, 9}), trade::TimeVerdict::beyond);
  EXPECT_EQ(trade::time_verdict({1.0, Outcome::none, Outcome::none, 3}),
            trade::TimeVerdict::undecided);
}

// Number k is an equal scene each time, which differs from the scene itself and from all other
// numbers.
TEST(Verification, HeldOutScenesAreDrawnByTheirNumber) {
  const std::string with_poses =
      "frames = 3\n"
      "[[body]]\nshape = {type = \"box\", half_extents = [1, 1, 1]}\ntranslation = [0, 0, 0]\n"
      "moving = false\n"
      "[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [2.03, 0, 0]\n"
      "velocity = [-1, 0, 0]\n";
  for (const std::string& text : {moving, moving + "seed = 7\n", with_poses}) {
    Small small(text);
    const trade::HeldOutScenes first(small.request, small.representing, 1, 3, 100);
    EXPECT_THAT(first.name(), HasSubstr(text == with_poses ? "starts 1 to 3"
                                        : text == moving   ? "seeds 2 to 4"
                                                           : "seeds 8 to 10"));
    std::set<std::string> hashes = {scene::scene_hash(scene::load_scene(small.request.scene))};
    for (std::size_t i = 0; i < 3; ++i) hashes.insert(scene::scene_hash(first.scene(i)));
    EXPECT_EQ(hashes.size(), 4u);
    const trade::HeldOutScenes again(small.request, small.representing, 3, 1, 100);
    EXPECT_EQ(scene::scene_hash(again.scene(0)), scene::scene_hash(first.scene(2)));
  }
  Small unmoved("[[body]]\nshape = {type = \"sphere\", radius = 1}\ntranslation = [0, 0, 0]\n");
  EXPECT_TRUE(trade::HeldOutScenes(unmoved.request, unmoved.representing, 1, 2, 100).empty());
}

TEST(Verification, ARowSaysWhatCameOut) {
  Small small(moving);
  trade::TradeScene scene(small.request, small.representing);
  const trade::ErrorBudget budget{.most = 0.5};
  const trade::AdviceProblem problem{small.request, scene, small.representing, budget, {}};
  trade::Verification verification;
  verification.choice.error = 0.25;
  verification.held_out = {{"seed 4", 0.5, true}};
  verification.held_out_on = "seed 4";
  verification.within_budget = true;
  verification.best = "other";
  verification.ratio = {1.05, 1, 1.09, 30};
  trade::VerificationRows rows(small.folder.path() / "v", 2);
  rows.write(problem, &verification);
  rows.write(problem, nullptr);
  rows.close();
  std::vector<std::vector<std::string>> found;
  files::CsvReader(small.folder.path() / "v/verification.csv",
                   {"scene", "max_error", "error", "error_1", "error_2", "within_budget", "best",
                    "ratio_high", "within_time", "verified"})
      .read([&](const files::CsvReader::Row& row) {
        std::vector<std::string>& texts = found.emplace_back();
        for (std::size_t i = 0; i < 10; ++i) texts.emplace_back(row.text(i));
      });
  using testing::ElementsAre;
  EXPECT_THAT(
      found, ElementsAre(ElementsAre("scene", "0.5", "0.25", "0.5", "", "yes", "other", "1.09",
                                     "yes", "yes"),
                         ElementsAre("scene", "0.5", "", "", "", "no", "", "", "undecided", "no")));
}

TEST(AdviceList, NamesScenesAndWhatWillDo) {
  const TemporaryFolder folder;
  folder.write("a.toml", moving);
  const auto file = folder.write("list.toml", R"(
[[scene]]
file = "a.toml"
[[scene]]
file = "a.toml"
name = "b"
max_error = 0.25
no_false_negatives = true
task = "distance"
)");
  trade::TradeRequest usual;
  usual.seconds = 7;
  const std::vector<trade::AdviceTask> tasks = trade::read_advice_list(file, usual);
  ASSERT_EQ(tasks.size(), 2u);
  EXPECT_EQ(tasks[0].name, "a");
  EXPECT_EQ(tasks[0].budget.most, 1e-3);
  EXPECT_FALSE(tasks[0].budget.no_false_negatives);
  EXPECT_EQ(tasks[1].name, "b");
  EXPECT_EQ(tasks[1].budget.most, 0.25);
  EXPECT_TRUE(tasks[1].budget.no_false_negatives);
  EXPECT_EQ(tasks[1].request.task, Task::distance);
  EXPECT_EQ(tasks[1].request.measure, trade::ErrorMeasure::greatest);
  EXPECT_EQ(tasks[1].request.seconds, 7);
  EXPECT_TRUE(std::filesystem::exists(tasks[1].request.scene));

  const auto fault = [&](const std::string& text) {
    const auto bad = folder.write("bad.toml", text);
    return folder.without_path(input_fault([&] { trade::read_advice_list(bad, usual); }));
  };
  EXPECT_THAT(fault("a = 1\n"), HasSubstr("bad.toml"));
  const std::string head = "[[scene]]\nfile = \"a.toml\"\n";
  EXPECT_THAT(fault("[[scene]]\nfile = \"none.toml\"\n"), HasSubstr("bad.toml:2: scene 1: file"));
  for (const char* line :
       {"max_error = -1", "max_error = nan", "task = \"touch\"", "name = \"../x\"", "color = 1"}) {
    EXPECT_THAT(fault(head + line + "\n"), HasSubstr("bad.toml:3: scene 1: ")) << line;
  }
  EXPECT_THAT(fault(head + head), HasSubstr("scene 2: name"));
}

// The list is the project's own.
TEST(AdviceList, TheProjectsOwnCanBeRead) {
  const auto tasks = trade::read_advice_list(
      std::filesystem::path(touchstone::project_folder) / "datasets/advice/scenes.toml", {});
  EXPECT_EQ(tasks.size(), 6u);
}

}  // namespace
}  // namespace touchstone
