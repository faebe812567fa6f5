// Describes the result folder of a check, a stress sweep or a soak.
#include "harness/check/job_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "harness/record/machine.h"

namespace touchstone::check {

std::pair<std::string, std::string> regimes_fact(const CheckRequest& request) {
  std::vector<std::string_view> regimes;
  if (!request.narrow.empty()) {
    for (const Regime* regime : request.regimes) regimes.push_back(regime->name);
  }
  for (const kinds::Family* family : request.families) regimes.push_back(family->name);
  return {"regimes", fmt::format("{}", fmt::join(regimes, " "))};
}

record::ResultFolderPlan job_folder(const CheckRequest& request, std::string work,
                                    std::pair<std::string, std::string> subject,
                                    std::vector<record::RowFile> files) {
  std::vector<std::string_view> narrow, scalars;
  for (const NarrowPhaseEntry* entry : request.narrow) narrow.push_back(entry->info.name);
  std::vector<std::string> contestants;
  for (const kinds::Contestant& contestant : request.contestants) {
    contestants.push_back(fmt::format("{} {}", contestant.kind->name(), contestant.name()));
  }
  for (const Precision scalar : request.scalars) scalars.push_back(to_string(scalar));
  record::Facts notes = {{std::string(work), request.resume ? "resumed" : "whole"}};
  for (auto& fact : record::machine_facts()) notes.push_back(std::move(fact));
  record::Facts identity = {{"seed", std::to_string(request.seed)},
                            {"cases", std::to_string(request.cases)},
                            {"narrow", fmt::format("{}", fmt::join(narrow, " "))},
                            {"scalars", fmt::format("{}", fmt::join(scalars, " "))},
                            {"others", fmt::format("{}", fmt::join(contestants, ", "))},
                            std::move(subject),
                            {"time_limit", fmt::format("{}", request.time_limit)},
                            {"program", record::hash_of_program()}};
  if (request.part) {
    append_facts(*request.part, identity);
    notes.insert(notes.end(), request.part->notes.begin(), request.part->notes.end());
  }
  return {.folder = request.out,
          .files = std::move(files),
          .identity = std::move(identity),
          .notes = std::move(notes),
          .start = record::resume_or_overwrite(request.resume),
          .work = std::move(work)};
}

}  // namespace touchstone::check
