// Grades the contestants of each set in a process of their own, then has them timed.
#include "harness/cells/cell_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/cells/set_timing.h"
#include "harness/process/interrupt.h"
#include "harness/process/isolate.h"
#include "harness/record/machine.h"
#include "harness/record/raw_row.h"
#include "harness/stats/cell_rows.h"

namespace touchstone::cells {
namespace {

enum File : std::size_t { grades_file, raw_file };

struct Graded {
  kinds::TimedGrade grade;
  double seconds = 0;      // of one answer to all queries, warm if it is in time
  std::uint64_t hash = 0;  // of the answers
  process::ItemState state = process::ItemState::not_run;

  bool takes_all() const { return grade.not_asked == 0; }
};

std::vector<Graded> grade(const kinds::TimedSet& cell, double time_limit) {
  struct Shared {
    kinds::TimedGrade grade;
    double seconds;
    std::uint64_t hash;
  };
  process::SharedArray<Shared> shared(cell.contestants.size());
  process::IsolationLimits limits;
  limits.item_seconds = 5 * time_limit;
  const process::IsolationReport report =
      process::isolate(cell.contestants.size(), limits, [&]() -> process::ItemWork {
        return [&](std::size_t i) {
          const kinds::TimedContestant& contestant = cell.contestants[i];
          if (contestant.prepare) contestant.prepare();
          const base::Stopwatch watch;
          contestant.answer();
          double seconds = watch.seconds();
          // What is cold takes longer than the samples, so that it would cut them short.
          if (seconds <= time_limit) {
            const base::Stopwatch again;
            contestant.answer();
            seconds = std::min(seconds, again.seconds());
          }
          shared[i].seconds = seconds;
          if (contestant.hash) shared[i].hash = contestant.hash();
          shared[i].grade = contestant.grade();
        };
      });
  std::vector<Graded> graded;
  for (std::size_t i = 0; i < cell.contestants.size(); ++i)
    graded.push_back({shared[i].grade, shared[i].seconds, shared[i].hash, report.states[i]});
  return graded;
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
    take_over();
    const std::vector<std::span<const kinds::PlannedSet>> all = with_joined(request_.cells);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (is_done(i)) continue;
      for (const kinds::PlannedSet& planned : all[i]) {
        say(fmt::format("[{}/{}] {}, {}", &planned - request_.cells.data() + 1,
                        request_.cells.size(), planned.group, planned.name));
      }
      if (!measure(all[i], i)) {
        result_.interrupted = true;
        return result_;
      }
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
    plan.files = {{"set_grades.csv", record::header_of<stats::GradeRow>()},
                  {"raw.csv", record::header_of<record::RawRow>()}};
    plan.identity = {{"cells", request.name},
                     {"rounds", std::to_string(request.rounds)},
                     {"sample_seconds", fmt::format("{}", request.sample_seconds)},
                     {"order_seed", std::to_string(request.seed)}};
    plan.identity.insert(plan.identity.end(), request.identity.begin(), request.identity.end());
    for (auto& fact : record::machine_facts()) plan.identity.push_back(std::move(fact));
    plan.start = start;
    plan.made = {"set_times.csv", "set_best.csv", "set_speed_ups.csv", "tables.md"};
    return plan;
  }

  void note(const stats::GradeRow& row) {
    result_.ours_wrong |= (row.origin == "ours" || row.origin == "module") && !row.approximate &&
                          (!row.is_right() || row.status == "crashed");
  }
  // A crash or another answer of ours in a sample is as wrong as one that was graded.
  void note(const record::RawRow& row) {
    result_.ours_wrong |= record::is_answerable(row.origin) &&
                          (row.wrong() || row.status == record::RowStatus::crashed);
  }
  // Notes what a run did that was stopped.
  void take_over() {
    folder_.each_row<stats::GradeRow>(grades_file, [&](const stats::GradeRow& row) {
      note(row);
      graded_.emplace(row.group, row.cell);
    });
    folder_.each_row<record::RawRow>(raw_file, [&](const record::RawRow& row) {
      note(row);
      earlier_[row.block].push_back(row);
    });
  }
  bool is_done(std::size_t number) const {
    if (folder_.was_finished()) return true;
    const auto earlier = earlier_.find(static_cast<std::int64_t>(number));
    return earlier != earlier_.end() &&
           std::ranges::any_of(earlier->second,
                               [](const record::RawRow& row) { return !row.stop.empty(); });
  }

  // Returns false if it was interrupted.
  bool measure(std::span<const kinds::PlannedSet> joined, std::size_t number) {
    // Grades of a run that was stopped stand in the folder, and the answers are needed again.
    const bool is_graded = graded_.contains({joined.front().group, joined.front().name});
    std::vector<kinds::TimedSet> cells;
    for (const kinds::PlannedSet& planned : joined) cells.push_back(planned.make());
    std::vector<SetMember> members;
    for (std::size_t k = 0; k < joined.size(); ++k) {
      const kinds::PlannedSet& planned = joined[k];
      const kinds::TimedSet& cell = cells[k];
      const std::vector<Graded> graded = grade(cell, request_.time_limit);
      for (std::size_t i = 0; i < graded.size(); ++i) {
        const kinds::TimedContestant& contestant = cell.contestants[i];
        if (!is_graded) write_grade(planned, cell, contestant, graded[i]);
        if (graded[i].state != process::ItemState::done || !graded[i].takes_all() ||
            graded[i].seconds > request_.time_limit)
          continue;
        members.push_back({.planned = &planned,
                           .contestant = &contestant,
                           .queries = std::max<std::int64_t>(cell.queries, 1),
                           .seconds = graded[i].seconds,
                           .hash = graded[i].hash});
      }
      if (is_graded) continue;
      for (const kinds::LeftOut& left_out : cell.left_out) write_left_out(planned, cell, left_out);
    }
    if (!is_graded) folder_.commit();
    if (!members.empty() && !process::InterruptGuard::raised()) {
      const auto place = static_cast<std::int64_t>(number);
      SetTiming(request_, place, with_twins(members), earlier_[place])
          .run([&](std::span<const record::RawRow> rows) {
            for (const record::RawRow& row : rows) {
              note(row);
              folder_.write(raw_file, row);
            }
            folder_.commit();
          });
    }
    return !process::InterruptGuard::raised();
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
    static_cast<kinds::GradeCount&>(row) = graded.grade;
    row.error = graded.grade.error;
    row.hits = graded.grade.hits;
    row.true_hits = graded.grade.true_hits;
    if (row.hits >= 0) row.hit_hash = base::to_hex(graded.grade.hit_hash);
    row.status = graded.takes_all() ? to_string(graded.state) : to_string(Status::unsupported);
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

  const CellRequest& request_;
  record::ResultFolder folder_;
  CellRunResult result_;
  std::set<std::pair<std::string, std::string>> graded_;         // group and name of sets
  std::map<std::int64_t, std::vector<record::RawRow>> earlier_;  // by the number of the sets
};

}  // namespace

CellRunResult run_cells(const CellRequest& request, const std::filesystem::path& folder,
                        record::FolderStart start,
                        const std::function<void(const std::string&)>& say) {
  return CellRun(request, folder, start).run(say);
}

}  // namespace touchstone::cells
