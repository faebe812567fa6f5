// Does the jobs of a check, tallies their rows and writes the files.
#include "harness/check/check_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/base/clock.h"
#include "harness/base/progress.h"
#include "harness/check/check_rows.h"
#include "harness/check/envelope.h"
#include "harness/process/interrupt.h"
#include "harness/process/worker_pool.h"
#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

constexpr double broad_seconds = 20;  // time limit of a broad phase for a scene
constexpr double seconds_between_writes = 1;
constexpr const char* verdicts_file = "soak.csv";

class CheckRun {
 public:
  explicit CheckRun(const CheckRequest& request)
      : request_(request), folder_(check_folder(request)) {
    report_.request = &request;
    report_.jobs = folder_.units();
    if (!request.resume) return;
    std::size_t file = 0;
    for_each_row_file(request.mode, [&]<class Row>(const char*) {
      folder_.each_row<Row>(
          file++, [&](const Row& row) { report_.tally.add(row); }, request_.subjects());
    });
  }

  CheckReport run() {
    if (request_.period() > 0) report_.interrupted = do_all();
    if (report_.interrupted) return std::move(report_);
    folder_.finish();
    if (!request_.part) finish_report();
    return std::move(report_);
  }

 private:
  bool counts() const { return request_.mode == CheckMode::count; }

  // Does the jobs that the folder does not hold yet. Returns true if an interrupt ended them before the last.
  bool do_all() {
    const bool endless = request_.seconds > 0;
    const base::UnitRange jobs =
        request_.jobs(endless ? std::numeric_limits<std::int64_t>::max() : request_.job_count());
    if (folder_.units() >= jobs.size()) return false;
    const base::Stopwatch watch;
    base::Stopwatch since_written;
    const bool in_steps = !endless && !counts();
    base::Progress progress(in_steps ? static_cast<std::size_t>(jobs.size() - folder_.units()) : 1);
    if (endless) progress.start(fmt::format("checking for {:g} s", request_.seconds));
    if (counts()) {
      progress.start(
          fmt::format("{} verdicts", std::min(jobs.size() * cases_of_a_count_job, request_.count)));
    }
    const process::InterruptGuard guard;
    process::run_jobs<JobResult>(
        static_cast<std::size_t>(jobs.first + folder_.units()), static_cast<std::size_t>(jobs.end),
        request_.workers,
        [&] {
          // Each process has one oracle, which keeps its memory from query to query.
          const auto oracle = std::make_shared<oracle::Oracle>();
          return [this, oracle](std::size_t job) { return do_job(request_, job, *oracle); };
        },
        [&](std::size_t job, const JobResult& result) {
          keep(result);
          folder_.commit();
          if (in_steps) progress.start(name_of(job));
          if (counts()) {
            progress.part(static_cast<double>(folder_.units()) / static_cast<double>(jobs.size()));
            if (!request_.part && since_written.seconds() > seconds_between_writes) {
              write_verdicts();
              since_written.restart();
            }
          }
          if (endless) progress.part(watch.seconds() / request_.seconds);
          const bool goes_on = !endless || watch.seconds() < request_.seconds;
          return goes_on && !process::InterruptGuard::raised();
        });
    return process::InterruptGuard::raised() && folder_.units() < jobs.size();
  }

  // Writes and counts the rows of a job.
  void keep(const JobResult& result) {
    const CheckSubjects subjects = request_.subjects();
    std::size_t file = 0;
    for_each_row_file(request_.mode, [&]<class Row>(const char*) {
      for (const Row& row : result.rows<Row>()) {
        folder_.write(file, row, subjects);
        report_.tally.add(row);
      }
      ++file;
    });
    ++report_.jobs;
  }

  // What a job asks, for the terminal.
  std::string name_of(std::size_t job) const {
    const std::size_t place = job % request_.period();
    if (place >= request_.regime_jobs()) {
      return request_.families[place - request_.regime_jobs()]->name;
    }
    const Regime& regime = *request_.regimes[place];
    return regime.axis == nullptr ? regime.name
                                  : fmt::format("{} {}", regime.axis->name, value_of(regime).name);
  }

  void finish_report() {
    report_.failures = write_failures(request_, failing_answers(request_, report_.tally));
    report_.variant_failures = write_variant_failures(request_, report_.tally);
    report_.truth_failures = write_truth_failures(request_, report_.tally);
    report_.family_failures = write_family_failures(request_, report_.tally);
    switch (request_.mode) {
      case CheckMode::cases:
        if (!request_.broad.empty()) report_.scenes = box_scenes(request_.seed);
        report_.broad = check_broad_phases(request_.broad, report_.scenes, broad_seconds);
        write_summary(report_, request_.out / "summary.csv");
        break;
      case CheckMode::axes:
        write_envelope(request_, report_.tally.axis_counts(), request_.out / "envelope.csv");
        break;
      case CheckMode::count: write_verdicts(); break;
    }
  }

  void write_verdicts() const {
    std::vector<VerdictSum> rows;
    for (const auto& [key, count] : report_.tally.verdicts()) {
      rows.push_back({.count = count,
                      .seed = request_.seed,
                      .drawn = report_.jobs * cases_of_a_count_job,
                      .program = program_});
    }
    record::write_rows(folder_.path(verdicts_file), rows, request_.subjects());
  }

  const CheckRequest& request_;
  std::string program_ = record::hash_of_program();
  record::ResultFolder folder_;
  CheckReport report_;
};

// The names of the regimes, or axes, and families.
std::pair<std::string, std::string> subject_of(const CheckRequest& request) {
  std::vector<std::string_view> names;
  const bool has_axes = request.mode == CheckMode::axes;
  if (has_axes) {
    for (const Axis* axis : axes_of(request.subjects())) names.push_back(axis->name);
  } else if (!request.narrow.empty()) {
    for (const Regime* regime : request.regimes) names.push_back(regime->name);
  }
  for (const kinds::Family* family : request.families) names.push_back(family->name);
  return {has_axes ? "axes" : "regimes", fmt::format("{}", fmt::join(names, " "))};
}

}  // namespace

record::ResultFolderPlan check_folder(const CheckRequest& request) {
  std::vector<std::string_view> narrow, scalars;
  for (const NarrowPhaseEntry* entry : request.narrow) narrow.push_back(entry->info.name);
  std::vector<std::string> contestants;
  const auto name_of = request.subjects().contestant_name();
  for (std::size_t i = 0; i < request.contestants.size(); ++i) contestants.push_back(name_of(i));
  for (const Precision scalar : request.scalars) scalars.push_back(to_string(scalar));
  record::Facts notes = {{"check", request.resume ? "resumed" : "whole"}};
  for (auto& fact : record::machine_facts()) notes.push_back(std::move(fact));
  // To resume, these must be equal: all of the request but `out`, `seconds`, `count` and `workers`.
  record::Facts identity = {{"seed", std::to_string(request.seed)},
                            {"cases", std::to_string(request.cases)},
                            {"narrow", fmt::format("{}", fmt::join(narrow, " "))},
                            {"scalars", fmt::format("{}", fmt::join(scalars, " "))},
                            {"others", fmt::format("{}", fmt::join(contestants, ", "))},
                            subject_of(request),
                            {"time_limit", fmt::format("{}", request.time_limit)},
                            {"program", record::hash_of_program()}};
  if (request.part) {
    append_facts(*request.part, identity);
    notes.insert(notes.end(), request.part->notes.begin(), request.part->notes.end());
  }
  record::ResultFolderPlan plan = {.folder = request.out,
                                   .files = {},
                                   .identity = std::move(identity),
                                   .notes = std::move(notes),
                                   .start = record::resume_or_overwrite(request.resume),
                                   .work = "check"};
  for_each_row_file(request.mode, [&]<class Row>(const char* name) {
    plan.files.push_back({name, record::header_of<Row>(request.subjects())});
  });
  if (request.mode == CheckMode::count) plan.made = {verdicts_file};
  return plan;
}

CheckReport run_check(const CheckRequest& request) { return CheckRun(request).run(); }

}  // namespace touchstone::check
