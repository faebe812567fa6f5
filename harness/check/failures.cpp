// Selects failing cases, shrinks them and writes them to files.
#include "harness/check/failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "harness/check/axes/axes.h"
#include "harness/grade/failures/shrunk_failure.h"
#include "harness/grade/wrong.h"
#include "harness/kinds/kind.h"
#include "harness/process/limited_query.h"
#include "harness/process/worker_pool.h"

namespace touchstone::check {
namespace {

// Returns a file name such as "gjk-double-distance".
std::string stem(const CheckRequest& request, const grade::Query& query) {
  return fmt::format("{}-{}-{}", request.narrow[query.entry]->info.name, to_string(query.scalar),
                     to_string(query.task));
}

constexpr std::size_t axes_of_a_peer = 3;
constexpr double most_vertices = 100;  // limit of a readable case

// A query whose answer was wrong.
struct WrongQuery {
  grade::Query query;
  std::int64_t index;
};

grade::Query query_of_row(const AxisCount& row) {
  return {row.regime, row.entry, row.scalar, row.task};
}

bool is_readable(const CheckRequest& request, const AxisCount& row) {
  const Regime& regime = *request.regimes[row.regime];
  return regime.axis->name != "vertices" || regime.parameter <= most_vertices;
}

void find_of_ours(const CheckRequest& request, const std::vector<AxisCount>& rows,
                  std::vector<WrongQuery>& found) {
  std::map<std::tuple<std::uint32_t, Task, const Axis*>, bool> known;
  for (const AxisCount& row : rows) {
    if (request.narrow[row.entry]->info.origin != Origin::ours) continue;
    if (row.scalar != Precision::float64 || !is_readable(request, row)) continue;
    if (row.worst < 0 && row.lost < 0) continue;
    if (!std::exchange(known[{row.entry, row.task, request.regimes[row.regime]->axis}], true)) {
      found.push_back({query_of_row(row), row.lost < 0 ? row.worst : row.lost});
    }
  }
}

void find_of_peers(const CheckRequest& request, const std::vector<AxisCount>& rows,
                   std::vector<WrongQuery>& found) {
  std::map<std::pair<std::uint32_t, Precision>, std::vector<const AxisCount*>> silent, lost;
  for (const AxisCount& row : rows) {
    if (request.narrow[row.entry]->info.origin == Origin::ours) continue;
    if (!is_readable(request, row)) continue;
    if (row.worst >= 0) silent[{row.entry, row.scalar}].push_back(&row);
    if (row.lost >= 0) lost[{row.entry, row.scalar}].push_back(&row);
  }
  for (auto& [subject, list] : silent) {
    std::ranges::stable_sort(list, [](const AxisCount* x, const AxisCount* y) {
      return badness(x->margin, x->error) > badness(y->margin, y->error);
    });
    std::vector<const Axis*> taken;
    for (const AxisCount* row : list) {
      const Axis* const axis = request.regimes[row->regime]->axis;
      if (taken.size() == axes_of_a_peer) break;
      if (std::ranges::find(taken, axis) != taken.end()) continue;
      taken.push_back(axis);
      found.push_back({query_of_row(*row), row->worst});
    }
  }
  for (const auto& [subject, list] : lost) {
    found.push_back({query_of_row(*list.front()), list.front()->lost});
  }
}

std::vector<WrongQuery> wrong_on_axes(const CheckRequest& request,
                                      const std::vector<AxisCount>& rows) {
  std::vector<WrongQuery> found;
  find_of_ours(request, rows, found);
  find_of_peers(request, rows, found);
  std::ranges::stable_sort(found, {}, [](const WrongQuery& one) {
    return std::tuple(one.query.entry, one.query.scalar, one.query.task);
  });
  return found;
}

std::vector<WrongQuery> wrong_verdicts(const CheckRequest& request, const Tally& tally) {
  std::vector<WrongQuery> found;
  for (const auto& [key, count] : tally.verdicts()) {
    if (count.first_wrong < 0) continue;
    const bool ours = request.narrow[key.entry]->info.origin == Origin::ours;
    if (!ours && !found.empty() && found.back().query.entry == key.entry &&
        found.back().query.scalar == key.scalar)
      continue;
    found.push_back({{key.regime, key.entry, key.scalar, Task::intersect}, count.first_wrong});
  }
  return found;
}

std::vector<grade::GradedAnswer> ask_again(const CheckRequest& request,
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

}  // namespace

std::string query_command(const CheckRequest& request, const grade::Query& query,
                          const std::filesystem::path& file) {
  return fmt::format("touchstone query {} --narrow {} --task {} --scalar {} --out answers.csv",
                     file.string(), request.narrow[query.entry]->info.name, to_string(query.task),
                     to_string(query.scalar));
}

std::string FailureCase::command(const CheckRequest& request) const {
  return query_command(request, grade::query_of(answer), file);
}

std::vector<grade::GradedAnswer> failing_answers(const CheckRequest& request, const Tally& tally) {
  switch (request.mode) {
    case CheckMode::cases: break;
    case CheckMode::axes: return ask_again(request, wrong_on_axes(request, tally.axis_counts()));
    case CheckMode::count: return ask_again(request, wrong_verdicts(request, tally));
  }
  return tally.failures(request);
}

std::vector<FailureCase> write_failures(const CheckRequest& request,
                                        const std::vector<grade::GradedAnswer>& failures) {
  grade::remove_case_files(request.out);
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

std::vector<VariantFailure> write_variant_failures(const CheckRequest& request,
                                                   const Tally& tally) {
  grade::CaseFiles files(request.out);
  std::vector<VariantFailure> failures;
  for (const VariantCount& count : tally.variants_beyond()) {
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

std::vector<TruthFailure> write_truth_failures(const CheckRequest& request, const Tally& tally) {
  grade::CaseFiles files(request.out);
  std::vector<TruthFailure> failures;
  for (const JobSummary& job : tally.jobs()) {
    if (job.refused + job.boxes_broken == 0) continue;
    const files::Case c = make(*request.regimes[job.regime], request.seed, job.worst_index);
    failures.push_back({job, c.id, files.add("truth", files::to_json(c))});
  }
  files.close();
  return failures;
}

std::vector<FamilyFailure> write_family_failures(const CheckRequest& request, const Tally& tally) {
  std::vector<FamilyFailure> failures;
  record::OwnFiles own(request.out);
  for (const auto& [key, count] : tally.families()) {
    if (count.first_wrong < 0) continue;
    const kinds::Contestant& contestant = request.contestants[key.contestant];
    if (!contestant.promised && key.form != kinds::CaseForm::as_drawn) continue;
    const kinds::Family& family = *request.families[key.family];
    std::string name = fmt::format("{}-{}-{}", family.kind->name(), contestant.name(), family.name);
    if (key.form != kinds::CaseForm::as_drawn) name += "-" + std::string(to_string(key.form));
    std::ranges::replace(name, ' ', '-');
    const std::filesystem::path case_stem = own.free_stem(grade::failures_folder, name);
    const auto first = static_cast<std::uint64_t>(count.first_wrong);
    const auto batch = family.kind->draw(family, {request.seed, first, 1});
    failures.push_back({count, batch->write(contestant, 0, case_stem)});
    own.note_stem(case_stem);
  }
  return failures;
}

}  // namespace touchstone::check
