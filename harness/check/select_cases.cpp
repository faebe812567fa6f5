// Selects algorithms, regimes and families.
#include "harness/check/select_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/nearest_name.h"
#include "harness/check/axes/axes.h"
#include "harness/files/cases.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/selection.h"

namespace touchstone::check {
namespace {

std::vector<std::string> names_of(const std::string& list) {
  return list.empty() ? std::vector<std::string>{} : kinds::split_names(list);
}

template <class Field>
void expect_known(std::string_view what, const std::vector<std::string>& asked, Field field) {
  std::vector<std::string> known;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  };
  for (const Regime& regime : regimes()) add(field(regime));
  for (const kinds::Family* family : kinds::case_families()) add(field(*family));
  for (const std::string& name : asked) {
    if (std::ranges::find(known, name) != known.end()) continue;
    throw base::InputError(fmt::format("no {} is called '{}'; expected some of {}", what, name,
                                       fmt::join(known, ", ")));
  }
}

// A kind of algorithms that can be selected.
struct Selectable {
  std::string_view name;
  std::vector<const AlgorithmInfo*> algorithms;

  bool has(std::string_view algorithm) const {
    return std::ranges::any_of(algorithms,
                               [&](const AlgorithmInfo* one) { return one->name == algorithm; });
  }
};

std::vector<Selectable> all_selectable() {
  std::vector<Selectable> all = {
      {kind_words<NarrowPhaseEntry>.word, kinds::infos_of(registry::entries<NarrowPhaseEntry>())},
      {kind_words<BroadPhaseEntry>.word, kinds::infos_of(registry::entries<BroadPhaseEntry>())}};
  for (const kinds::Kind* kind : kinds::kinds()) {
    all.push_back({kind->name(), kind->algorithms()});
  }
  return all;
}

// The kinds that are named, or all. Throws InputError for a name that there is not.
std::vector<Selectable> selected_kinds(const std::string& list) {
  std::vector<Selectable> all = all_selectable(), chosen;
  if (list.empty()) return all;
  for (const std::string& name : kinds::split_names(list)) {
    const auto words = registry::kind_named(name);
    const std::string_view word = words ? words->word : name;
    const auto at = std::ranges::find(all, word, &Selectable::name);
    if (at == all.end()) {
      std::vector<std::string_view> known;
      for (const Selectable& kind : all) known.push_back(kind.name);
      throw base::InputError(base::unknown_name("kind", name, known));
    }
    chosen.push_back(*at);
  }
  return chosen;
}

// What of the list each kind has; nothing where it has nothing. Throws InputError for a name that no kind has.
std::map<std::string_view, std::string> shares_of(const std::string& list,
                                                  const std::vector<Selectable>& selectable) {
  std::map<std::string_view, std::string> shares;
  for (const std::string& name : kinds::split_names(list)) {
    bool is_known = false;
    for (const Selectable& kind : selectable) {
      if (!kinds::is_group(name) && !kind.has(name)) continue;
      is_known = true;
      std::string& share = shares[kind.name];
      share += (share.empty() ? "" : ",") + name;
    }
    if (is_known) continue;
    std::vector<std::string_view> known = {"all", "ours", "libraries", "oracle", "none"};
    for (const Selectable& kind : selectable) {
      for (const AlgorithmInfo* one : kind.algorithms) known.push_back(one->name);
    }
    throw base::InputError(base::unknown_name("algorithm", name, known));
  }
  return shares;
}

// `fallback`: of every kind, if no algorithm and no kind is named.
void select_algorithms(const CaseSelection& selection, const char* fallback,
                       CheckRequest& request) {
  std::map<std::string_view, std::string> shares;
  if (!selection.with.empty() || !selection.kinds.empty()) {
    shares =
        shares_of(selection.with.empty() ? "all" : selection.with, selected_kinds(selection.kinds));
  }
  const bool none_named = selection.is_unsaid();
  const auto named = [&](std::string_view kind, const std::string& list) {
    const auto share = shares.find(kind);
    if (!list.empty()) return share == shares.end() ? list : list + "," + share->second;
    if (share != shares.end()) return share->second;
    return none_named ? std::string(fallback) : std::string("none");
  };
  request.narrow = narrow_phases_to_grade(named("pair", selection.pair), request.scalars);
  request.broad = kinds::select(registry::entries<BroadPhaseEntry>(),
                                kinds::split_names(named("box", selection.box)), "broad phase");
  request.contestants.clear();
  for (const kinds::Kind* kind : kinds::kinds()) {
    const auto at = selection.others.find(kind);
    const std::string list =
        named(kind->name(), at == selection.others.end() ? std::string() : at->second);
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
  for (const kinds::Family* family : kinds::case_families()) {
    if (takes(request, *family) && is_chosen(*family)) request.families.push_back(family);
  }
}

void select_values_of_axes(const std::string& axes, CheckRequest& request) {
  std::string of_pairs;  // axes of narrow phases, and what is known to neither
  const auto wanted = names_of(axes == "all" ? "" : axes);
  for (const std::string& name : wanted) {
    const auto families = kinds::axis_families();
    const auto has_name = [&](const kinds::Family* family) { return family->axis == name; };
    if (std::ranges::any_of(families, has_name)) continue;
    of_pairs += (of_pairs.empty() ? "" : ",") + name;
  }
  request.regimes.clear();
  request.families.clear();
  const bool all = wanted.empty();
  if (!request.narrow.empty() && (all || !of_pairs.empty())) {
    request.regimes = select_axes(of_pairs);
  }
  for (const kinds::Family* family : kinds::axis_families()) {
    const bool is_chosen = all || std::ranges::find(wanted, family->axis) != wanted.end();
    if (is_chosen && takes(request, *family)) request.families.push_back(family);
  }
  if (request.period() == 0) {
    select_axes(of_pairs);  // throws for a name that there is not
    throw base::InputError(
        "no algorithm that is named has cases of these axes; expected at least one");
  }
}

}  // namespace

bool CaseSelection::is_unsaid() const {
  return with.empty() && kinds.empty() && pair.empty() && box.empty() &&
         std::ranges::all_of(others, [](const auto& named) { return named.second.empty(); });
}

std::vector<const NarrowPhaseEntry*> narrow_phases_to_grade(const std::string& names,
                                                            std::span<const Precision> scalars) {
  const std::vector<std::string> list = kinds::split_names(names);
  const auto is_named = [&](const NarrowPhaseEntry* entry) {
    return std::ranges::find(list, entry->info.name) != list.end();
  };
  auto chosen = kinds::select(registry::entries<NarrowPhaseEntry>(), list, "narrow phase");
  std::erase_if(chosen, [&](const NarrowPhaseEntry* entry) {
    return entry->info.origin == Origin::oracle && !is_named(entry);
  });
  for (const NarrowPhaseEntry* entry : chosen) {
    // An algorithm of a group may lack the scalar: it is left out.
    const bool offered =
        std::ranges::any_of(scalars, [&](Precision scalar) { return offers(*entry, scalar); });
    if (!is_named(entry) || offered) continue;
    throw base::InputError(fmt::format("'{}' does not compute in {}; expected another --scalar",
                                       entry->info.name, to_string(scalars.front())));
  }
  return chosen;
}

void select_cases(CaseSelection selection, const std::string& axes, CheckRequest& request) {
  const bool unsaid = selection.is_unsaid();
  const bool counts = request.mode == CheckMode::count;
  if (unsaid && counts) selection.pair = "certified";
  select_algorithms(selection, counts ? "none" : "all", request);
  if (request.mode == CheckMode::axes) {
    if (unsaid) request.broad.clear();
    select_values_of_axes(axes, request);
    return;
  }
  select_regimes_and_families(selection, request);
  const bool some_named = !selection.regimes.empty() || !selection.groups.empty();
  if (some_named && request.period() == 0) {
    throw base::InputError(
        "no algorithm that is named takes cases of these regimes; expected algorithms of another "
        "kind");
  }
  if (counts && request.period() == 0) {
    throw base::InputError(
        "--count has no cases for these algorithms; expected some of another kind than box");
  }
}

namespace {

// A regime draws by a plain function, so its cases are here.
std::vector<files::Case>& cases_of_file() {
  static std::vector<files::Case> cases;
  return cases;
}

RegimeCase case_of_file(RegimeDraw& draw) {
  const files::Case& c = cases_of_file()[draw.index];
  return {.pair = c, .detail = c.id};
}

}  // namespace

void take_case_file(const std::filesystem::path& file, CheckRequest& request) {
  static Regime regime;
  regime.name = file.stem().string();
  regime.group = "file";
  regime.what = "pairs of a file";
  regime.extreme = true;
  regime.draw = case_of_file;
  cases_of_file() = files::read_cases(file);
  if (cases_of_file().empty())
    throw base::InputError(file.string(), 0, "has no case; expected one");
  if (request.narrow.empty()) {
    throw base::InputError("FILE has pairs; expected an algorithm of the kind pair");
  }
  request.regimes = {&regime};
  request.families.clear();
  request.contestants.clear();
  request.broad.clear();
  request.cases = static_cast<int>(cases_of_file().size());
}

}  // namespace touchstone::check
