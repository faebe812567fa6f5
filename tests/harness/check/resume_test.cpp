// Tests that a check resumes after a kill, and only in its own folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/base/clock.h"
#include "harness/check/check_run.h"
#include "tests/harness/check/planted.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

struct CheckWork {
  static constexpr check::CheckMode mode = check::CheckMode::cases;
  static constexpr std::size_t units = 7;
  static constexpr const char* rows = "grades.csv";

  CheckWork() {
    for (int i = 0; i < 7; ++i) regimes.push_back(balls_regime("balls-" + std::to_string(i)));
  }
  void set_subject(check::CheckRequest& request) const {
    for (const kinds::Regime& regime : regimes) draw(request, regime);
  }
  static void shorten(check::CheckRequest& request) { request.families.pop_back(); }
  static std::vector<std::string> files() {
    return {"grades.csv", "variants.csv", "jobs.csv", "summary.csv"};
  }
  // Returns files as a kill in the middle of a job leaves them.
  static std::map<std::string, std::string> leftovers() {
    return {{"grades.csv", "balls-6,3,sphere,sph"}, {"jobs.csv", "balls-6,test,0,8,0,0,0,0,0,0\n"}};
  }

  std::vector<kinds::Regime> regimes;
};

struct AxesWork {
  static constexpr check::CheckMode mode = check::CheckMode::axes;
  static constexpr std::size_t units = 8;
  static constexpr const char* rows = "stress.csv";

  void set_subject(check::CheckRequest& request) const {
    for (const kinds::Regime& value : values) draw(request, value);
  }
  static void shorten(check::CheckRequest& request) { request.families.clear(); }
  static std::vector<std::string> files() { return {"stress.csv", "cells.csv", "envelope.csv"}; }
  static std::map<std::string, std::string> leftovers() {
    return {{"stress.csv", "balls,7,bad,dou"}, {"cells.csv", "balls,7,8,0,0\n"}};
  }

  kinds::Axis balls = balls_axis(8);
  std::vector<kinds::Regime> values = kinds::regimes_of(balls);
};

template <class Work>
class Resume : public ::testing::Test {
 protected:
  Resume() {
    request.scalars = {Precision::float64};
    ask(request, {&slow, &bad});
    request.cases = 8;
    request.time_limit = 0.3;
    request.out = folder.path() / "out";
    work.set_subject(request);
  }
  std::string read(const std::string& name) const { return folder.read("out/" + name); }
  std::string fault() const {
    return input_fault([&] { check::run_check(request); });
  }

  // Kills the work after so many units.
  void kill_after(std::size_t units) {
    const pid_t child = fork();
    if (child == 0) {
      std::freopen("/dev/null", "w", stderr);
      check::run_check(request);
      _exit(0);
    }
    const std::string wanted = "\nunits,";
    const base::Stopwatch watch;
    while (watch.seconds() < 60) {
      const std::string progress = read("progress.csv");
      const auto at = progress.find(wanted);
      if (at != std::string::npos && std::stoul(progress.substr(at + wanted.size())) >= units)
        break;
      usleep(1000);
    }
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it was done before it could be killed";
  }

  TemporaryFolder folder;
  Work work;
  NarrowPhaseEntry slow = planted<Harm::none, 300>("slow", Origin::ours);
  NarrowPhaseEntry bad = planted<Harm::wrong_side>("bad", Origin::peer);
  check::CheckRequest request{Work::mode};
};

using Works = ::testing::Types<CheckWork, AxesWork>;
TYPED_TEST_SUITE(Resume, Works);

TYPED_TEST(Resume, NoRowIsLostOrDoubled) {
  this->kill_after(2);
  for (const auto& [name, text] : TypeParam::leftovers()) {
    std::ofstream(this->request.out / name, std::ios::app) << text;
  }
  this->request.resume = true;
  check::run_check(this->request);
  std::map<std::string, std::string> found;
  for (const std::string& name : TypeParam::files()) found[name] = this->read(name);
  const std::string cases = this->read("failures/bad-double-intersect.jsonl");
  EXPECT_THAT(cases, Not(IsEmpty()));
  EXPECT_THAT(this->read("progress.csv"),
              HasSubstr("units," + std::to_string(TypeParam::units) + "\n"));
  this->request.resume = false;
  check::run_check(this->request);
  for (const auto& [name, text] : found) EXPECT_EQ(text, this->read(name)) << name;
  EXPECT_EQ(cases, this->read("failures/bad-double-intersect.jsonl"));

  // Finished work is not done again, and the result is equal.
  this->request.resume = true;
  check::run_check(this->request);
  for (const auto& [name, text] : found) EXPECT_EQ(text, this->read(name)) << name;
}

TYPED_TEST(Resume, AnotherRequestIsRefused) {
  ask(this->request, {&this->bad});
  check::run_check(this->request);
  const std::string before = this->read(TypeParam::rows);
  this->request.resume = true;
  const auto refuse = [&](const auto& change, const std::string& text) {
    auto other = this->request;
    change(other);
    EXPECT_THAT(input_fault([&] { check::run_check(other); }),
                AllOf(HasSubstr("machine.csv: "), HasSubstr(text)));
  };
  refuse([](auto& r) { r.seed = 2; }, "seed was '1' and is '2' now");
  refuse([](auto& r) { r.cases = 9; }, "cases was '8'");
  refuse([&](auto& r) { ask(r, {&this->slow}); }, "contestants was 'pair bad double'");
  refuse([](auto& r) { TypeParam::shorten(r); }, "families was");
  refuse([](auto& r) { r.scalars = {Precision::float32}; }, "scalars was 'double'");
  refuse([](auto& r) { r.time_limit = 3; }, "time_limit");
  refuse([](auto& r) { r.out /= "none"; }, "is not there");
  EXPECT_EQ(this->read(TypeParam::rows), before);
}

TYPED_TEST(Resume, AnotherProgramAndShortFilesAreRefused) {
  ask(this->request, {&this->bad});
  check::run_check(this->request);
  this->request.resume = true;
  const std::string facts = this->read("machine.csv");
  const auto at = facts.find("\nprogram,") + 9;
  this->folder.write("out/machine.csv", facts.substr(0, at) + "x" + facts.substr(at + 1));
  EXPECT_THAT(this->fault(), HasSubstr("program"));
  this->folder.write("out/machine.csv", facts);
  const std::filesystem::path rows = this->request.out / TypeParam::rows;
  const std::size_t header = this->read(TypeParam::rows).find('\n') + 1;
  std::filesystem::resize_file(rows, header);
  EXPECT_THAT(this->fault(), HasSubstr(": " + std::to_string(header) + " bytes; expected"));
  std::filesystem::remove(rows);
  EXPECT_THAT(this->fault(), HasSubstr(": 0 bytes; expected"));
}

TEST(ResumeCheck, RoundsMayBeAdded) {
  TemporaryFolder folder;
  const NarrowPhaseEntry good = planted<Harm::none>("good", Origin::ours);
  const kinds::Regime balls = balls_regime();
  check::CheckRequest request;
  ask(request, {&good});
  draw(request, balls);
  request.cases = 8;
  request.out = folder.path() / "out";
  check::run_check(request);
  const std::string before = folder.read("out/grades.csv");
  request.resume = true;
  request.seconds = 0.1;
  check::run_check(request);
  EXPECT_TRUE(folder.read("out/grades.csv").starts_with(before));
  EXPECT_GT(folder.read("out/grades.csv").size(), before.size());
}

}  // namespace
}  // namespace touchstone
