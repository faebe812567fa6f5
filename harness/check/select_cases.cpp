// Selects algorithms and families.
#include "harness/check/select_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/group_words.h"
#include "harness/base/nearest_name.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/selection.h"
#include "harness/modules/file_word.h"

namespace touchstone::check {
namespace {

std::vector<std::string> names_of(const std::string& list) {
  return list.empty() ? std::vector<std::string>{} : kinds::split_names(list);
}

// Throws InputError for a name that is not among those that `field` gives of the families.
template <class Field>
void expect_known(std::string_view what, const std::vector<std::string>& asked,
                  const std::vector<const kinds::Family*>& families, Field field) {
  std::vector<std::string> known;
  for (const kinds::Family* family : families) {
    if (std::ranges::find(known, family->*field) == known.end()) known.push_back(family->*field);
  }
  for (const std::string& name : asked) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw base::InputError(fmt::format("no {} is called '{}'; expected some of {}", what, name,
                                       fmt::join(known, ", ")));
  }
}

// The kinds that are named, or all. Throws InputError for a name that there is not.
std::vector<const kinds::Kind*> selected_kinds(const std::string& list) {
  const auto all = kinds::checked_kinds();
  if (list.empty()) return {all.begin(), all.end()};
  std::vector<const kinds::Kind*> chosen;
  for (const std::string& name : kinds::split_names(list)) {
    const auto words = registry::kind_named(name);
    const auto at = std::ranges::find(all, words ? words->word : name, &kinds::Kind::name);
    if (at == all.end()) {
      std::vector<std::string_view> known;
      for (const kinds::Kind* kind : all) known.push_back(kind->name());
      throw base::InputError(base::unknown_name("kind", name, known));
    }
    chosen.push_back(*at);
  }
  return chosen;
}

// What of the list each kind has; nothing where it has nothing. Throws InputError for a name that no kind has.
std::map<const kinds::Kind*, std::string> shares_of(
    const std::string& list, const std::vector<const kinds::Kind*>& selectable) {
  std::map<const kinds::Kind*, std::string> shares;
  for (const std::string& name : kinds::split_names(list)) {
    std::vector<std::string_view> known(base::group_words.begin(), base::group_words.end());
    const std::string file = modules::is_file(name) ? modules::file_of(name) : "";
    bool is_known = false;
    for (const kinds::Kind* kind : selectable) {
      bool has_name = base::is_group_word(name);
      for (const AlgorithmInfo* one : kind->algorithms()) {
        known.push_back(one->name);
        has_name =
            has_name || (file.empty() ? one->name == name : registry::module_of(*one) == file);
      }
      if (!has_name) continue;
      is_known = true;
      std::string& share = shares[kind];
      share += (share.empty() ? "" : ",") + name;
    }
    if (!is_known) throw base::InputError(base::unknown_name("algorithm", name, known));
  }
  return shares;
}

void select_algorithms(const CaseSelection& selection, CheckRequest& request) {
  std::map<const kinds::Kind*, std::string> shares;
  if (!selection.with.empty() || !selection.kinds.empty()) {
    shares =
        shares_of(selection.with.empty() ? "all" : selection.with, selected_kinds(selection.kinds));
  }
  request.contestants.clear();
  for (const kinds::Kind* kind : kinds::checked_kinds()) {
    std::string list = shares[kind];
    const auto named = selection.of_one.find(kind);
    if (named != selection.of_one.end() && !named->second.empty()) {
      list = list.empty() ? named->second : named->second + "," + list;
    }
    if (list.empty() && selection.is_unsaid()) {
      list = request.mode == CheckMode::count ? kind->counted() : "all";
    }
    if (list.empty()) continue;
    for (kinds::Contestant& one : kind->contestants(kinds::split_names(list), request.scalars)) {
      request.contestants.push_back(std::move(one));
    }
  }
}

bool takes(const CheckRequest& request, const kinds::Family& family) {
  return std::ranges::any_of(request.contestants, [&](const kinds::Contestant& contestant) {
    return contestant.kind == family.kind;
  });
}

void select_by_name(const CaseSelection& selection, CheckRequest& request) {
  const auto wanted = names_of(selection.regimes), groups = names_of(selection.groups);
  const auto families = kinds::case_families();
  expect_known("regime", wanted, families, &kinds::Family::name);
  expect_known("group of regimes", groups, families, &kinds::Family::group);
  const bool all = wanted.empty() && groups.empty();
  for (const kinds::Family* one : families) {
    const bool is_chosen = all || std::ranges::find(wanted, one->name) != wanted.end() ||
                           std::ranges::find(groups, one->group) != groups.end();
    if (is_chosen && takes(request, *one)) request.families.push_back(one);
  }
  if (!all && request.period() == 0) {
    throw base::InputError(
        "no algorithm that is named takes cases of these regimes; expected algorithms of another "
        "kind");
  }
  if (request.mode == CheckMode::count && request.period() == 0) {
    throw base::InputError(
        "--count has no cases for these algorithms; expected some of another kind than box");
  }
}

void select_values_of_axes(const std::string& axes, CheckRequest& request) {
  const auto wanted = names_of(axes == "all" ? "" : axes);
  const auto families = kinds::axis_families();
  expect_known("axis", wanted, families, &kinds::Family::axis);
  for (const kinds::Family* one : families) {
    const bool is_chosen = wanted.empty() || std::ranges::find(wanted, one->axis) != wanted.end();
    if (is_chosen && takes(request, *one)) request.families.push_back(one);
  }
  if (request.period() == 0) {
    throw base::InputError(
        "no algorithm that is named has cases of these axes; expected at least one");
  }
}

}  // namespace

bool CaseSelection::is_unsaid() const {
  return with.empty() && kinds.empty() &&
         std::ranges::all_of(of_one, [](const auto& named) { return named.second.empty(); });
}

void select_cases(const CaseSelection& selection, const std::string& axes, CheckRequest& request) {
  select_algorithms(selection, request);
  request.families.clear();
  if (request.mode != CheckMode::axes) return select_by_name(selection, request);
  // Boxes have no axes: they are left out, unless they are named.
  if (selection.is_unsaid())
    std::erase_if(request.contestants,
                  [](const kinds::Contestant& one) { return one.kind->families().empty(); });
  select_values_of_axes(axes, request);
}

}  // namespace touchstone::check
