// Counts verdicts about pairs: the job of a regime, and the report of the sums.
#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "algorithms/pair_query.h"
#include "harness/base/table.h"
#include "harness/grade/grade.h"
#include "harness/grade/true_case.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/pair/pair_checkers.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {
namespace {

// The cases of a job in the form that algorithms take: bodies 2i and 2i + 1 are case i's, in order
// of kinds.
class CountedCases {
 public:
  CountedCases(const Regime& regime, std::uint64_t seed, std::int64_t first, oracle::Oracle& oracle)
      : first_(first), oracle_(&oracle) {
    for (std::int64_t i = 0; i < cases_of_a_count_job; ++i) {
      files::Case& c =
          cases_.emplace_back(make(regime, seed, static_cast<std::uint64_t>(first + i)));
      if (needs_swap(c.shape_a.kind, c.shape_b.kind)) {
        std::swap(c.shape_a, c.shape_b);
        std::swap(c.pose_a, c.pose_b);
      }
      for (const Shape* shape : {&c.shape_a, &c.shape_b}) shapes_.push_back(*shape);
      for (const Pose* pose : {&c.pose_a, &c.pose_b}) poses_.push_back(*pose);
      for (int body = 0; body < 2; ++body)
        bodies_.push_back(static_cast<std::uint32_t>(bodies_.size()));
    }
  }

  VerdictCount ask(const NarrowPhaseEntry& entry, Precision scalar, double time_limit) {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (offers(entry, cases_[i].shape_a.kind, cases_[i].shape_b.kind, Task::intersect))
        asked.push_back(i);
    }
    const auto solved =
        process::isolated_answers<Outcome>(asked.size(), batch_limits(time_limit), [&] {
          const std::shared_ptr<NarrowPhase> algorithm = entry.make({.scalar = scalar});
          algorithm->bind(shapes_);
          return [&, algorithm](std::size_t item) {
            Outcome outcome;
            algorithm->solve(Task::intersect, batch_of(asked[item]), {&outcome, 1});
            return outcome;
          };
        });
    VerdictCount count;
    for (std::size_t item = 0; item < asked.size(); ++item) {
      const std::size_t i = asked[item];
      const files::Case& c = cases_[i];
      const Encoding encoding =
          encoding_of(entry, c.shape_a.kind, c.shape_b.kind, Task::intersect, scalar);
      const Outcome& outcome = solved.answers[item];
      if (outcome.status == Status::unsupported) continue;
      const bool bounds_hold =
          !grade::is_within_resolution(outcome) || !(bounds_error(i, encoding, outcome) > 0);
      count_one(outcome, truth(i, encoding), bounds_hold, first_ + static_cast<std::int64_t>(i),
                count);
    }
    return count;
  }

 private:
  PairBatch batch_of(std::size_t i) const {
    return {.kind_a = cases_[i].shape_a.kind,
            .kind_b = cases_[i].shape_b.kind,
            .pairs = {.first = std::span(bodies_).subspan(2 * i, 1),
                      .second = std::span(bodies_).subspan(2 * i + 1, 1),
                      .shape_of = bodies_,
                      .poses = poses_}};
  }

  // Returns the exact answer for the problem that the algorithm is given.
  Answer truth(std::size_t i, Encoding encoding) {
    std::vector<std::optional<Answer>>& known = truths_[static_cast<std::size_t>(encoding)];
    known.resize(cases_.size());
    if (!known[i]) {
      const grade::EncodedPair pair(cases_[i], encoding);
      known[i] = pair.is_finite() ? oracle_->verdict(pair.a(), pair.b()) : Answer::unknown;
    }
    return *known[i];
  }

  double bounds_error(std::size_t i, Encoding encoding, const Outcome& outcome) {
    const grade::EncodedPair pair(cases_[i], encoding);
    if (!pair.is_finite()) return Outcome::none;
    return grade::bounds_error(outcome, oracle_->measure(pair.a(), pair.b()));
  }

  // `bounds_hold`: of an answer `touching` within bounds.
  static void count_one(const Outcome& outcome, Answer exact, bool bounds_hold, std::int64_t index,
                        VerdictCount& count) {
    ++count.pairs;
    switch (exact) {
      case Answer::separated: ++count.separated; break;
      case Answer::touching: ++count.touching; break;
      case Answer::overlapping: ++count.overlapping; break;
      case Answer::unknown: ++count.unresolved; break;
    }
    switch (grade::judge(outcome, exact, grade::Touching::contact)) {
      case grade::Verdict::right:
        if (bounds_hold) return;
        ++count.silent;
        break;
      case grade::Verdict::unscored: return;
      case grade::Verdict::unsupported: return;
      case grade::Verdict::honest_failure: ++count.honest; return;
      case grade::Verdict::silent_error: ++count.silent; break;
      case grade::Verdict::crashed:
      case grade::Verdict::timed_out: ++count.lost; break;
    }
    if (count.first_wrong < 0) count.first_wrong = index;
  }

  std::int64_t first_;
  oracle::Oracle* oracle_;
  std::vector<files::Case> cases_;
  std::vector<Shape> shapes_;
  std::vector<Pose> poses_;
  std::vector<std::uint32_t> bodies_;
  std::array<std::vector<std::optional<Answer>>, all_encodings.size()> truths_;
};

}  // namespace

void VerdictCount::add(const VerdictCount& other) {
  for (const auto count : {&VerdictCount::pairs, &VerdictCount::separated, &VerdictCount::touching,
                           &VerdictCount::overlapping, &VerdictCount::unresolved,
                           &VerdictCount::silent, &VerdictCount::honest, &VerdictCount::lost}) {
    this->*count += other.*count;
  }
  if (first_wrong < 0) first_wrong = other.first_wrong;
}

JobRows<VerdictCount> CountChecker::rows_of_job(std::uint32_t family, std::uint64_t round) {
  const std::uint32_t regime = request_.regime_of(family);
  const std::int64_t first = static_cast<std::int64_t>(round) * cases_of_a_count_job;
  JobRows<VerdictCount> rows;
  CountedCases cases(*request_.regimes[regime], request_.seed, first, oracle_);
  for (const auto& [entry, scalar] : request_.algorithms) {
    VerdictCount count = cases.ask(*request_.narrow[entry], scalar, request_.time_limit);
    count.entry = entry;
    count.regime = regime;
    count.scalar = scalar;
    count.round = round;
    rows.of<VerdictCount>().push_back(count);
  }
  return rows;
}

void CountChecker::add(const VerdictCount& count) {
  VerdictCount& sum = verdicts_[{count.entry, count.scalar, count.regime}];
  sum.entry = count.entry;
  sum.scalar = count.scalar;
  sum.regime = count.regime;
  sum.add(count);
}

void CountChecker::write_made(std::int64_t jobs) const {
  std::vector<VerdictSum> rows;
  for (const auto& [key, count] : verdicts_) {
    rows.push_back({.count = count,
                    .seed = request_.seed,
                    .drawn = jobs * cases_of_a_count_job,
                    .program = program_});
  }
  record::write_rows(request_.out / made().front(), rows, request_);
}

// For ours the first case of each regime that was silently wrong or lost, and for a peer in a scalar the first of
// all.
void CountChecker::finish() {
  std::vector<WrongQuery> found;
  for (const auto& [key, count] : verdicts_) {
    if (count.first_wrong < 0) continue;
    if (!request_.is_ours(key.entry) && !found.empty() && found.back().query.entry == key.entry &&
        found.back().query.scalar == key.scalar)
      continue;
    found.push_back({{key.regime, key.entry, key.scalar, Task::intersect}, count.first_wrong});
  }
  failures_ = write_failures(request_, ask_again(request_, found));
}

std::vector<std::string> CountChecker::ours_wrong() const {
  std::vector<std::string> lines;
  for (const auto& [key, count] : verdicts_) {
    if (!request_.is_ours(key.entry) || request_.narrow[key.entry]->traits.approximate) continue;
    if (count.silent + count.lost == 0) continue;
    lines.push_back(fmt::format("{} on {}: of {} pairs {} silently wrong, {} failed; first case {}",
                                request_.name({key.entry, key.scalar}),
                                request_.regimes[key.regime]->name, count.pairs, count.silent,
                                count.lost, count.first_wrong));
  }
  return lines;
}

std::string CountChecker::text(std::size_t page_width) const {
  if (request_.narrow.empty()) return "";
  std::map<CheckedAlgorithm, VerdictCount> totals;
  for (const auto& [key, one] : verdicts_) totals[{key.entry, key.scalar}].add(one);
  base::Table table({"algorithm", "pairs", "separated", "touching", "overlapping", "unresolved",
                     "silent errors", "gave up", "failed"});
  for (const auto& [algorithm, sum] : totals) {
    std::vector<std::string> row = {request_.name(algorithm)};
    for (const std::int64_t n : {sum.pairs, sum.separated, sum.touching, sum.overlapping,
                                 sum.unresolved, sum.silent, sum.honest, sum.lost}) {
      row.push_back(std::to_string(n));
    }
    table.add(std::move(row));
  }
  return table.text(page_width);
}

}  // namespace touchstone::kinds
