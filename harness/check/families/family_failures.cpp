// Writes case files of families.
#include "harness/check/families/family_failures.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/grade/failures/case_files.h"
#include "harness/kinds/kind.h"

namespace touchstone::check {

std::vector<FamilyFailure> write_family_failures(const CheckRequest& request,
                                                 const FamilyCounts& counts) {
  std::vector<FamilyFailure> failures;
  record::OwnFiles own(request.out);
  for (const auto& [key, count] : counts) {
    if (count.first_wrong < 0) continue;
    const kinds::Contestant& contestant = request.contestants[key.contestant];
    if (!contestant.promised && key.form != kinds::CaseForm::as_drawn) continue;
    const kinds::Family& family = *request.families[key.family];
    std::string name = fmt::format("{}-{}-{}", family.kind->name(), contestant.name(), family.name);
    if (key.form != kinds::CaseForm::as_drawn) name += "-" + std::string(to_string(key.form));
    std::ranges::replace(name, ' ', '-');
    const std::filesystem::path stem = own.free_stem(grade::failures_folder, name);
    const auto first = static_cast<std::uint64_t>(count.first_wrong);
    const auto batch = family.kind->draw(family, {request.seed, first, 1});
    failures.push_back({count, batch->write(contestant, 0, stem)});
    own.note_stem(stem);
  }
  return failures;
}

std::vector<std::string> broken_family_promises(const CheckRequest& request,
                                                const std::vector<FamilyFailure>& failures) {
  std::vector<std::string> lines;
  for (const auto& [count, command] : failures) {
    const kinds::Contestant& contestant = request.contestants[count.contestant];
    if (!contestant.promised) continue;
    lines.push_back(fmt::format(
        "{} on {}, {}: of {} cases {} missed, {} false, {} inexact, {} failed; first case {}: {}",
        contestant.name(), request.families[count.family]->name, to_string(count.form), count.cases,
        count.missed, count.false_hits, count.inexact, count.failed, count.first_wrong, command));
  }
  return lines;
}

}  // namespace touchstone::check
