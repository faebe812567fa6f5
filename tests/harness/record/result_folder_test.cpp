// Tests of folders of results: starts, stops, resumption.
#include "harness/record/result_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <set>
#include <string>

#include "harness/record/folder_files.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/packed.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Count {
  std::int64_t unit = 0, value = 0;
  bool operator==(const Count&) const = default;
};
template <record::row_of<Count> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("unit", row.unit, "The unit of work.");
  visit("value", row.value, "A count.");
}

constexpr std::size_t first = 0, second = 1;

class ResultFolderTest : public testing::Test {
 protected:
  record::ResultFolderPlan plan(record::FolderStart start, const std::string& seed = "1") const {
    return {.folder = folder_.path() / "out",
            .files = {{"a.csv", record::header_of<Count>()}, {"b.csv", record::header_of<Count>()}},
            .identity = {{"seed", seed}, {"commit", "abc" + seed}, {"command_line", "run " + seed}},
            .notes = {{"processor", "P" + seed}},
            .start = start,
            .made = {"tables.md"}};
  }
  static void write_unit(record::ResultFolder& folder, bool commit = true) {
    for (std::int64_t i = 0; i < 3; ++i) folder.write(first, Count{folder.units(), i});
    folder.write(second, Count{folder.units(), 9});
    if (commit) folder.commit();
  }
  // Runs the action in a process that ends without any clean-up, as after a kill.
  static int apart(const std::function<void()>& action) {
    const pid_t child = fork();
    if (child == 0) {
      try {
        action();
      } catch (const base::InputError&) {
        _exit(2);
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  }
  std::string fault(const record::ResultFolderPlan& wanted) const {
    return folder_.without_path(input_fault([&] { record::ResultFolder folder(wanted); }));
  }

  TemporaryFolder folder_;
};

TEST_F(ResultFolderTest, GoesOnBehindTheLastWholeUnit) {
  apart([&] {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
    write_unit(folder);
    write_unit(folder, false);
    folder.writer(first).flush();
    _exit(0);
  });
  EXPECT_THAT(folder_.read("out/a.csv"), HasSubstr("2,0"));
  record::ResultFolder folder(plan(record::FolderStart::resume));
  EXPECT_EQ(folder.units(), 2);
  EXPECT_FALSE(folder.was_finished());
  EXPECT_EQ(folder.rows<Count>(first).size(), 6u);
  EXPECT_THAT(folder.rows<Count>(second), ElementsAre(Count{0, 9}, Count{1, 9}));
  write_unit(folder);
  folder.finish({{"result", "good"}});
  EXPECT_EQ(folder_.read("out/b.csv"), "unit,value\n0,9\n1,9\n2,9\n");
  EXPECT_THAT(folder_.read("out/machine.csv"), HasSubstr("result,good\nbegun,20"));
  EXPECT_THAT(folder_.read("out/machine.csv"), HasSubstr(" UTC\nfinished,yes\n"));
  EXPECT_THAT(folder_.read("out/progress.csv"), HasSubstr("units,3\n"));
}

TEST_F(ResultFolderTest, HalfALineIsCutOff) {
  apart([&] {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
    _exit(0);
  });
  folder_.write("out/a.csv", folder_.read("out/a.csv") + "1,");
  EXPECT_EQ(record::ResultFolder(plan(record::FolderStart::resume)).rows<Count>(first).size(), 3u);
}

TEST_F(ResultFolderTest, AKillBeforeTheFirstUnitLosesNothing) {
  apart([&] {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    _exit(0);
  });
  std::filesystem::remove(folder_.path() / "out/progress.csv");
  record::ResultFolder folder(plan(record::FolderStart::resume));
  EXPECT_EQ(folder.units(), 0);
  EXPECT_EQ(folder_.read("out/a.csv"), "unit,value\n");
}

TEST_F(ResultFolderTest, UnfinishedWorkIsNotOverwrittenUnasked) {
  {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
  }
  folder_.write("out/other", "kept");
  folder_.write("out/tables.md", "of the earlier work");
  EXPECT_EQ(fault(plan(record::FolderStart::fresh)),
            "out/a.csv: is of a run that was not finished; expected --resume to go on with it, "
            "--overwrite to lose it, or another --out");
  EXPECT_THAT(folder_.read("out/a.csv"), HasSubstr("0,2"));
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  EXPECT_EQ(folder_.read("out/a.csv"), "unit,value\n");
  EXPECT_EQ(folder_.read("out/other"), "kept");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/tables.md"));
  EXPECT_EQ(fault(plan(record::FolderStart::fresh)), "");  // the earlier work is finished
}

TEST_F(ResultFolderTest, PackedRowsAreRowsOfTheWork) {
  {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
  }
  pack(folder_.path() / "out/a.csv");
  std::filesystem::remove(folder_.path() / "out/b.csv");
  EXPECT_THAT(fault(plan(record::FolderStart::fresh)),
              HasSubstr("out/a.csv.zst: is of a run that was not finished"));
  EXPECT_EQ(fault(plan(record::FolderStart::resume)),
            "out/a.csv.zst: is packed; expected a.csv to resume, which `unzstd` makes of it");
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/a.csv.zst"));
}

TEST_F(ResultFolderTest, OtherWorkIsNotResumed) {
  EXPECT_EQ(fault(plan(record::FolderStart::resume)),
            "out/machine.csv: is not there; expected the folder of a run to resume");
  { record::ResultFolder folder(plan(record::FolderStart::fresh)); }
  EXPECT_EQ(fault(plan(record::FolderStart::resume, "2")),
            "out/machine.csv: seed was '1' and is '2' now; expected the same to resume");
  record::ResultFolderPlan more = plan(record::FolderStart::resume);
  more.identity.emplace_back("cases", "5");
  EXPECT_EQ(fault(more),
            "out/machine.csv: cases was '' and is '5' now; expected the same to resume");
  record::ResultFolderPlan less = plan(record::FolderStart::resume);
  less.identity.erase(less.identity.begin());
  EXPECT_EQ(fault(less),
            "out/machine.csv: seed was '1' and is not known now; expected the same to resume");
  record::ResultFolderPlan columns = plan(record::FolderStart::resume);
  columns.files[0].header = {"unit", "number"};
  EXPECT_THAT(fault(columns), HasSubstr("out/a.csv:1: other columns than this program writes"));
}

TEST_F(ResultFolderTest, TheSourceAndTheCommandMayDiffer) {
  { record::ResultFolder folder(plan(record::FolderStart::fresh)); }
  std::string facts = folder_.read("out/machine.csv");
  const std::size_t begun = facts.find("begun,") + 6;
  folder_.write("out/machine.csv", facts.replace(begun, facts.find('\n', begun) - begun, "then"));
  record::ResultFolderPlan again = plan(record::FolderStart::resume);
  again.identity = {{"seed", "1"}, {"commit", "xyz"}, {"command_line", "run --resume"}};
  again.notes = {{"processor", "Q"}};
  record::ResultFolder(again).finish();
  EXPECT_EQ(folder_.read("out/machine.csv"),
            "name,value\nseed,1\ncommit,abc1\ncommand_line,run 1 && run --resume\nprocessor,Q\n"
            "begun,then\nfinished,yes\n");
  EXPECT_TRUE(record::ResultFolder(again).was_finished());
}

TEST_F(ResultFolderTest, ARowFileThatLostRowsIsRefused) {
  {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
  }
  folder_.write("out/b.csv", "unit,value\n");
  EXPECT_EQ(fault(plan(record::FolderStart::resume)),
            "out/b.csv: 11 bytes; expected at least 15, as progress.csv says");
  std::filesystem::remove(folder_.path() / "out/progress.csv");
  EXPECT_THAT(fault(plan(record::FolderStart::resume)),
              HasSubstr("out/progress.csv: is not there, beside rows in a.csv"));
}

TEST_F(ResultFolderTest, FilesOfOthersStay) {
  std::filesystem::create_directories(folder_.path() / "out/reproductions");
  folder_.write("out/reproductions/mine.jsonl", "mine");
  folder_.write("out/notes.txt", "mine");
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  record::OwnFiles own(folder_.path() / "out");
  const std::filesystem::path taken = own.free_stem("reproductions", "mine");
  EXPECT_EQ(taken.filename(), "mine-2");
  folder_.write("out/reproductions/mine-2.jsonl", "of the program");
  own.note({taken.string() + ".jsonl"});
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  EXPECT_EQ(folder_.read("out/reproductions/mine.jsonl"), "mine");
  EXPECT_EQ(folder_.read("out/notes.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out/reproductions/mine-2.jsonl"));
}

TEST_F(ResultFolderTest, HalfWrittenFilesOfItsOwnAreRemoved) {
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  record::OwnFiles(folder_.path() / "out").note({folder_.path() / "out/summary.txt"});
  const std::set<std::string> ours = {"machine.csv.12-0.tmp", "progress.csv.3-1.tmp",
                                      "files.txt.12-0.tmp", "tables.md.4-0.tmp",
                                      "summary.txt.5-0.tmp"};
  const std::set<std::string> of_others = {"notes.txt.12-0.tmp", "files.txt.tmp",
                                           "files.txt.12-.tmp", "files.txt.12-0x.tmp"};
  for (const std::string& name : ours) folder_.write("out/" + name, "half");
  for (const std::string& name : of_others) folder_.write("out/" + name, "mine");
  record::ResultFolder(plan(record::FolderStart::resume)).finish();
  for (const std::string& name : ours)
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / name)) << name;
  for (const std::string& name : of_others)
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / name)) << name;
}

TEST_F(ResultFolderTest, RowsOfOthersAreNotOverwritten) {
  std::filesystem::create_directories(folder_.path() / "out");
  folder_.write("out/a.csv", "somebody's own");
  EXPECT_EQ(fault(plan(record::FolderStart::overwrite)),
            "out/a.csv: was not written by this program; expected another folder for the run, or "
            "that file elsewhere");
  EXPECT_EQ(folder_.read("out/a.csv"), "somebody's own");
}

TEST_F(ResultFolderTest, LinksAreNotFollowedOutOfTheFolder) {
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  std::filesystem::create_directories(folder_.path() / "away");
  folder_.write("away/x.jsonl", "mine");
  folder_.write("away/a.csv", "mine");
  std::filesystem::create_directory_symlink(folder_.path() / "away",
                                            folder_.path() / "out/reproductions");
  folder_.write("out/files.txt", "reproductions/x.jsonl\n");
  EXPECT_THAT(input_fault([&] {
                record::OwnFiles(folder_.path() / "out").free_stem("reproductions", "y");
              }),
              HasSubstr("is reached by a symbolic link"));
  record::ResultFolder(plan(record::FolderStart::overwrite)).finish();
  EXPECT_EQ(folder_.read("away/x.jsonl"), "mine");
  folder_.write("out/files.txt", "../away/x.jsonl\n");
  EXPECT_EQ(fault(plan(record::FolderStart::overwrite)),
            "out/files.txt:1: found '../away/x.jsonl'; expected the path of a file in the folder");
  std::filesystem::remove(folder_.path() / "out/files.txt");
  std::filesystem::remove(folder_.path() / "out/a.csv");
  std::filesystem::create_symlink(folder_.path() / "away/a.csv", folder_.path() / "out/a.csv");
  EXPECT_THAT(fault(plan(record::FolderStart::resume)), HasSubstr("out/a.csv: is no regular file"));
  EXPECT_THAT(fault(plan(record::FolderStart::overwrite)), HasSubstr("was not written by this"));
  EXPECT_EQ(folder_.read("away/a.csv"), "mine");
}

TEST_F(ResultFolderTest, RowsThatAreNotThoseOfTheProgressAreRefused) {
  {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
    write_unit(folder);
  }
  const std::string progress = folder_.read("out/progress.csv");
  const std::string rows = folder_.read("out/a.csv");
  const auto refused = [&](const std::string& from, const std::string& to) {
    std::string changed = progress;
    folder_.write("out/progress.csv", changed.replace(changed.find(from), from.size(), to));
    const std::string found = fault(plan(record::FolderStart::resume));
    folder_.write("out/progress.csv", progress);
    EXPECT_EQ(folder_.read("out/a.csv"), rows);
    return found;
  };
  // A smaller number would drop rows of whole units, and other units would do some again.
  EXPECT_THAT(refused("a.csv,35", "a.csv,23"), HasSubstr("out/a.csv: its first 23 bytes have the"));
  EXPECT_THAT(refused("units,2", "units,1"), HasSubstr("of the rows of 1 units"));
  EXPECT_THAT(refused("a.csv hash", "a.csv nothing"), HasSubstr("expected one of the rows"));
  std::string other = rows;
  folder_.write("out/a.csv", other.replace(other.find("1,2"), 3, "1,1"));
  EXPECT_THAT(fault(plan(record::FolderStart::resume)), HasSubstr("out/a.csv: its first 35 bytes"));
  folder_.write("out/a.csv", rows);
  EXPECT_EQ(fault(plan(record::FolderStart::resume)), "");
}

TEST_F(ResultFolderTest, FinishedWorkIsNotCut) {
  {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
    folder.finish();
  }
  const std::string rows = folder_.read("out/a.csv") + "7,7\n";
  folder_.write("out/a.csv", rows);
  EXPECT_EQ(fault(plan(record::FolderStart::resume)),
            "out/a.csv: 27 bytes; expected 23 of a run that is finished, as progress.csv says");
  EXPECT_EQ(folder_.read("out/a.csv"), rows);
}

TEST_F(ResultFolderTest, FinishedWorkThatGoesOnIsNotFinished) {
  {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    write_unit(folder);
    folder.finish();
  }
  record::ResultFolder folder(plan(record::FolderStart::resume));
  EXPECT_THAT(folder_.read("out/machine.csv"), HasSubstr("finished,yes"));
  write_unit(folder);
  EXPECT_THAT(folder_.read("out/machine.csv"), HasSubstr("finished,no"));
  folder.finish();
  EXPECT_THAT(folder_.read("out/machine.csv"), HasSubstr("finished,yes"));
}

TEST_F(ResultFolderTest, IsForOneProcess) {
  record::ResultFolder folder(plan(record::FolderStart::fresh));
  EXPECT_EQ(fault(plan(record::FolderStart::overwrite)),
            "out: another run is at work in it; expected a folder for each");
}

TEST_F(ResultFolderTest, AFullDiskLosesTheUnitAtHandAlone) {
  const int status = apart([&] {
    record::ResultFolder folder(plan(record::FolderStart::fresh));
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    for (int i = 0; i < 1000; ++i) write_unit(folder);
  });
  EXPECT_EQ(status, 2);
  record::ResultFolder folder(plan(record::FolderStart::resume));
  EXPECT_GT(folder.units(), 40);
  EXPECT_EQ(static_cast<std::int64_t>(folder.rows<Count>(first).size()), 3 * folder.units());
  EXPECT_EQ(static_cast<std::int64_t>(folder.rows<Count>(second).size()), folder.units());
}

}  // namespace
}  // namespace touchstone
