// Makes tables of the counts of families.
#include "harness/check/kinds/family_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "harness/base/table.h"

namespace touchstone::check {
namespace {

std::string number(std::int64_t n) { return std::to_string(n); }

bool has_kind(const CheckRequest& request, CaseKind kind) {
  return std::ranges::any_of(request.contestants,
                             [&](const Contestant& one) { return one.kind() == kind; });
}

// A row for each contestant of the kind, over all families: as drawn, then what other forms add.
base::Table sums(const CheckRequest& request, const FamilyCounts& counts, CaseKind kind) {
  base::Table table({"algorithm", "cases", "contacts", "unresolved", "right", "near", "missed",
                     "false hits", "otherwise wrong", "honest", "lost", "other forms",
                     "wrong in these"});
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    if (request.contestants[place].kind() != kind) continue;
    FamilyCount drawn, others;
    for (const auto& [key, count] : counts) {
      if (key.contestant == place) (key.form == CaseForm::as_drawn ? drawn : others).add(count);
    }
    if (drawn.cases == 0) continue;
    table.add({request.contestants[place].name(), number(drawn.cases), number(drawn.contacts),
               number(drawn.unresolved), number(drawn.right), number(drawn.near),
               number(drawn.missed), number(drawn.false_hits), number(drawn.wrong),
               number(drawn.honest), number(drawn.lost), number(others.cases),
               number(others.silent() + others.lost)});
  }
  return table;
}

// "missed + false hits + otherwise wrong" of a cell, or what is less.
std::string cell(const FamilyCount& count) {
  std::string text =
      count.silent() == 0 ? "0" : fmt::format("{}+{}", count.missed, count.false_hits);
  if (count.wrong > 0) text += fmt::format("+{}", count.wrong);
  if (count.lost > 0) text += fmt::format(" ({} lost)", count.lost);
  return text;
}

// A row for each family, and a column for each contestant that is wrong in any.
std::string by_family(const CheckRequest& request, const FamilyCounts& counts, CaseKind kind) {
  std::vector<std::uint32_t> wrong, right;
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    if (request.contestants[place].kind() != kind) continue;
    FamilyCount sum;
    for (const auto& [key, count] : counts) {
      if (key.contestant == place && key.form == CaseForm::as_drawn) sum.add(count);
    }
    if (sum.cases == 0) continue;
    (sum.silent() + sum.lost > 0 ? wrong : right).push_back(place);
  }
  std::string text;
  if (!right.empty()) {
    text = "Never wrong: ";
    for (const std::uint32_t place : right) {
      if (place != right.front()) text += ", ";
      text += request.contestants[place].name();
    }
    text += ".\n\n";
  }
  if (wrong.empty()) return text;
  std::vector<std::string> header = {"family", "cases"};
  for (const std::uint32_t place : wrong) header.push_back(request.contestants[place].name());
  base::Table table(header);
  for (std::uint32_t family = 0; family < request.families.size(); ++family) {
    if (request.families[family]->kind != kind) continue;
    std::int64_t cases = 0;
    std::vector<std::string> row = {request.families[family]->name, ""};
    for (const std::uint32_t place : wrong) {
      const auto at = counts.find({place, family, CaseForm::as_drawn});
      row.push_back(at == counts.end() ? "" : cell(at->second));
      if (at != counts.end()) cases = std::max(cases, at->second.cases);
    }
    row[1] = number(cases);
    table.add(std::move(row));
  }
  return text + "Missed + false hits + otherwise wrong, as drawn:\n\n" + table.markdown();
}

std::string_view title(CaseKind kind) {
  switch (kind) {
    case CaseKind::concave: return "Bodies that need not be convex";
    case CaseKind::rays: return "Rays";
    case CaseKind::points: return "Points";
    case CaseKind::cast: return "Moving bodies";
    case CaseKind::ccd: return "Continuous collision of features";
    case CaseKind::scene_rays: break;
  }
  return "Rays at scenes";
}

std::string_view key_of(CaseKind kind) {
  switch (kind) {
    case CaseKind::concave:
      return "A contact is a shared point. *Otherwise wrong*: another list of pairs, or a distance "
             "that "
             "is off by more than 1e-11 of the size (float: 1e-5).";
    case CaseKind::rays:
      return "A contact is a hit. *Otherwise wrong*: another triangle (of those that promise it), "
             "or a "
             "length that is off by more than 1e-9 (float: 1e-4).";
    case CaseKind::points:
      return "A contact is a point inside or on the surface. *Otherwise wrong*: inside for on the "
             "surface, or a distance that is off by more than 1e-14 of the size.";
    case CaseKind::cast:
      return "The tolerance is 1e-9 of the size (float: 1e-4); *near* is a hit where the bodies "
             "come "
             "within it. *Otherwise wrong*: a time of impact that is late, or so early that the "
             "bodies "
             "are further apart than the tolerance, or a bound that does not hold.";
    case CaseKind::ccd:
      return "The tolerance is 1e-6 of the size, or less; *near* is a hit where the features come "
             "within it. "
             "*Otherwise wrong*: a time of impact that is late, or a bound that does not hold.";
    case CaseKind::scene_rays: break;
  }
  return "A contact is a hit. *Near*: what is right if convex parts are larger or smaller by some "
         "units of the last place of their size and distance. *Otherwise wrong*: a body that the "
         "ray "
         "does not meet, and for `closest` another one than the first, or a length that is off by "
         "more than 1e-9.";
}

}  // namespace

std::string family_summary(const CheckRequest& request, const FamilyCounts& counts,
                           std::size_t page_width) {
  std::string text;
  for (const CaseKind kind : all_case_kinds) {
    if (!has_kind(request, kind)) continue;
    const base::Table table = sums(request, counts, kind);
    if (!table.is_empty()) text += fmt::format("\n{}\n{}", title(kind), table.text(page_width));
  }
  return text;
}

std::string family_sections(const CheckRequest& request, const FamilyCounts& counts) {
  std::string text;
  for (const CaseKind kind : all_case_kinds) {
    if (!has_kind(request, kind)) continue;
    text += fmt::format(
        "\n## {}\n\n{} *Other forms*: every fifth case again, swapped, scaled, moved, "
        "with its motion reversed or in two halves, where that is exact.\n\n{}\n",
        title(kind), key_of(kind), sums(request, counts, kind).markdown());
    text += by_family(request, counts, kind);
  }
  return text;
}

}  // namespace touchstone::check
