// Does the jobs of a check, keeps their rows and lets the checkers write the rest.
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
#include "harness/grade/failures/shrunk_failure.h"
#include "harness/modules/modules.h"
#include "harness/process/interrupt.h"
#include "harness/process/worker_pool.h"
#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

constexpr double seconds_between_writes = 1;

class CheckRun {
 public:
  explicit CheckRun(const CheckRequest& request)
      : request_(request), folder_(check_folder(request)), report_(request) {
    report_.jobs = folder_.units();
    std::size_t file = 0;
    for (const auto& checker : report_.checkers) {
      first_files_.push_back(file);
      if (request.resume) checker->take_up(folder_, file);
      file += checker->files().size();
    }
  }

  CheckReport run() {
    if (request_.period() > 0) report_.interrupted = do_all();
    if (report_.interrupted) return std::move(report_);
    folder_.finish();
    if (request_.part) return std::move(report_);
    grade::remove_case_files(request_.out);
    for (const auto& checker : report_.checkers) {
      checker->finish();
      checker->write_made(report_.jobs);
    }
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
      progress.start(fmt::format(
          "{} verdicts", std::min(jobs.size() * kinds::cases_of_a_count_job, request_.count)));
    }
    const process::InterruptGuard guard;
    process::run_jobs(
        static_cast<std::size_t>(jobs.first + folder_.units()), static_cast<std::size_t>(jobs.end),
        request_.workers, [&] { return [this](std::size_t job) { return report_.do_job(job); }; },
        [&](std::size_t job, const std::string& rows) {
          const kinds::Family& family = *request_.families[job % request_.period()];
          const std::size_t checker = report_.checker_of(family);
          report_.checkers[checker]->keep(rows, folder_, first_files_[checker]);
          ++report_.jobs;
          folder_.commit();
          if (in_steps) {
            progress.start(family.axis.empty() ? family.name
                                               : fmt::format("{} {}", family.axis, family.value));
          }
          if (counts()) {
            progress.part(static_cast<double>(folder_.units()) / static_cast<double>(jobs.size()));
            if (!request_.part && since_written.seconds() > seconds_between_writes) {
              for (const auto& one : report_.checkers) one->write_made(report_.jobs);
              since_written.restart();
            }
          }
          if (endless) progress.part(watch.seconds() / request_.seconds);
          const bool goes_on = !endless || watch.seconds() < request_.seconds;
          return goes_on && !process::InterruptGuard::raised();
        });
    return process::InterruptGuard::raised() && folder_.units() < jobs.size();
  }

  const CheckRequest& request_;
  record::ResultFolder folder_;
  CheckReport report_;
  std::vector<std::size_t> first_files_;  // of each checker, in the folder
};

}  // namespace

record::ResultFolderPlan check_folder(const CheckRequest& request) {
  std::vector<std::string> contestants;
  std::vector<std::string_view> families, scalars;
  for (const auto& contestant : request.contestants) {
    contestants.push_back(contestant_name(contestant));
  }
  for (const kinds::Family* family : request.families) families.push_back(family->name);
  for (const Precision scalar : request.scalars) scalars.push_back(to_string(scalar));
  record::Facts notes = {{"check", request.resume ? "resumed" : "whole"}};
  for (auto& fact : record::machine_facts()) notes.push_back(std::move(fact));
  // To resume, these must be equal: all of the request but `out`, `seconds`, `count` and `workers`.
  record::Facts identity = {{"mode", std::to_string(static_cast<int>(request.mode))},
                            {"seed", std::to_string(request.seed)},
                            {"cases", std::to_string(request.cases)},
                            {"contestants", fmt::format("{}", fmt::join(contestants, ", "))},
                            {"scalars", fmt::format("{}", fmt::join(scalars, " "))},
                            {"families", fmt::format("{}", fmt::join(families, " "))},
                            {"time_limit", fmt::format("{}", request.time_limit)},
                            {"program", record::hash_of_program()}};
  for (auto& fact : modules::facts()) identity.push_back(std::move(fact));
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
  for (const auto& checker : CheckReport(request).checkers) {
    for (record::RowFile& file : checker->files()) plan.files.push_back(std::move(file));
    for (std::string& name : checker->made()) plan.made.push_back(std::move(name));
  }
  return plan;
}

CheckReport run_check(const CheckRequest& request) { return CheckRun(request).run(); }

}  // namespace touchstone::check
