// Draws the cases of a job, asks the contestants and counts their grades.
#include "harness/check/families/family_job.h"

#include <algorithm>
#include <memory>

namespace touchstone::check {
namespace {

std::vector<FamilyCount> count(const CheckRequest& request, std::uint32_t family,
                               std::uint64_t round, const kinds::BatchRange& range,
                               std::span<const kinds::CaseForm> forms) {
  std::vector<FamilyCount> counts;
  const kinds::Family& of = *request.families[family];
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

kinds::BatchRange cases_of_round(const CheckRequest& request, const kinds::Family& family,
                                 std::uint64_t round) {
  const auto cases = static_cast<std::size_t>(std::max(request.cases / family.one_in, 1));
  return {request.seed, round * cases, cases};
}

std::vector<FamilyCount> do_family_job(const CheckRequest& request, std::uint32_t family,
                                       std::uint64_t round) {
  return count(request, family, round, cases_of_round(request, *request.families[family], round),
               kinds::all_case_forms);
}

std::vector<FamilyCount> count_as_drawn(const CheckRequest& request, std::uint32_t family,
                                        std::uint64_t round, const kinds::BatchRange& range) {
  constexpr std::array as_drawn = {kinds::CaseForm::as_drawn};
  return count(request, family, round, range, as_drawn);
}

}  // namespace touchstone::check
