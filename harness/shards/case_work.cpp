// A check, a stress sweep or a soak as work in shards: its units are jobs.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "harness/base/clock.h"
#include "harness/check/axes/stress_run.h"
#include "harness/check/check_job.h"
#include "harness/check/check_run.h"
#include "harness/check/requests/case_run.h"
#include "harness/check/soak/soak_job.h"
#include "harness/process/worker_pool.h"
#include "harness/shards/work.h"

namespace touchstone::shards {
namespace {

using check::CheckRequest;
using check::SoakRequest;
using check::StressRequest;

std::int64_t jobs_of(const StressRequest& request) {
  return static_cast<std::int64_t>(request.job_count());
}

record::ResultFolderPlan folder_of(const CheckRequest& request) { return check_folder(request); }
record::ResultFolderPlan folder_of(const StressRequest& request) { return stress_folder(request); }
record::ResultFolderPlan folder_of(const SoakRequest& request) { return soak_folder(request); }

// The jobs of one round, and the share of its cases with which a job is tried.
std::int64_t period(const CheckRequest& request) {
  return static_cast<std::int64_t>(request.period());
}
std::int64_t period(const StressRequest& request) { return jobs_of(request); }
std::int64_t period(const SoakRequest& request) {
  return std::min(static_cast<std::int64_t>(request.period()), jobs_of(request));
}

// Makes the job smaller, and returns by how much. A few cases have one that is proven too.
double make_trial(CheckRequest& request) {
  constexpr int tried_cases = 5;
  const int before = request.cases;
  request.cases = std::min(request.cases, tried_cases);
  return static_cast<double>(before) / request.cases;
}
double make_trial(SoakRequest& /*request*/) { return 1; }

void do_trial(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle) {
  check::do_job(request, job, oracle);
}
void do_trial(const StressRequest& request, std::size_t job, oracle::Oracle& oracle) {
  check::do_stress_job(request, job, oracle);
}
void do_trial(const SoakRequest& request, std::size_t job, oracle::Oracle& oracle) {
  check::do_soak_job(request, job, oracle);
}

template <class Request>
std::vector<double> estimate_of(Request request) {
  const double times = make_trial(request);
  std::vector<double> seconds;
  process::run_jobs<double>(
      0, static_cast<std::size_t>(period(request)), request.workers,
      [&] {
        const auto oracle = std::make_shared<oracle::Oracle>();
        return [&request, oracle](std::size_t job) {
          const base::Stopwatch watch;
          do_trial(request, job, *oracle);
          return watch.seconds();
        };
      },
      [&](std::size_t, double taken) {
        seconds.push_back(std::max(taken * times, 1e-6));
        return true;
      });
  return seconds;
}

class CaseWork final : public Work {
 public:
  explicit CaseWork(const std::filesystem::path& file) : file_(check::read_case_file(file)) {}

  std::string_view kind() const override { return file_.kind(); }
  const std::string& name() const override { return file_.name; }
  bool is_timed() const override { return false; }
  bool belongs_to_previous(std::int64_t /*unit*/) const override { return false; }
  std::int64_t units() const override {
    return std::visit([](const auto& request) -> std::int64_t { return jobs_of(request); },
                      file_.request);
  }
  record::Facts identity() const override {
    record::Facts facts =
        std::visit([](const auto& request) { return folder_of(request).identity; }, file_.request);
    facts.emplace_back("jobs", std::to_string(units()));
    return facts;
  }
  std::vector<double> estimate(const std::filesystem::path& earlier) const override {
    expect_no_earlier(earlier);
    return std::visit([](const auto& request) { return estimate_of(request); }, file_.request);
  }
  void expect_planned(const record::Facts& planned, base::UnitRange /*units*/) const override {
    expect_facts(planned, identity());
  }

  PartEnd run(const record::Part& part, const std::filesystem::path& folder,
              record::FolderStart start, int workers) override {
    CheckRequest& common = file_.common();
    common.part = part;
    common.out = folder;
    common.workers = workers;
    common.resume = start == record::FolderStart::resume;
    return check::run_case_file(file_).interrupted ? PartEnd::interrupted : PartEnd::done;
  }

  std::vector<std::string> row_files() const override {
    std::vector<std::string> names;
    for (const record::RowFile& file :
         std::visit([](const auto& request) { return folder_of(request); }, file_.request).files)
      names.push_back(file.name);
    return names;
  }

  // The joined rows are those of work that was stopped after its last job. To resume it makes what
  // is made of all rows.
  Merged merge(std::span<const DonePart> parts, const MergeFolder& folder) override {
    CheckRequest& common = file_.common();
    common.part.reset();
    common.out = folder.path;
    common.resume = false;
    {
      record::ResultFolderPlan plan =
          std::visit([](const auto& request) { return folder_of(request); }, file_.request);
      const std::size_t files = plan.files.size();
      record::ResultFolder joined(std::move(plan));
      for (const DonePart& part : parts) {
        for (std::size_t file = 0; file < files; ++file) joined.append(file, part.folder);
      }
      joined.commit(units());
    }
    common.resume = true;
    check::CaseEnd end = check::run_case_file(file_);
    return {.text = std::move(end.text), .ours_wrong = end.ours_wrong};
  }

 private:
  check::CaseFile file_;
};

}  // namespace

std::unique_ptr<Work> case_work(const std::filesystem::path& file) {
  return std::make_unique<CaseWork>(file);
}

}  // namespace touchstone::shards
