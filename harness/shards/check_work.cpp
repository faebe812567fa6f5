// A check as work in shards: its units are jobs.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "harness/base/clock.h"
#include "harness/check/check_file.h"
#include "harness/check/check_run.h"
#include "harness/process/worker_pool.h"
#include "harness/shards/work.h"

namespace touchstone::shards {
namespace {

using check::CheckRequest;

// Tries the jobs of one round; with fewer cases, if they are not counts. A few cases have one that is proven too.
std::vector<double> estimate_of(CheckRequest request) {
  constexpr int tried_cases = 5;
  double times = 1;
  if (request.mode != check::CheckMode::count) {
    const int before = request.cases;
    request.cases = std::min(request.cases, tried_cases);
    times = static_cast<double>(before) / request.cases;
  }
  const auto period = static_cast<std::int64_t>(request.period());
  const check::CheckReport report(request);
  std::vector<double> seconds;
  process::run_jobs<double>(
      0, static_cast<std::size_t>(std::min(period, request.job_count())), request.workers,
      [&] {
        return [&](std::size_t job) {
          const base::Stopwatch watch;
          report.do_job(job);
          return watch.seconds();
        };
      },
      [&](std::size_t, double taken) {
        seconds.push_back(std::max(taken * times, 1e-6));
        return true;
      });
  return seconds;
}

class CheckWork final : public Work {
 public:
  explicit CheckWork(const std::filesystem::path& file) : file_(check::read_check_file(file)) {}

  std::string_view kind() const override { return "check"; }
  const std::string& name() const override { return file_.name; }
  bool is_timed() const override { return false; }
  bool belongs_to_previous(std::int64_t /*unit*/) const override { return false; }
  std::int64_t units() const override { return file_.request.job_count(); }
  record::Facts identity() const override {
    record::Facts facts = check::check_folder(file_.request).identity;
    facts.emplace_back("jobs", std::to_string(units()));
    return facts;
  }
  std::vector<double> estimate(const std::filesystem::path& earlier) const override {
    expect_no_earlier(earlier);
    return estimate_of(file_.request);
  }
  void expect_planned(const record::Facts& planned, base::UnitRange /*units*/) const override {
    expect_facts(planned, identity());
  }

  PartEnd run(const record::Part& part, const std::filesystem::path& folder,
              record::FolderStart start, int workers) override {
    CheckRequest& request = file_.request;
    request.part = part;
    request.out = folder;
    request.workers = workers;
    request.resume = start == record::FolderStart::resume;
    return check::run_and_tell(request).interrupted ? PartEnd::interrupted : PartEnd::done;
  }

  std::vector<std::string> row_files() const override {
    std::vector<std::string> names;
    for (const record::RowFile& file : check::check_folder(file_.request).files)
      names.push_back(file.name);
    return names;
  }

  // The joined rows are those of work that was stopped after its last job. To resume it makes what
  // is made of all rows.
  Merged merge(std::span<const DonePart> parts, const MergeFolder& folder) override {
    CheckRequest& request = file_.request;
    request.part.reset();
    request.out = folder.path;
    request.resume = false;
    {
      record::ResultFolderPlan plan = check::check_folder(request);
      const std::size_t files = plan.files.size();
      record::ResultFolder joined(std::move(plan));
      for (const DonePart& part : parts) {
        for (std::size_t file = 0; file < files; ++file) joined.append(file, part.folder);
      }
      joined.commit(units());
    }
    request.resume = true;
    check::CheckEnd end = check::run_and_tell(request);
    return {.text = std::move(end.text), .ours_wrong = end.ours_wrong};
  }

 private:
  check::CheckFile file_;
};

}  // namespace

std::unique_ptr<Work> check_work(const std::filesystem::path& file) {
  return std::make_unique<CheckWork>(file);
}

}  // namespace touchstone::shards
