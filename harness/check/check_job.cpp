// Does jobs: those of families here, for all contestants of their kinds.
#include "harness/check/check_job.h"

#include <cmath>
#include <memory>
#include <span>

#include "harness/kinds/kind.h"

namespace touchstone::check {
namespace {

// The cases of a family in a round: as many as the request says, or fewer.
kinds::BatchRange cases_of_round(const CheckRequest& request, const kinds::Family& family,
                                 std::uint64_t round) {
  const auto cases = request.mode == CheckMode::count
                         ? static_cast<std::size_t>(cases_of_a_count_job)
                         : static_cast<std::size_t>(std::max(request.cases / family.one_in, 1));
  return {request.seed, round * cases, cases};
}

// Asks all contestants for all cases, of the mode `cases` in every form. A contestant that takes none
// has no count.
std::vector<FamilyCount> counts_of_family(const CheckRequest& request, std::uint32_t family,
                                          std::uint64_t round) {
  constexpr std::span<const kinds::CaseForm> all_forms = kinds::all_case_forms;
  const auto forms = request.mode == CheckMode::cases ? all_forms : all_forms.first(1);
  std::vector<FamilyCount> counts;
  const kinds::Family& of = *request.families[family];
  const kinds::BatchRange range = cases_of_round(request, of, round);
  const std::unique_ptr<kinds::Batch> batch = of.kind->draw(of, range);
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    const kinds::Contestant& contestant = request.contestants[place];
    if (contestant.kind != of.kind) continue;
    for (const kinds::CaseForm form : forms) {
      FamilyCount one;
      one.family = family;
      one.contestant = place;
      one.round = round;
      one.form = form;
      const auto grades = batch->ask(contestant, form, request.time_limit);
      for (std::size_t i = 0; i < grades.size(); ++i) {
        one.add(grades[i], static_cast<std::int64_t>(range.first + i));
      }
      if (one.cases > 0) counts.push_back(one);
    }
  }
  return counts;
}

}  // namespace

JobResult do_job(const CheckRequest& request, std::size_t job, oracle::Oracle& oracle) {
  const std::size_t place = job % request.period();
  if (place >= request.regime_jobs()) {
    JobResult result;
    result.rows<FamilyCount>() = counts_of_family(
        request, static_cast<std::uint32_t>(place - request.regime_jobs()), job / request.period());
    return result;
  }
  switch (request.mode) {
    case CheckMode::cases: break;
    case CheckMode::axes: return do_axis_job(request, job, oracle);
    case CheckMode::count: return do_count_job(request, job, oracle);
  }
  return do_pair_job(request, job, oracle);
}

double badness(double margin, double error) {
  if (!std::isnan(margin)) return 1e3 * (1 + margin);
  return std::isnan(error) ? 0 : std::min(error, 1e3);
}

void VerdictCount::add(const VerdictCount& other) {
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

std::vector<Variant> sampled_variants(const files::Case& c, std::uint64_t seed,
                                      std::uint64_t index) {
  if (!is_sampled(index)) return {};
  base::Random random(seed, index);
  return variants(c, random);
}

std::string kind_of(const Variant& variant) {
  return variant.name.substr(0, variant.name.find_first_of("+-"));
}

}  // namespace touchstone::check
