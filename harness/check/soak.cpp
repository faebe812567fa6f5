// Draws cases in jobs, counts the verdicts of each algorithm, and writes soak.csv.
#include "harness/check/soak.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <system_error>

#include "algorithms/oracle/oracle.h"
#include "harness/base/error.h"
#include "harness/base/progress.h"
#include "harness/grade/encoding.h"
#include "harness/grade/grade.h"
#include "harness/process/isolate.h"
#include "harness/process/queries/ordered_pair.h"
#include "harness/process/worker_pool.h"
#include "harness/record/machine.h"
#include "harness/record/row.h"

namespace touchstone::check {
namespace {

constexpr std::int64_t cases_a_job = 1000;
// An algorithm may lose so many queries of a job, since each hang costs a time limit.
constexpr std::size_t most_failures = 20;
constexpr double seconds_between_writes = 1;

struct SoakRow {
  std::uint32_t entry = 0, regime = 0;  // places in the request
  Precision scalar{};
  std::uint64_t seed = 0;
  std::int64_t drawn = 0;
  SoakCount count;
  std::string program;
};

template <record::row_of<SoakRow> Row, class Visit>
void columns(Row& row, Visit visit, const CheckSubjects& subjects) {
  visit("algorithm", record::place_in(row.entry, subjects.narrow.size(), subjects.narrow_name()),
        "The narrow phase.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("regime", record::place_in(row.regime, subjects.regimes.size(), subjects.regime_name()),
        "Regime of the pairs.");
  visit("seed", row.seed, "Seed of the cases.");
  visit("drawn", row.drawn, "Pairs drawn in all regimes, whether an algorithm takes them or not.");
  auto& count = row.count;
  visit("pairs", count.pairs, "Pairs that it was asked about.");
  visit("separated", count.separated, "Pairs that are apart.");
  visit("touching", count.touching, "Pairs that touch exactly.");
  visit("overlapping", count.overlapping, "Pairs that overlap.");
  visit("unresolved", count.unresolved, "Pairs whose side of contact the oracle leaves open.");
  visit("silent", count.silent, "Answers on the wrong side of contact that nothing tells.");
  visit("honest", count.honest, "Answers that it does not stand by.");
  visit("lost", count.lost, "Queries that crashed, or gave no answer in time.");
  visit("first_wrong", record::with_sign(count.first_wrong),
        "First case that was silently wrong or lost; -1 where there is none.");
  visit("program", row.program, "Hash of the program.");
}

// The counts of a job, in the order of the request's algorithms and their scalars.
using JobCounts = std::vector<SoakCount>;

struct Subject {
  std::size_t entry;
  Precision scalar;
};

std::vector<Subject> subjects_of(const SoakRequest& request) {
  std::vector<Subject> subjects;
  for (std::size_t entry = 0; entry < request.narrow.size(); ++entry) {
    for (const Precision scalar : request.scalars) {
      if (offers(*request.narrow[entry], scalar)) subjects.push_back({entry, scalar});
    }
  }
  return subjects;
}

// The cases of a job in the form that algorithms take: bodies 2i and 2i + 1 are case i's, in order
// of kinds.
class Cases {
 public:
  Cases(const Regime& regime, std::uint64_t seed, std::int64_t first, oracle::Oracle& oracle)
      : first_(first), oracle_(&oracle) {
    for (std::int64_t i = 0; i < cases_a_job; ++i) {
      files::Case& c =
          cases_.emplace_back(make(regime, seed, static_cast<std::uint64_t>(first + i)));
      if (process::needs_swap(c.shape_a.kind, c.shape_b.kind)) {
        std::swap(c.shape_a, c.shape_b);
        std::swap(c.pose_a, c.pose_b);
      }
      for (const Shape* shape : {&c.shape_a, &c.shape_b}) shapes_.push_back(*shape);
      for (const Pose* pose : {&c.pose_a, &c.pose_b}) poses_.push_back(*pose);
      for (int body = 0; body < 2; ++body)
        bodies_.push_back(static_cast<std::uint32_t>(bodies_.size()));
    }
  }

  SoakCount ask(const NarrowPhaseEntry& entry, Precision scalar, double time_limit) {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (offers(entry, cases_[i].shape_a.kind, cases_[i].shape_b.kind, Task::intersect))
        asked.push_back(i);
    }
    const process::IsolationLimits limits = {.item_seconds = time_limit, .failures = most_failures};
    const auto solved = process::isolated_answers<Outcome>(asked.size(), limits, [&] {
      const std::shared_ptr<NarrowPhase> algorithm = entry.make({.scalar = scalar});
      algorithm->bind(shapes_);
      return [&, algorithm](std::size_t item) {
        Outcome outcome;
        algorithm->solve(Task::intersect, batch_of(asked[item]), {&outcome, 1});
        return outcome;
      };
    });
    SoakCount count;
    for (std::size_t item = 0; item < asked.size(); ++item) {
      const std::size_t i = asked[item];
      const files::Case& c = cases_[i];
      const Encoding encoding =
          encoding_of(entry, c.shape_a.kind, c.shape_b.kind, Task::intersect, scalar);
      count_one(solved.answers[item], truth(i, encoding), first_ + static_cast<std::int64_t>(i),
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

  static void count_one(const Outcome& outcome, Answer exact, std::int64_t index,
                        SoakCount& count) {
    ++count.pairs;
    switch (exact) {
      case Answer::separated: ++count.separated; break;
      case Answer::touching: ++count.touching; break;
      case Answer::overlapping: ++count.overlapping; break;
      case Answer::unknown: ++count.unresolved; break;
    }
    switch (grade::judge(outcome, exact, grade::Touching::contact)) {
      case grade::Verdict::right:
      case grade::Verdict::unscored: return;
      case grade::Verdict::unsupported:
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

class Soak {
 public:
  explicit Soak(const SoakRequest& request)
      : request_(request),
        subjects_(subjects_of(request)),
        program_(record::hash_of_program()),
        file_(request.out / "soak.csv") {
    std::error_code error;
    if (!request.resume) std::filesystem::create_directories(request.out, error);
    if (error)
      throw base::InputError(request.out.string(), 0, "cannot be made: " + error.message());
    if (request.resume) resume();
    write();
  }

  SoakResult run() {
    const auto first = static_cast<std::size_t>(result_.drawn / cases_a_job);
    const auto end = static_cast<std::size_t>((request_.pairs + cases_a_job - 1) / cases_a_job);
    if (first < end) {
      base::Progress progress(1);
      progress.start(fmt::format("{} verdicts", request_.pairs));
      base::Stopwatch since_written;
      process::run_jobs<JobCounts>(
          first, end, request_.workers, [&] { return work(); },
          [&](std::size_t job, const JobCounts& counts) {
            take(job, counts);
            progress.part(static_cast<double>(result_.drawn) / static_cast<double>(request_.pairs));
            if (since_written.seconds() > seconds_between_writes) {
              write();
              since_written.restart();
            }
            return true;
          });
    }
    write();
    write_cases();
    return result_;
  }

 private:
  const Regime& regime_of(std::size_t job) const {
    return *request_.regimes[job % request_.regimes.size()];
  }

  std::function<JobCounts(std::size_t)> work() const {
    // Each process has one oracle, which keeps its memory from query to query.
    const auto oracle = std::make_shared<oracle::Oracle>();
    return [this, oracle](std::size_t job) {
      const auto round = static_cast<std::int64_t>(job / request_.regimes.size());
      Cases cases(regime_of(job), request_.seed, round * cases_a_job, *oracle);
      JobCounts counts;
      for (const Subject& subject : subjects_) {
        counts.push_back(
            cases.ask(*request_.narrow[subject.entry], subject.scalar, request_.time_limit));
      }
      return counts;
    };
  }

  void take(std::size_t job, const JobCounts& counts) {
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      result_.counts[{subjects_[i].entry, subjects_[i].scalar, job % request_.regimes.size()}].add(
          counts[i]);
    }
    result_.drawn += cases_a_job;
  }

  void write() const {
    const CheckSubjects subjects = request_.subjects();
    files::CsvWriter csv(file_, record::header_of<SoakRow>(subjects));
    for (const auto& [key, count] : result_.counts) {
      const auto& [entry, scalar, regime] = key;
      record::write_row(csv,
                        SoakRow{.entry = static_cast<std::uint32_t>(entry),
                                .regime = static_cast<std::uint32_t>(regime),
                                .scalar = scalar,
                                .seed = request_.seed,
                                .drawn = result_.drawn,
                                .count = count,
                                .program = program_},
                        subjects);
    }
    csv.close();
  }

  void resume() {
    if (!std::filesystem::exists(file_)) {
      throw base::InputError(file_.string(), 0, "no such file; expected the folder of a soak");
    }
    const CheckSubjects subjects = request_.subjects();
    record::reader_of<SoakRow>(file_, subjects).read([&](const files::CsvReader::Row& fields) {
      const auto row = record::read_row<SoakRow>(fields, subjects);
      if (row.seed != request_.seed) {
        fields.fail(fmt::format("seed {}; this request has {}", row.seed, request_.seed));
      }
      if (row.program != program_) {
        fields.fail("counted by another program; expected the same one, or no --resume");
      }
      result_.drawn = row.drawn;
      result_.counts[{row.entry, row.scalar, row.regime}] = row.count;
    });
    // There are fewer rows until each regime has had its turn.
    const std::size_t rounds =
        std::min(static_cast<std::size_t>(result_.drawn / cases_a_job), request_.regimes.size());
    if (result_.counts.size() != rounds * subjects_.size()) {
      throw base::InputError(file_.string(), 0,
                             "counts of other algorithms or regimes; expected the same request");
    }
  }

  void write_cases() const {
    for (const auto& [key, count] : result_.counts) {
      const auto& [entry, scalar, regime] = key;
      if (count.first_wrong < 0) continue;
      const files::Case c = make(*request_.regimes[regime], request_.seed,
                                 static_cast<std::uint64_t>(count.first_wrong));
      const std::filesystem::path file =
          request_.out / fmt::format("{}-{}-{}.jsonl", request_.narrow[entry]->info.name,
                                     to_string(scalar), request_.regimes[regime]->name);
      std::ofstream stream(file);
      stream << files::to_json(c) << '\n';
      stream.flush();
      if (!stream) throw base::InputError(file.string(), 0, "cannot be written");
    }
  }

  const SoakRequest& request_;
  std::vector<Subject> subjects_;
  std::string program_;
  std::filesystem::path file_;
  SoakResult result_;
};

}  // namespace

void SoakCount::add(const SoakCount& other) {
  pairs += other.pairs;
  separated += other.separated;
  touching += other.touching;
  overlapping += other.overlapping;
  unresolved += other.unresolved;
  silent += other.silent;
  honest += other.honest;
  lost += other.lost;
  if (first_wrong < 0) first_wrong = other.first_wrong;
}

bool SoakResult::ours_are_wrong(const SoakRequest& request) const {
  return std::ranges::any_of(counts, [&](const auto& item) {
    const NarrowPhaseEntry& entry = *request.narrow[std::get<0>(item.first)];
    return entry.info.origin == Origin::ours && !entry.traits.approximate &&
           (item.second.silent > 0 || item.second.lost > 0);
  });
}

SoakResult run_soak(const SoakRequest& request) { return Soak(request).run(); }

}  // namespace touchstone::check
