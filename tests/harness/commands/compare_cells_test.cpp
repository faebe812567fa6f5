// Tests of touchstone compare and show --tables on the results of a campaign of kinds, through the program.
#include <fstream>
#include <string>
#include <vector>

#include "harness/record/raw_row.h"
#include "harness/stats/cell_rows.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::HasSubstr;

// One cell with ours, a peer and one that takes nothing of it, timed in eight rounds.
struct MadeUpCells {
  double ours = 100e-9;     // seconds a query
  std::int64_t missed = 0;  // by ours
  std::string hash = "0011";

  std::string write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    std::vector<stats::GradeRow> grades;
    std::vector<record::RawRow> samples;
    for (const auto& [name, seconds] : {std::pair("first", ours), std::pair("second", 200e-9)}) {
      stats::GradeRow& grade = grades.emplace_back();
      grade.group = "hit";
      grade.cell = "box";
      grade.algorithm = name;
      grade.origin = grades.size() == 1 ? "ours" : "peer";
      grade.queries = grade.graded = 10;
      grade.missed = grades.size() == 1 ? missed : 0;
      grade.status = "ok";
      for (int round = 0; round < 8; ++round) {
        record::RawRow& sample = samples.emplace_back();
        sample.kind = record::RowKind::sample;
        sample.query_kind = "cast";
        sample.input = grade.group;
        sample.family = grade.cell;
        sample.algorithm = name;
        sample.origin = record::row_origin(grades.size() == 1 ? Origin::ours : Origin::peer);
        sample.phase = record::Phase::answer;
        sample.process = 0;
        sample.square = round;
        sample.round = sample.position = 0;
        sample.repeats = 1;
        sample.pair_count = 10;
        sample.seconds = 10 * seconds * (1 + 0.0005 * round);
        sample.status = record::RowStatus::ok;
      }
    }
    grades.push_back(grades[1]);
    grades.back().algorithm = "third";
    grades.back().status = "unsupported";
    record::write_rows(folder / "set_grades.csv", grades);
    record::write_rows(folder / "raw.csv", samples);
    std::ofstream(folder / "machine.csv")
        << "name,value\ncells,made-up\nprocessor,Test CPU\ninstructions_in_use,avx2\n"
        << "cells_hash," << hash << "\n";
    return folder.string();
  }
};

class CompareCells : public testing::Test {
 protected:
  Ran compare(const std::string& options = "") {
    return run_program("compare " + MadeUpCells{}.write(folder_.path() / "a") + " " +
                       b_.write(folder_.path() / "b") + " " + options);
  }
  TemporaryFolder folder_;
  MadeUpCells b_;
};

TEST_F(CompareCells, TheSameIsStatusZero) {
  const Ran ran = compare("--all --csv " + (folder_.path() / "cells.csv").string());
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("hit, box\n"));
  EXPECT_THAT(ran.text, HasSubstr("2 cells: 0 slower, 0 undecided, 2 same"));
  EXPECT_THAT(folder_.read("cells.csv"), HasSubstr("\"hit, box\""));
}

TEST_F(CompareCells, ARegressionIsStatusOne) {
  b_.ours *= 1.1;
  const Ran ran = compare();
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("SLOWER"));
}

TEST_F(CompareCells, OtherAnswersAreStatusOne) {
  b_.missed = 2;
  const Ran ran = compare();
  EXPECT_EQ(ran.status, 1) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("0 missed"));
  EXPECT_THAT(ran.text, HasSubstr("2 missed"));
}

TEST_F(CompareCells, OtherQueriesAreNotComparable) {
  b_.hash = "0022";
  const Ran ran = compare();
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("0022"));
}

TEST_F(CompareCells, TablesAreWrittenAgain) {
  const std::string folder = MadeUpCells{}.write(folder_.path() / "a");
  Ran ran = run_program("show --tables " + folder);
  EXPECT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(folder_.read("a/set_best.csv"), HasSubstr("hit,box,first,second,2"));
  EXPECT_THAT(folder_.read("a/tables.md"), HasSubstr("# Tables of made-up"));
  for (const char* option : {" --noisy", " --band 2", " --depth-error 0.1"}) {
    EXPECT_EQ(run_program("show --tables " + folder + option).status, 2) << option;
  }
  ran = run_program("reproduce --results " + folder);
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("a campaign with kinds"));
  std::filesystem::remove(folder_.path() / "a/raw.csv");
  ran = run_program("show --tables " + folder);
  EXPECT_EQ(ran.status, 2) << ran.text;
  EXPECT_THAT(ran.text, HasSubstr("raw.csv"));
}

}  // namespace
}  // namespace touchstone
