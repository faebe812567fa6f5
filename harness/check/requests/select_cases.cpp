// Selects algorithms, regimes and families.
#include "harness/check/requests/select_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/campaign/selection.h"
#include "harness/check/requests/select_narrow.h"

namespace touchstone::check {
namespace {

std::vector<std::string> names_of(const std::string& list) {
  return list.empty() ? std::vector<std::string>{} : campaign::split_names(list);
}

template <class Field>
void expect_known(std::string_view what, const std::vector<std::string>& asked, Field field) {
  std::vector<std::string> known;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  };
  for (const Regime& regime : regimes()) add(field(regime));
  for (const CaseFamily& family : case_families()) add(field(family));
  for (const std::string& name : asked) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw base::InputError(fmt::format("no {} is called '{}'; expected some of {}", what, name,
                                       fmt::join(known, ", ")));
  }
}

void select_algorithms(const CaseSelection& selection, const char* fallback,
                       CheckRequest& request) {
  const bool none_named = selection.is_unsaid();
  const auto named = [&](const std::string& list) {
    return !list.empty() ? list : none_named ? std::string(fallback) : std::string("none");
  };
  request.narrow = narrow_phases_to_grade(named(selection.narrow), request.scalars);
  request.broad = campaign::select(registry::entries<BroadPhaseEntry>(),
                                   campaign::split_names(named(selection.broad)), "broad phase");
  request.contestants.clear();
  for (const CaseKind kind : all_case_kinds) {
    const std::string list = named(selection.others[static_cast<std::size_t>(kind)]);
    for (Contestant& one : contestants(kind, campaign::split_names(list), request.scalars)) {
      request.contestants.push_back(std::move(one));
    }
  }
}

bool takes(const CheckRequest& request, const CaseFamily& family) {
  return std::ranges::any_of(request.contestants, [&](const Contestant& contestant) {
    return contestant.kind() == family.kind;
  });
}

void select_regimes_and_families(const CaseSelection& selection, CheckRequest& request) {
  const auto wanted = names_of(selection.regimes), groups = names_of(selection.groups);
  expect_known("regime", wanted, [](const auto& one) { return one.name; });
  expect_known("group of regimes", groups, [](const auto& one) { return one.group; });
  const bool all = wanted.empty() && groups.empty();
  const auto is_chosen = [&](const auto& one) {
    return all || std::ranges::find(wanted, one.name) != wanted.end() ||
           std::ranges::find(groups, one.group) != groups.end();
  };
  request.regimes.clear();
  request.families.clear();
  for (const Regime& regime : regimes()) {
    if (is_chosen(regime)) request.regimes.push_back(&regime);
  }
  for (const CaseFamily& family : case_families()) {
    if (takes(request, family) && is_chosen(family)) request.families.push_back(&family);
  }
}

}  // namespace

bool CaseSelection::is_unsaid() const {
  return narrow.empty() && broad.empty() && std::ranges::all_of(others, &std::string::empty);
}

void select_cases(const CaseSelection& selection, const char* fallback, CheckRequest& request) {
  select_algorithms(selection, fallback, request);
  select_regimes_and_families(selection, request);
  const bool some_named = !selection.regimes.empty() || !selection.groups.empty();
  if (some_named && request.period() == 0) {
    throw base::InputError(
        "no algorithm that is named takes cases of these regimes; expected names of another kind, "
        "such as --narrow, --concave, --rays, --points, --cast, --ccd or --scene-rays");
  }
}

void select_axes_and_algorithms(const CaseSelection& selection, const std::string& axes,
                                StressRequest& request) {
  select_algorithms(selection, "all", request);
  request.broad.clear();
  std::string of_pairs;  // axes of narrow phases, and what is known to neither
  const auto wanted = names_of(axes);
  for (const std::string& name : wanted) {
    const auto families = axis_families();
    if (std::ranges::find(families, name, &CaseFamily::axis) != families.end()) continue;
    of_pairs += (of_pairs.empty() ? "" : ",") + name;
  }
  request.cells.clear();
  request.families.clear();
  const bool all = wanted.empty();
  if (!request.narrow.empty() && (all || !of_pairs.empty())) {
    request.cells = cells_of(select_axes(of_pairs));
  }
  for (const CaseFamily& family : axis_families()) {
    const bool is_chosen = all || std::ranges::find(wanted, family.axis) != wanted.end();
    if (is_chosen && takes(request, family)) request.families.push_back(&family);
  }
  if (request.job_count() == 0) {
    select_axes(of_pairs);  // throws for a name that there is not
    throw base::InputError(
        "no algorithm that is named has cases of these axes; expected at least one");
  }
}

}  // namespace touchstone::check
