// Does the jobs of a soak, sums their counts and writes its files.
#include "harness/check/soak/soak.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/clock.h"
#include "harness/base/progress.h"
#include "harness/check/families/family_rows.h"
#include "harness/check/job_folder.h"
#include "harness/check/soak/soak_job.h"
#include "harness/check/soak/soak_rows.h"
#include "harness/files/text_file.h"
#include "harness/record/machine.h"
#include "harness/record/own_files.h"

namespace touchstone::check {
namespace {

constexpr double seconds_between_writes = 1;
constexpr const char* summary_file = "soak.csv";

class Soak {
 public:
  explicit Soak(const SoakRequest& request)
      : request_(request), algorithms_(request.algorithms()), folder_(soak_folder(request)) {
    folder_.each_row<SoakJobRow>(
        0, [&](const SoakJobRow& row) { add(row); }, request_.subjects());
    folder_.each_row<FamilyCount>(
        1, [&](const FamilyCount& row) { add_to(result_.families, row); }, request_.subjects());
  }

  SoakResult run() {
    const base::UnitRange jobs = request_.jobs(jobs_of(request_));
    result_.drawn = folder_.units() * cases_a_soak_job;
    if (folder_.units() < jobs.size()) result_.interrupted = do_all(jobs);
    if (result_.interrupted) return result_;
    if (!request_.part) {
      write_summary();
      write_cases();
      result_.failures = write_family_failures(request_, result_.families);
    }
    folder_.finish();
    return result_;
  }

 private:
  // Returns true if an interrupt ended them.
  bool do_all(base::UnitRange jobs) {
    const std::int64_t verdicts = std::min(jobs.size() * cases_a_soak_job, request_.pairs);
    base::Progress progress(1);
    progress.start(fmt::format("{} verdicts", verdicts));
    base::Stopwatch since_written;
    return do_jobs<SoakJobResult>(
        folder_, request_, jobs,
        [&](std::size_t job, oracle::Oracle& oracle) { return do_soak_job(request_, job, oracle); },
        [&](std::size_t job, const SoakJobResult& result) {
          take(job, result);
          progress.part(static_cast<double>(result_.drawn) / static_cast<double>(verdicts));
          if (!request_.part && since_written.seconds() > seconds_between_writes) {
            write_summary();
            since_written.restart();
          }
          return true;
        });
  }

  void take(std::size_t job, const SoakJobResult& result) {
    for (const FamilyCount& count : result.families) {
      folder_.write(1, count, request_.subjects());
      add_to(result_.families, count);
    }
    for (std::size_t i = 0; i < result.counts.size(); ++i) {
      const SoakJobRow row = {.entry = algorithms_[i].entry,
                              .regime = static_cast<std::uint32_t>(job % request_.period()),
                              .scalar = algorithms_[i].scalar,
                              .round = job / request_.period(),
                              .count = result.counts[i]};
      folder_.write(0, row, request_.subjects());
      add(row);
    }
    result_.drawn += cases_a_soak_job;
  }

  void add(const SoakJobRow& row) {
    result_.counts[{row.entry, row.scalar, row.regime}].add(row.count);
  }

  void write_summary() const {
    std::vector<SoakRow> rows;
    for (const auto& [key, count] : result_.counts) {
      const auto& [entry, scalar, regime] = key;
      rows.push_back({.entry = static_cast<std::uint32_t>(entry),
                      .regime = static_cast<std::uint32_t>(regime),
                      .scalar = scalar,
                      .seed = request_.seed,
                      .drawn = result_.drawn,
                      .count = count,
                      .program = program_});
    }
    record::write_rows(folder_.path(summary_file), rows, request_.subjects());
  }

  // Writes the first wrong answer of each count.
  void write_cases() const {
    record::OwnFiles own(request_.out);
    own.remove([](const std::string&) { return true; });
    for (const auto& [key, count] : result_.counts) {
      const auto& [entry, scalar, regime] = key;
      if (count.first_wrong < 0) continue;
      const files::Case c = make(*request_.regimes[regime], request_.seed,
                                 static_cast<std::uint64_t>(count.first_wrong));
      std::filesystem::path file =
          own.free_stem("", fmt::format("{}-{}-{}", request_.narrow[entry]->info.name,
                                        to_string(scalar), request_.regimes[regime]->name));
      file += ".jsonl";
      own.note({file});
      files::write_text(file, files::to_json(c) + "\n");
    }
  }

  const SoakRequest& request_;
  std::vector<CheckedAlgorithm> algorithms_;
  std::string program_ = record::hash_of_program();
  record::ResultFolder folder_;
  SoakResult result_;
};

}  // namespace

record::ResultFolderPlan soak_folder(const SoakRequest& request) {
  auto plan = job_folder(request, "soak", regimes_fact(request),
                         {{"jobs.csv", record::header_of<SoakJobRow>(request.subjects())},
                          {"families.csv", record::header_of<FamilyCount>(request.subjects())}});
  plan.made = {summary_file};
  return plan;
}

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
  if (!broken_family_promises(request, failures).empty()) return true;
  return std::ranges::any_of(counts, [&](const auto& item) {
    const NarrowPhaseEntry& entry = *request.narrow[std::get<0>(item.first)];
    return entry.info.origin == Origin::ours && !entry.traits.approximate &&
           (item.second.silent > 0 || item.second.lost > 0);
  });
}

SoakResult run_soak(const SoakRequest& request) { return Soak(request).run(); }

}  // namespace touchstone::check
