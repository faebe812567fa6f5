// Tests that a guarded solve loses only the pairs that fail.
#include "harness/process/limited_query.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

namespace {

using namespace touchstone;

// Treats each pair as the index of its first body says.
class Misbehaving final : public NarrowPhase {
 public:
  void bind(std::span<const Shape>) override {}
  void solve(Task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      switch (batch.pairs.first[i]) {
        case 1: std::raise(SIGSEGV); break;
        case 2: throw std::runtime_error("no");
        case 3: pause(); break;
        default: break;
      }
      outcomes[i].answer = Answer::separated;
      outcomes[i].status = Status::ok;
      outcomes[i].distance = batch.pairs.second[i];
    }
  }
};

std::vector<Outcome> solve(const std::vector<std::uint32_t>& behaviour, double limit) {
  std::vector<std::uint32_t> second(behaviour.size());
  for (std::uint32_t i = 0; i < second.size(); ++i) second[i] = i;
  const PairBatch batch{ShapeKind::sphere, ShapeKind::sphere, {behaviour, second, {}, {}}};
  std::vector<Outcome> outcomes(behaviour.size());
  process::solve_guarded([] { return std::make_unique<Misbehaving>(); }, Task::distance, batch,
                         outcomes, limit, std::size_t{1} << 30);
  return outcomes;
}

TEST(SolveGuarded, LosesOnlyWhatWentWrong) {
  const std::vector<Outcome> outcomes = solve({0, 1, 0, 2, 0}, 5);
  EXPECT_EQ(outcomes[0].status, Status::ok);
  EXPECT_EQ(outcomes[1].status, Status::crashed);
  EXPECT_EQ(outcomes[2].status, Status::ok);
  EXPECT_EQ(outcomes[2].distance, 2);
  EXPECT_EQ(outcomes[3].status, Status::crashed);
  EXPECT_EQ(outcomes[4].distance, 4);
}

TEST(SolveGuarded, StopsWhatHangs) {
  const std::vector<Outcome> outcomes = solve({0, 3}, 0.2);
  EXPECT_EQ(outcomes[0].status, Status::ok);
  EXPECT_EQ(outcomes[1].status, Status::timed_out);
  EXPECT_EQ(outcomes[1].answer, Answer::unknown);
}

TEST(SolveGuarded, GivesUpAfterThreeLosses) {
  const std::vector<Outcome> outcomes = solve({1, 1, 1, 0, 0}, 5);
  for (const Outcome& outcome : outcomes) EXPECT_EQ(outcome.status, Status::crashed);
}

}  // namespace
