// Tests whole checks with planted algorithms and regimes.
#include "harness/check/check_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/files/csv.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class CheckRun : public ::testing::Test {
 protected:
  check::CheckRequest request_for(const std::vector<const NarrowPhaseEntry*>& narrow) {
    check::CheckRequest request;
    request.scalars = {Precision::float64};
    ask(request, narrow);
    draw(request, balls);
    request.cases = 8;
    request.time_limit = 0.3;
    request.out = folder.path() / "out";
    return request;
  }
  std::string read(const std::string& name) const { return folder.read("out/" + name); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out")) {
      all.push_back(entry.path().filename().string());
    }
    return all;
  }
  static const kinds::CaseChecker& cases(const check::CheckReport& result) {
    return result.of<kinds::CaseChecker>();
  }
  // Returns the counts of the only algorithm in the only regime.
  static const grade::AnswerCount& count(const check::CheckReport& result) {
    return cases(result).answers().begin()->second;
  }

  TemporaryFolder folder;
  kinds::Regime balls = balls_regime();
};

TEST_F(CheckRun, AnAlgorithmThatIsRight) {
  const NarrowPhaseEntry entry = planted<Harm::none>("good", Origin::ours);
  const check::CheckRequest request = request_for({&entry});
  const auto result = check::run_check(request);
  EXPECT_THAT(result.ours_wrong(), IsEmpty());
  EXPECT_EQ(count(result).answers, 8 * 3);
  EXPECT_EQ(count(result).silent, 0);
  EXPECT_LT(count(result).distance, 1e-12);
  EXPECT_LT(count(result).too_deep, 1e-12);
  EXPECT_THAT(cases(result).failures(), IsEmpty());
  ASSERT_THAT(cases(result).jobs(), SizeIs(1));
  EXPECT_EQ(cases(result).jobs()[0].boxes, 8 * 4);
  EXPECT_EQ(cases(result).jobs()[0].boxes_broken, 0);
  EXPECT_EQ(cases(result).jobs()[0].proven, 2);
  EXPECT_EQ(cases(result).jobs()[0].refused, 0);
  for (const char* name :
       {"grades.csv", "variants.csv", "jobs.csv", "progress.csv", "summary.csv", "machine.csv"}) {
    EXPECT_THAT(names(), Contains(name));
  }
  EXPECT_THAT(check::summary_text(result, 120),
              HasSubstr("None of our own algorithms is wrong beyond its margin."));
}

struct HarmCase {
  Harm harm;
  NarrowPhaseEntry (*entry)(const std::string&, Origin);
  std::int64_t grade::AnswerCount::*counted;  // the count in which the harm shows
  std::int64_t expected;
  bool is_fault;      // fault if the algorithm is ours
  std::string words;  // words of the report

  friend void PrintTo(const HarmCase& harm, std::ostream* out) {
    *out << static_cast<int>(harm.harm);
  }
};

class CheckRunHarm : public CheckRun, public ::testing::WithParamInterface<HarmCase> {};

TEST_P(CheckRunHarm, IsFoundInOursAndInAPeers) {
  const HarmCase& harm = GetParam();
  for (const Origin origin : {Origin::ours, Origin::peer}) {
    const NarrowPhaseEntry entry = harm.entry("bad", origin);
    const check::CheckRequest request = request_for({&entry});
    const auto result = check::run_check(request);
    if (harm.counted != nullptr) {
      EXPECT_EQ(count(result).*harm.counted, harm.expected);
    }
    const bool ours = origin == Origin::ours;
    const std::vector<std::string> wrong = result.ours_wrong();
    EXPECT_EQ(!wrong.empty(), ours && harm.is_fault);
    if (!harm.is_fault) continue;
    ASSERT_THAT(cases(result).failures(), Not(IsEmpty()));
    const kinds::FailureCase& failure = cases(result).failures().front();
    const std::string command = failure.command(cases(result).subjects());
    EXPECT_THAT(failure.what,
                HasSubstr(ours || harm.words != "does not separate" ? harm.words : ""));
    if (ours) {
      EXPECT_THAT(wrong, Contains(HasSubstr(failure.what)));
      EXPECT_THAT(check::summary_text(result, 120), HasSubstr(command));
    }
    // The case file has a case that shows the fault.
    const std::vector<files::Case> cases = files::read_cases(failure.file);
    ASSERT_THAT(cases, Not(IsEmpty()));
    EXPECT_THAT(command, HasSubstr("--narrow bad --task "));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Harms, CheckRunHarm,
    ::testing::Values(HarmCase{Harm::wrong_side, planted<Harm::wrong_side>,
                               &grade::AnswerCount::silent, 12, true, "called"},
                      HarmCase{Harm::wrong_depth, planted<Harm::wrong_depth>, nullptr, 0, true,
                               "by"},
                      HarmCase{Harm::bad_bounds, planted<Harm::bad_bounds>,
                               &grade::AnswerCount::bounds, 12, true, "bounds miss"},
                      HarmCase{Harm::gives_up, planted<Harm::gives_up>, &grade::AnswerCount::honest,
                               12, false, ""},
                      HarmCase{Harm::crashes, planted<Harm::crashes>, &grade::AnswerCount::crashed,
                               12, true, "crashed"},
                      HarmCase{Harm::nan, planted<Harm::nan>, &grade::AnswerCount::not_a_number, 4,
                               true, "NaN"}));

// The contract asks for witness points. Some libraries have none.
TEST_F(CheckRun, ADistanceOfOursNeedsWitnessPoints) {
  const NarrowPhaseEntry peer = planted<Harm::no_points>("bad", Origin::peer);
  EXPECT_THAT(check::run_check(request_for({&peer})).ours_wrong(), IsEmpty());
  const NarrowPhaseEntry entry = planted<Harm::no_points>("bad", Origin::ours);
  check::CheckRequest request = request_for({&entry});
  request.out = folder.path() / "ours";
  const auto result = check::run_check(request);
  EXPECT_EQ(count(result).beyond, 2);
  EXPECT_THAT(result.ours_wrong(), Contains(HasSubstr("normal or witness points")));
}

TEST_F(CheckRun, AHangIsARow) {
  const NarrowPhaseEntry entry = planted<Harm::hangs>("bad", Origin::ours);
  check::CheckRequest request = request_for({&entry});
  request.cases = 2;
  request.time_limit = 0.1;
  const auto result = check::run_check(request);
  EXPECT_EQ(count(result).timed_out, 6);
  EXPECT_THAT(result.ours_wrong(), Contains(HasSubstr("no answer in time")));
  EXPECT_THAT(read("grades.csv"), HasSubstr("timed_out"));
}

// The algorithm is wrong on one side only, so its answer for the swapped pair differs.
TEST_F(CheckRun, AnotherFormOfAPairHasTheSameAnswer) {
  const NarrowPhaseEntry entry = planted<Harm::wrong_side>("bad", Origin::ours);
  const check::CheckRequest request = request_for({&entry});
  const auto result = check::run_check(request);
  const kinds::FlipCount& flips = cases(result).flips().begin()->second;
  EXPECT_GT(flips.compared, 0);
  EXPECT_GT(flips.flips, 0);
  EXPECT_GT(flips.beyond, 0);
  EXPECT_NEAR(flips.worst_flip, 0.25, 0.02);
  EXPECT_THAT(result.ours_wrong(), Contains(HasSubstr("in another form differ")));
  ASSERT_THAT(cases(result).variant_failures(), Not(IsEmpty()));
  EXPECT_GE(files::read_cases(cases(result).variant_failures()[0].file).size(), 2u);
  EXPECT_THAT(read("variants.csv"), HasSubstr(",swap,"));
}

TEST_F(CheckRun, TheRowsSayWhatTheSummarySays) {
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const NarrowPhaseEntry bad = planted<Harm::wrong_side>("bad", Origin::peer);
  const check::CheckRequest request = request_for({&good, &bad});
  check::run_check(request);
  std::map<std::string, std::map<std::string, int>> verdicts;
  files::CsvReader(request.out / "grades.csv", {"algorithm", "verdict", "margin", "size", "group"})
      .read([&](const files::CsvReader::Row& row) {
        ++verdicts[std::string(row.text(0))][std::string(row.text(1))];
        EXPECT_EQ(row.text(1) == "silent_error", !row.text(2).empty());
        EXPECT_EQ(row.number(3), 2);
        EXPECT_EQ(row.text(4), "test");
      });
  EXPECT_EQ(verdicts["good"]["right"], 24);
  EXPECT_EQ(verdicts["bad"]["right"], 12);
  EXPECT_EQ(verdicts["bad"]["silent_error"], 12);
  int rows = 0;
  files::CsvReader(request.out / "summary.csv",
                   {"algorithm", "regime", "answers", "silent", "margin"})
      .read([&](const files::CsvReader::Row& row) {
        ++rows;
        EXPECT_EQ(row.text(1), "balls");
        EXPECT_EQ(row.integer(2), 24);
        EXPECT_EQ(row.integer(3), row.text(0) == "bad" ? 12 : 0);
      });
  EXPECT_EQ(rows, 2);
}

TEST_F(CheckRun, ThePage) {
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const NarrowPhaseEntry bad = planted<Harm::wrong_side>("bad", Origin::peer);
  const check::CheckRequest request = request_for({&good, &bad});
  const auto result = check::run_check(request);
  const std::string page = check::page_text(result, "touchstone check --cases 8");
  EXPECT_THAT(page, HasSubstr("# Who is wrong where"));
  EXPECT_THAT(page, HasSubstr("`touchstone check --cases 8` (seed 1, 8 cases"));
  EXPECT_THAT(page, HasSubstr("| good double | 24 | 0 | - | 0 | - |"));
  EXPECT_THAT(page, HasSubstr("| bad double | 24 | 12 | 3e-01 | 12 | 3e-01 |"));
  EXPECT_THAT(page, HasSubstr("| algorithm | test |\n|---|---:|\n| good double | 0 |\n"
                              "| bad double | 12 (3e-01) |\n"));
  EXPECT_THAT(page, HasSubstr("called "));
}

TEST_F(CheckRun, ShrunkCasesStillFail) {
  const NarrowPhaseEntry bad = planted<Harm::wrong_side>("bad", Origin::ours);
  const check::CheckRequest request = request_for({&bad});
  const auto result = check::run_check(request);
  ASSERT_THAT(cases(result).failures(), Not(IsEmpty()));
  for (const kinds::FailureCase& failure : cases(result).failures()) {
    EXPECT_EQ(failure.answer.given.verdict, grade::Verdict::silent_error);
    for (const files::Case& c : files::read_cases(failure.file)) {
      EXPECT_GT((c.pose_b.translation - c.pose_a.translation).x(), 0);
    }
  }
}

TEST_F(CheckRun, RoundsGoOnForAsLongAsAsked) {
  const NarrowPhaseEntry entry = planted<Harm::none>("good", Origin::ours);
  check::CheckRequest request = request_for({&entry});
  const kinds::Regime other = balls_regime("more-balls");
  draw(request, other);
  request.seconds = 0.5;
  const base::Stopwatch watch;
  const auto result = check::run_check(request);
  EXPECT_GE(watch.seconds(), 0.5);
  EXPECT_GE(cases(result).jobs().size(), 3u);
  for (std::size_t i = 0; i < cases(result).jobs().size(); ++i) {
    EXPECT_EQ(cases(result).jobs()[i].round, i / 2);
    EXPECT_EQ(cases(result).jobs()[i].regime, i % 2);
  }
  // No case comes twice.
  std::map<std::string, int> seen;
  files::CsvReader(request.out / "grades.csv", {"regime", "index", "task"})
      .read([&](const files::CsvReader::Row& row) {
        ++seen[fmt::format("{} {} {}", row.text(0), row.text(1), row.text(2))];
      });
  EXPECT_EQ(seen.size(), cases(result).jobs().size() * 8 * 3);
}

TEST_F(CheckRun, BoxesOfBodiesAreChecked) {
  const NarrowPhaseEntry entry = planted<Harm::none>("good", Origin::ours);
  kinds::Regime all{
      .name = "mixed", .group = "test", .what = "any", .draw = [](kinds::RegimeDraw& draw) {
        return kinds::find_regime("random-mixed")->draw(draw);
      }};
  check::CheckRequest request = request_for({&entry});
  request.families.clear();
  draw(request, all);
  request.cases = 20;
  const auto result = check::run_check(request);
  EXPECT_EQ(cases(result).jobs()[0].boxes, 80);
  EXPECT_EQ(cases(result).jobs()[0].boxes_broken, 0);
}

}  // namespace
}  // namespace touchstone
