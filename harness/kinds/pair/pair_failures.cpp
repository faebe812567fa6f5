// Selects failing cases, shrinks them and writes them to files.
#include "harness/kinds/pair/pair_failures.h"

#include <fmt/format.h>

#include <utility>

#include "harness/grade/failures/shrunk_failure.h"
#include "harness/grade/wrong.h"
#include "harness/kinds/pair/metamorphic.h"
#include "harness/process/limited_query.h"
#include "harness/process/worker_pool.h"

namespace touchstone::kinds {
namespace {

// Returns a file name such as "gjk-double-distance".
std::string stem(const PairRequest& request, const grade::Query& query) {
  return fmt::format("{}-{}-{}", request.narrow[query.entry]->info.name, to_string(query.scalar),
                     to_string(query.task));
}

}  // namespace

std::vector<grade::GradedAnswer> ask_again(const PairRequest& request,
                                           const std::vector<WrongQuery>& found) {
  oracle::Oracle oracle;
  std::vector<grade::GradedAnswer> answers;
  for (const auto& [query, place] : found) {
    const NarrowPhaseEntry& algorithm = *request.narrow[query.entry];
    const Regime& regime = *request.regimes[query.regime];
    const auto index = static_cast<std::uint64_t>(place);
    grade::TrueCase c(make(regime, request.seed, index), index, oracle);
    const std::vector<Outcome> outcomes =
        process::ask_limited(algorithm, {.scalar = query.scalar}, {{&c.pair(), query.task}},
                             {.seconds = request.time_limit, .lost = most_lost});
    answers.push_back(grade::grade_answer(algorithm, regime.extreme, query, c, outcomes.front()));
  }
  return answers;
}

std::string query_command(const PairRequest& request, const grade::Query& query,
                          const std::filesystem::path& file) {
  return fmt::format("touchstone query {} --narrow {} --task {} --scalar {} --out answers.csv",
                     file.string(), request.narrow[query.entry]->info.name, to_string(query.task),
                     to_string(query.scalar));
}

std::string FailureCase::command(const PairRequest& request) const {
  return query_command(request, grade::query_of(answer), file);
}

std::vector<FailureCase> write_failures(const PairRequest& request,
                                        const std::vector<grade::GradedAnswer>& failures) {
  grade::CaseFiles files(request.out);
  std::vector<FailureCase> cases;
  const auto case_of = [&](const grade::GradedAnswer& failure) {
    return make(*request.regimes[failure.regime], request.seed, failure.index);
  };
  process::run_jobs<grade::ShrunkFailure>(
      0, failures.size(), request.workers,
      [&] {
        return [&](std::size_t job) {
          const grade::GradedAnswer& failure = failures[job];
          return grade::shrunk_failure({.algorithm = request.narrow[failure.entry],
                                        .extreme = request.regimes[failure.regime]->extreme,
                                        .time_limit = request.time_limit,
                                        .original = case_of(failure),
                                        .answer = failure});
        };
      },
      [&](std::size_t job, const grade::ShrunkFailure& shrunk) {
        const grade::GradedAnswer& failure = failures[job];
        const std::filesystem::path file =
            files.add(stem(request, grade::query_of(failure)), shrunk.line);
        cases.push_back({shrunk.answer, case_of(failure).id,
                         grade::describe(*request.narrow[failure.entry], shrunk.answer,
                                         request.regimes[failure.regime]->extreme),
                         file});
        return true;
      });
  files.close();
  return cases;
}

std::vector<VariantFailure> write_variant_failures(const PairRequest& request,
                                                   const std::vector<VariantCount>& beyond) {
  grade::CaseFiles files(request.out);
  std::vector<VariantFailure> failures;
  for (const VariantCount& count : beyond) {
    const grade::Query query = {count.regime, count.entry, count.scalar, count.task};
    const files::Case original =
        make(*request.regimes[count.regime], request.seed, count.worst_index);
    const std::string name = stem(request, query) + "-variants";
    std::filesystem::path file = files.add(name, files::to_json(original));
    for (const Variant& variant : sampled_variants(original, request.seed, count.worst_index)) {
      if (kind_of(variant) == count.kind) files.add(name, files::to_json(variant.transformed));
    }
    failures.push_back({query, original.id, count, std::move(file)});
  }
  files.close();
  return failures;
}

std::vector<TruthFailure> write_truth_failures(const PairRequest& request,
                                               const std::vector<JobSummary>& jobs) {
  grade::CaseFiles files(request.out);
  std::vector<TruthFailure> failures;
  for (const JobSummary& job : jobs) {
    if (job.refused + job.boxes_broken == 0) continue;
    const files::Case c = make(*request.regimes[job.regime], request.seed, job.worst_index);
    failures.push_back({job, c.id, files.add("truth", files::to_json(c))});
  }
  files.close();
  return failures;
}

}  // namespace touchstone::kinds
