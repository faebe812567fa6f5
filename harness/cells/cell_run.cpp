// Grades the contestants of each cell in a process of their own, then times them here.
#include "harness/cells/cell_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/base/random.h"
#include "harness/measure/noise.h"
#include "harness/process/interrupt.h"
#include "harness/process/isolate.h"
#include "harness/record/machine.h"
#include "harness/stats/cells/cell_rows.h"

namespace touchstone::cells {
namespace {

enum File : std::size_t { grades_file, raw_file };

struct Graded {
  kinds::TimedGrade grade;
  double seconds = 0;  // of one answer to all queries
  process::ItemState state = process::ItemState::not_run;
};

std::vector<Graded> grade(const kinds::TimedSet& cell, double time_limit) {
  struct Shared {
    kinds::TimedGrade grade;
    double seconds;
  };
  process::SharedArray<Shared> shared(cell.contestants.size());
  process::IsolationLimits limits;
  limits.item_seconds = 4 * time_limit;
  const process::IsolationReport report =
      process::isolate(cell.contestants.size(), limits, [&]() -> process::ItemWork {
        return [&](std::size_t i) {
          if (cell.contestants[i].prepare) cell.contestants[i].prepare();
          const base::Stopwatch watch;
          cell.contestants[i].answer();
          shared[i].seconds = watch.seconds();
          shared[i].grade = cell.contestants[i].grade();
        };
      });
  std::vector<Graded> graded;
  for (std::size_t i = 0; i < cell.contestants.size(); ++i)
    graded.push_back({shared[i].grade, shared[i].seconds, report.states[i]});
  return graded;
}

// A contestant of one of the cells that share their rounds.
struct Timed {
  const kinds::PlannedSet* planned;
  const kinds::TimedContestant* contestant;
  std::int64_t queries;
  double seconds;  // of one answer to all queries
};

std::vector<Timed> shuffled(std::vector<Timed> order, base::Random random) {
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

// The cells, each with those that join it.
std::vector<std::span<const kinds::PlannedSet>> with_joined(
    std::span<const kinds::PlannedSet> cells) {
  std::vector<std::span<const kinds::PlannedSet>> all;
  for (std::size_t first = 0, end = 1; first < cells.size(); first = end, ++end) {
    while (end < cells.size() && cells[end].joins_last) ++end;
    all.push_back(cells.subspan(first, end - first));
  }
  return all;
}

class CellRun {
 public:
  CellRun(const CellRequest& request, const std::filesystem::path& folder,
          record::FolderStart start)
      : request_(request), folder_(plan(request, folder, start)) {}

  CellRunResult run(const std::function<void(const std::string&)>& say) {
    const process::InterruptGuard guard;
    note_earlier_grades();
    const std::vector<std::span<const kinds::PlannedSet>> all = with_joined(request_.cells);
    for (std::size_t i = static_cast<std::size_t>(folder_.units()); i < all.size(); ++i) {
      for (const kinds::PlannedSet& planned : all[i]) {
        say(fmt::format("[{}/{}] {}, {}", &planned - request_.cells.data() + 1,
                        request_.cells.size(), planned.group, planned.name));
      }
      if (!measure(all[i], i)) {
        result_.interrupted = true;
        return result_;
      }
      folder_.commit();
    }
    folder_.finish();
    return result_;
  }

 private:
  static record::ResultFolderPlan plan(const CellRequest& request,
                                       const std::filesystem::path& folder,
                                       record::FolderStart start) {
    record::ResultFolderPlan plan;
    plan.folder = folder;
    plan.files = {{"grades.csv", record::header_of<stats::GradeRow>()},
                  {"raw.csv", record::header_of<stats::CellSampleRow>()}};
    plan.identity = {{"cells", request.name},
                     {"rounds", std::to_string(request.rounds)},
                     {"sample_seconds", fmt::format("{}", request.sample_seconds)},
                     {"order_seed", std::to_string(request.seed)}};
    plan.identity.insert(plan.identity.end(), request.identity.begin(), request.identity.end());
    for (auto& fact : record::machine_facts()) plan.identity.push_back(std::move(fact));
    plan.start = start;
    plan.made = {"times.csv", "best.csv", "speed_ups.csv", "tables.md"};
    return plan;
  }

  void note(const stats::GradeRow& row) {
    result_.ours_wrong |=
        row.origin == "ours" && !row.approximate && (!row.is_right() || row.status == "crashed");
  }
  void note_earlier_grades() {
    folder_.each_row<stats::GradeRow>(grades_file, [&](const stats::GradeRow& row) { note(row); });
  }

  // Returns false if it was interrupted.
  bool measure(std::span<const kinds::PlannedSet> joined, std::size_t number) {
    std::vector<kinds::TimedSet> cells;
    for (const kinds::PlannedSet& planned : joined) cells.push_back(planned.make());
    std::vector<Timed> timed;
    for (std::size_t k = 0; k < joined.size(); ++k) {
      const kinds::PlannedSet& planned = joined[k];
      const kinds::TimedSet& cell = cells[k];
      const std::vector<Graded> graded = grade(cell, request_.time_limit);
      for (std::size_t i = 0; i < graded.size(); ++i) {
        const kinds::TimedContestant& contestant = cell.contestants[i];
        write_grade(planned, cell, contestant, graded[i]);
        if (graded[i].state == process::ItemState::done && graded[i].seconds <= request_.time_limit)
          timed.push_back({&planned, &contestant, cell.queries, graded[i].seconds});
      }
      for (const kinds::LeftOut& left_out : cell.left_out) write_left_out(planned, cell, left_out);
    }
    // What is cold is not timed, and takes longer than the samples, so that it would cut them short.
    for (Timed& one : timed) {
      if (one.contestant->prepare) one.contestant->prepare();
      one.contestant->answer();
      const base::Stopwatch watch;
      one.contestant->answer();
      one.seconds = std::min(one.seconds, watch.seconds());
    }
    for (int round = 0; round < request_.rounds; ++round) {
      if (process::InterruptGuard::raised()) return false;
      time_round(round,
                 shuffled(timed, base::Random(request_.seed, number << 16 | unsigned(round))));
    }
    return true;
  }

  void write_grade(const kinds::PlannedSet& planned, const kinds::TimedSet& cell,
                   const kinds::TimedContestant& contestant, const Graded& graded) {
    stats::GradeRow row;
    row.group = planned.group;
    row.cell = planned.name;
    row.algorithm = contestant.name;
    row.origin = to_string(contestant.origin);
    row.approximate = contestant.approximate;
    row.queries = cell.queries;
    row.truth = cell.truth;
    row.graded = cell.graded;
    row.near = graded.grade.near;
    row.missed = graded.grade.missed;
    row.false_hits = graded.grade.false_hits;
    row.inexact = graded.grade.inexact;
    row.bound = graded.grade.bound;
    row.gave_up = graded.grade.gave_up;
    row.unresolved = graded.grade.unresolved;
    row.error = graded.grade.error;
    row.hits = graded.grade.hits;
    row.true_hits = graded.grade.true_hits;
    if (row.hits >= 0) row.hit_hash = base::to_hex(graded.grade.hit_hash);
    row.status = to_string(graded.state);
    note(row);
    folder_.write(grades_file, row);
  }

  void write_left_out(const kinds::PlannedSet& planned, const kinds::TimedSet& cell,
                      const kinds::LeftOut& left_out) {
    stats::GradeRow row;
    row.group = planned.group;
    row.cell = planned.name;
    row.algorithm = left_out.name;
    row.origin = to_string(left_out.origin);
    row.queries = cell.queries;
    row.status = to_string(Status::unsupported);
    folder_.write(grades_file, row);
  }

  void time_round(int round, const std::vector<Timed>& order) {
    const measure::NoiseReading before = measure::NoiseReading::now();
    const base::Stopwatch whole;
    std::vector<stats::CellSampleRow> rows;
    for (std::size_t position = 0; position < order.size(); ++position) {
      const Timed& one = order[position];
      stats::CellSampleRow row;
      row.group = one.planned->group;
      row.cell = one.planned->name;
      row.algorithm = one.contestant->name;
      row.round = round;
      row.position = static_cast<std::int64_t>(position);
      row.repeats = static_cast<std::int64_t>(
          std::clamp(std::ceil(request_.sample_seconds / std::max(one.seconds, 1e-7)), 1.0, 1e6));
      const base::Stopwatch watch;
      for (std::int64_t k = 0; k < row.repeats; ++k) one.contestant->answer();
      row.seconds = watch.seconds() / static_cast<double>(row.repeats) /
                    static_cast<double>(std::max<std::int64_t>(one.queries, 1));
      rows.push_back(row);
    }
    const std::string noise =
        measure::noise_judge()(before, measure::NoiseReading::now(), whole.seconds(), 0);
    for (stats::CellSampleRow& row : rows) {
      row.noise = noise;
      folder_.write(raw_file, row);
    }
  }

  const CellRequest& request_;
  record::ResultFolder folder_;
  CellRunResult result_;
};

}  // namespace

CellRunResult run_cells(const CellRequest& request, const std::filesystem::path& folder,
                        record::FolderStart start,
                        const std::function<void(const std::string&)>& say) {
  return CellRun(request, folder, start).run(say);
}

}  // namespace touchstone::cells
