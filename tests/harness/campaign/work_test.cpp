// Tests of the counters beside the times: in the check's rows, and in those of the samples.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "harness/campaign/runner.h"
#include "harness/measure/allocations.h"
#include "harness/measure/worker.h"
#include "tests/harness/campaign/fakes.h"

namespace touchstone {
namespace {

// A naive broad phase with counters, which allocates a little in each update and find_pairs.
class Counting final : public BroadPhase {
 public:
  explicit Counting(Executor& executor)
      : naive_(registry::find<BroadPhaseEntry>("naive")->make(executor)) {}
  void build(std::span<const Aabb> boxes) override {
    kept_.clear();
    naive_->build(boxes);
  }
  void update(const FrameChange& change) override {
    ask_for(10);
    naive_->update(change);
  }
  Status find_pairs(PairSink& sink) override {
    ask_for(100);
    ask_for(200);
    if (!warm_) kept_.resize(1 << 20);  // allocates only once
    warm_ = true;
    return naive_->find_pairs(sink);
  }
  BroadPhaseWork work() const override {
    return {.box_tests = 7, .node_visits = 0, .candidates = 3, .bytes = 1 << 20};
  }

 private:
  static void ask_for(std::size_t bytes) {
    void* volatile memory = std::malloc(bytes);
    std::free(memory);
  }
  std::unique_ptr<BroadPhase> naive_;
  std::vector<char> kept_;
  bool warm_ = false;
};

campaign::RunResult run_counting(bool crash_when_warm) {
  FakeCampaign fakes;
  BroadPhaseEntry counting = fake("counting", [](int, PairSink&) {});
  counting.make = [](Executor& executor) { return std::make_unique<Counting>(executor); };
  fakes.fakes = {counting, fake("silent", [=](int call, PairSink&) {
                   if (crash_when_warm && call == 2 * FakeCampaign::frames) std::abort();
                 })};
  return campaign::run_campaign(fakes.campaign(1), fakes.out());
}

TEST(WorkColumns, OfTheCheck) {
  const campaign::RunResult result = run_counting(false);
  int rows = 0;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.kind != record::RowKind::check || row.broad != "counting") continue;
    ++rows;
    const bool query = row.phase == record::Phase::find_pairs;
    EXPECT_EQ(row.box_tests, query ? 7 : -1);
    EXPECT_EQ(row.node_visits, query ? 0 : -1);
    EXPECT_EQ(row.candidates, query ? 3 : -1);
    EXPECT_EQ(row.bytes, query ? 1 << 20 : -1);
    if (!measure::can_count_allocations()) {
      EXPECT_EQ(row.allocations, -1);
      EXPECT_EQ(row.allocated_bytes, -1);
      continue;
    }
    // The algorithm is warm: the naive one inside allocates nothing, and its buffers exist.
    const bool update = row.phase == record::Phase::update;
    EXPECT_EQ(row.allocations, query ? 2 : update ? 1 : 0) << row.frame;
    EXPECT_EQ(row.allocated_bytes, query ? 300 : update ? 10 : 0) << row.frame;
  }
  EXPECT_EQ(rows, 2 * FakeCampaign::frames);
}

// A peer that converts boxes in a time proportional to their number; the first time is cold.
class Converting final : public PeerBroadPhase {
 public:
  explicit Converting(Executor& executor)
      : naive_(registry::find<BroadPhaseEntry>("naive")->make(executor)) {
    FakeClock::start();
  }
  void build(std::span<const Aabb> boxes) override { naive_->build(boxes); }
  void update(const FrameChange& change) override { naive_->update(change); }
  Status find_pairs(PairSink& sink) override { return naive_->find_pairs(sink); }
  void convert(std::span<const Aabb> boxes) override {
    const double cold = calls_++ % 4 == 0 ? 100 : 1;
    FakeClock::spend(1e-6 * cold * static_cast<double>(boxes.size()));
  }

 private:
  std::unique_ptr<BroadPhase> naive_;
  int calls_ = 0;
};

TEST(Conversion, IsTimedApartInTheCheck) {
  FakeCampaign fakes;
  BroadPhaseEntry converting = fake("converting", [](int, PairSink&) {});
  converting.make = [](Executor& executor) { return std::make_unique<Converting>(executor); };
  fakes.fakes = {converting, fake("silent", [](int, PairSink&) {})};
  const campaign::RunResult result = campaign::run_campaign(fakes.campaign(1), fakes.out());
  int rows = 0;
  for (const record::RawRow& row : result.findings.rows()) {
    EXPECT_NE(row.status, record::RowStatus::wrong) << row.broad;
    if (row.phase != record::Phase::convert) continue;
    ++rows;
    EXPECT_EQ(row.kind, record::RowKind::check);
    EXPECT_EQ(row.broad, "converting");
    EXPECT_NEAR(row.seconds, 1e-6 * static_cast<double>(row.bodies), 1e-9);  // all of them move
  }
  EXPECT_EQ(rows, FakeCampaign::frames);
}

TEST(WorkColumns, NothingIsCountedWhereTimeIsTaken) {
  const campaign::RunResult result = run_counting(false);
  int rows = 0;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.kind != record::RowKind::sample || row.phase != record::Phase::find_pairs) continue;
    ++rows;
    EXPECT_EQ(row.box_tests, -1);
    EXPECT_EQ(row.allocations, -1);
    EXPECT_EQ(row.cycles > 0, row.instructions > 0);
  }
  EXPECT_GT(rows, 0);
}

// The pass that counts is separate: a failure in it alone leaves counts out, and is no failure of
// the check.
TEST(WorkColumns, ACrashWhileCountingLeavesThemEmpty) {
  const campaign::RunResult result = run_counting(true);
  bool checked = false;
  for (const record::RawRow& row : result.findings.rows()) {
    if (row.kind != record::RowKind::check || row.broad != "silent" || row.process >= 0) continue;
    checked = true;
    if (row.phase != record::Phase::find_pairs) continue;
    EXPECT_EQ(row.status, record::RowStatus::ok);
    if (row.frame == FakeCampaign::frames - 1) {
      EXPECT_EQ(row.allocations, -1);
    }
  }
  EXPECT_TRUE(checked);
}

// Takes this much memory in its frame 1, and frees it.
class Greedy final : public measure::Sampler {
 public:
  explicit Greedy(std::size_t bytes) : bytes_(bytes) {}
  measure::SampleReply sample(const measure::SampleRequest& request) override {
    if (request.frame == 1) {
      void* const memory =
          mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      for (std::size_t at = 0; at < bytes_; at += 4096) static_cast<volatile char*>(memory)[at] = 1;
      munmap(memory, bytes_);
    }
    return {};
  }

 private:
  std::size_t bytes_;
};

TEST(PeakMemory, IsWhatTheContestantTookBeyondTheHarness) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's own memory comes on top";
#endif
  const std::vector<char> harness(std::size_t{200} << 20, 'x');  // it does not belong to the worker
  constexpr std::int64_t taken_kb = 64 << 10;
  measure::Worker worker([] { return std::make_unique<Greedy>(std::size_t{taken_kb} << 10); },
                         {.layout = 3});
  ASSERT_FALSE(worker.wait_until_made(10));
  const auto peak = [&](std::uint32_t frame) {
    const auto reply = worker.ask({.frame = frame}, 10);
    return reply ? reply->peak_kb : -2;
  };
  const std::int64_t idle = peak(0);
  if (idle == -1) GTEST_SKIP() << "the system does not tell";
  constexpr std::int64_t slack_kb = 2 << 10;
  EXPECT_LT(idle, slack_kb);
  const std::int64_t greedy = peak(1);
  EXPECT_GT(greedy, taken_kb - slack_kb);
  EXPECT_LT(greedy, taken_kb + slack_kb);
  EXPECT_LT(peak(2), slack_kb) << "of the sample, not of all before it";
}

}  // namespace
}  // namespace touchstone
