// Tests that a run that is stopped at any moment and resumed has the rows of an uninterrupted run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/campaign/runner.h"
#include "tests/harness/campaign/stopped_run.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

class Resume : public testing::Test {
 protected:
  Resume() {
    folder_.write("scene.toml",
                  "generator = 'uniform'\ncount = 40\nframes = 3\noverlaps = 4\n"
                  "shapes = ['box', 'sphere']\n");
    folder_.write("c.toml",
                  "scenes = 'scene.toml'\ncounts = [30, 40]\nbroad = ['naive', 'uniform-grid']\n"
                  "narrow = ['gjk', 'sat']\nwarm = [false, true]\nscalars = 'double'\nsquares = "
                  "6\nseconds = 0.05\n"
                  "threads = 1\n");
  }
  campaign::Campaign campaign() const { return campaign::read_campaign(folder_.path() / "c.toml"); }
  std::filesystem::path out(const std::string& name) const { return folder_.path() / name; }

  // The identifying columns of rows, with the number of rows that have them.
  using Key = std::tuple<record::RowKind, std::int64_t, std::string,
                         std::optional<record::QueryTask>, std::string, bool, std::int64_t,
                         std::int64_t, std::int64_t, std::int64_t, record::Phase, bool>;
  static std::map<Key, int> keys(const std::filesystem::path& out) {
    std::map<Key, int> keys;
    for (const record::RawRow& row : record::read_rows<record::RawRow>(out / "raw.csv")) {
      const std::int64_t frame = row.kind == record::RowKind::check ? row.frame : -1;
      ++keys[{row.kind, row.block, record::label_of(row), row.task, row.pair_kind, row.is_twin(),
              row.process, row.square, row.round * 100 + row.position, frame, row.phase,
              row.stop.empty()}];
    }
    return keys;
  }

  // Runs in a process of its own and returns its status, as from waitpid. `seconds` < 0: not
  // killed.
  int run_apart(
      const std::string& name, record::FolderStart start, double seconds,
      const std::function<void()>& prepare = [] {}) const {
    const pid_t child = fork();
    if (child == 0) {
      prepare();
      try {
        campaign::run_campaign(campaign(), out(name), start);
      } catch (const std::exception&) {
        _exit(2);
      }
      _exit(0);
    }
    if (seconds >= 0) {
      const timespec time{static_cast<time_t>(seconds),
                          static_cast<long>(1e9 * (seconds - static_cast<int>(seconds)))};
      nanosleep(&time, nullptr);
      kill(child, SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  void kill_and_resume(int kills) {
    ASSERT_EQ(run_apart("whole", record::FolderStart::fresh, -1), 0);
    const auto expected = keys(out("whole"));
    ASSERT_GT(expected.size(), 400u);
    base::Random random(7);
    int killed = 0;
    int runs = 0;
    for (; killed < kills && runs < 10 * kills; ++runs) {
      const bool any = std::filesystem::exists(out("cut") / "machine.csv");
      const int status =
          run_apart("cut", any ? record::FolderStart::resume : record::FolderStart::fresh,
                    random.uniform(0.01, 0.4));
      if (WIFSIGNALED(status)) ++killed;
      if (status != 0) continue;
      EXPECT_EQ(keys(out("cut")), expected) << "after " << killed << " kills";
      std::filesystem::remove_all(out("cut"));
    }
    EXPECT_EQ(killed, kills);
    if (std::filesystem::exists(out("cut") / "machine.csv")) {
      ASSERT_EQ(run_apart("cut", record::FolderStart::resume, -1), 0);
      EXPECT_EQ(keys(out("cut")), expected);
    }
  }

  TemporaryFolder folder_;
};

TEST_F(Resume, AfterEveryKillAllRowsAreThereOnce) { kill_and_resume(10); }

TEST_F(Resume, AfterAFullDiskAllRowsAreThereOnce) {
  ASSERT_EQ(run_apart("whole", record::FolderStart::fresh, -1), 0);
  const auto size = std::filesystem::file_size(out("whole") / "raw.csv");
  for (const double part : {0.02, 0.3, 0.8}) {
    const auto limit_files = [&] {
      std::signal(SIGXFSZ, SIG_IGN);
      const auto most = static_cast<rlim_t>(part * static_cast<double>(size));
      const rlimit limit{most, most};
      setrlimit(RLIMIT_FSIZE, &limit);
    };
    EXPECT_EQ(WEXITSTATUS(run_apart("full", record::FolderStart::overwrite, -1, limit_files)), 2);
    ASSERT_EQ(run_apart("full", record::FolderStart::resume, -1), 0);
    EXPECT_EQ(keys(out("full")), keys(out("whole")));
  }
}

class ResumeStopped : public Resume {
 protected:
  // Cuts a finished run back to an unfinished one.
  ResumeStopped() {
    EXPECT_EQ(run_apart("out", record::FolderStart::fresh, -1), 0);
    expected_ = keys(out("out"));
    stop_run(out("out"), 0.6);
  }
  std::map<Key, int> expected_;
};

TEST_F(ResumeStopped, ALineThatWasCutOffIsDropped) {
  campaign::run_campaign(campaign(), out("out"), record::FolderStart::resume);
  EXPECT_EQ(keys(out("out")), expected_);
}

TEST_F(ResumeStopped, AFreshRunDoesNotOverwriteIt) {
  const std::string before = folder_.read("out/raw.csv");
  EXPECT_THAT(input_fault([&] { campaign::run_campaign(campaign(), out("out")); }),
              testing::HasSubstr("--resume"));
  EXPECT_EQ(folder_.read("out/raw.csv"), before);
  campaign::run_campaign(campaign(), out("out"), record::FolderStart::overwrite);
  EXPECT_EQ(keys(out("out")), expected_);
  campaign::run_campaign(campaign(), out("out"));  // the run was finished
}

TEST_F(ResumeStopped, AnotherCampaignSceneOrMachineIsRefused) {
  const auto fault = [&] {
    return input_fault(
        [&] { campaign::run_campaign(campaign(), out("out"), record::FolderStart::resume); });
  };
  const std::string text = folder_.read("c.toml");
  folder_.write("c.toml", text + "width = 0.05\n");
  EXPECT_THAT(fault(), testing::HasSubstr("campaign_hash was"));
  folder_.write("c.toml", text + "seed = 5\n");
  EXPECT_THAT(fault(), testing::HasSubstr("seed was '1' and is '5'"));
  folder_.write("c.toml", text);
  const std::string scene = folder_.read("scene.toml");
  folder_.write("scene.toml", scene + "seed = 9\n");
  EXPECT_THAT(fault(), testing::HasSubstr("scene scene, 30 bodies was"));
  folder_.write("scene.toml", scene);
  const std::string machine = folder_.read("out/machine.csv");
  folder_.write("out/machine.csv", machine + "second processor,abacus\n");
  EXPECT_THAT(fault(), testing::HasSubstr("second processor"));
  folder_.write("out/machine.csv", machine);
  EXPECT_EQ(fault(), "");
}

TEST_F(Resume, AFolderWithoutARunIsRefused) {
  EXPECT_THAT(input_fault([&] {
                campaign::run_campaign(campaign(), out("none"), record::FolderStart::resume);
              }),
              testing::HasSubstr("machine.csv"));
}

TEST_F(Resume, AFinishedRunIsLeftAsItIs) {
  ASSERT_EQ(run_apart("out", record::FolderStart::fresh, -1), 0);
  const std::string before = folder_.read("out/raw.csv");
  const campaign::RunResult result =
      campaign::run_campaign(campaign(), out("out"), record::FolderStart::resume);
  EXPECT_EQ(folder_.read("out/raw.csv"), before);
  EXPECT_EQ(result.findings.rows().size(),
            record::read_rows<record::RawRow>(out("out") / "raw.csv").size());
}

}  // namespace
}  // namespace touchstone
