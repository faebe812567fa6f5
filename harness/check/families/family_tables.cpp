// Makes tables of the counts of families.
#include "harness/check/families/family_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "harness/base/table.h"

namespace touchstone::check {
namespace {

std::string number(std::int64_t n) { return std::to_string(n); }

bool has_kind(const CheckRequest& request, const kinds::Kind& kind) {
  return std::ranges::any_of(request.contestants,
                             [&](const kinds::Contestant& one) { return one.kind == &kind; });
}

// A row for each contestant of the kind, over all families: as drawn, then what other forms add.
base::Table sums(const CheckRequest& request, const FamilyCounts& counts, const kinds::Kind& kind) {
  base::Table table({"algorithm", "cases", "contacts", "unresolved", "right", "near", "missed",
                     "false", "inexact", "bound", "gave up", "failed", "other forms",
                     "wrong in these"});
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    if (request.contestants[place].kind != &kind) continue;
    FamilyCount drawn, others;
    for (const auto& [key, count] : counts) {
      if (key.contestant == place)
        (key.form == kinds::CaseForm::as_drawn ? drawn : others).add(count);
    }
    if (drawn.cases == 0) continue;
    table.add({request.contestants[place].name(), number(drawn.cases), number(drawn.contacts),
               number(drawn.unresolved), number(drawn.right), number(drawn.near),
               number(drawn.missed), number(drawn.false_hits), number(drawn.inexact),
               number(drawn.bound), number(drawn.gave_up), number(drawn.failed),
               number(others.cases), number(others.silent() + others.failed)});
  }
  return table;
}

// "missed + false + inexact" of a cell, or what is less.
std::string cell(const FamilyCount& count) {
  std::string text =
      count.silent() == 0 ? "0" : fmt::format("{}+{}", count.missed, count.false_hits);
  if (count.inexact > 0) text += fmt::format("+{}", count.inexact);
  if (count.failed > 0) text += fmt::format(" ({} failed)", count.failed);
  return text;
}

// A row for each family, and a column for each contestant that is wrong in any.
std::string by_family(const CheckRequest& request, const FamilyCounts& counts,
                      const kinds::Kind& kind) {
  std::vector<std::uint32_t> wrong, right;
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    if (request.contestants[place].kind != &kind) continue;
    FamilyCount sum;
    for (const auto& [key, count] : counts) {
      if (key.contestant == place && key.form == kinds::CaseForm::as_drawn) sum.add(count);
    }
    if (sum.cases == 0) continue;
    (sum.silent() + sum.failed > 0 ? wrong : right).push_back(place);
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
    if (request.families[family]->kind != &kind) continue;
    std::int64_t cases = 0;
    std::vector<std::string> row = {request.families[family]->name, ""};
    for (const std::uint32_t place : wrong) {
      const auto at = counts.find({place, family, kinds::CaseForm::as_drawn});
      row.push_back(at == counts.end() ? "" : cell(at->second));
      if (at != counts.end()) cases = std::max(cases, at->second.cases);
    }
    row[1] = number(cases);
    table.add(std::move(row));
  }
  return text + "Missed + false + inexact, as drawn:\n\n" + table.markdown();
}

}  // namespace

std::string family_summary(const CheckRequest& request, const FamilyCounts& counts,
                           std::size_t page_width) {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    if (!has_kind(request, *kind)) continue;
    const base::Table table = sums(request, counts, *kind);
    if (!table.is_empty()) text += fmt::format("\n{}\n{}", kind->title(), table.text(page_width));
  }
  return text;
}

std::string family_sections(const CheckRequest& request, const FamilyCounts& counts) {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    if (!has_kind(request, *kind)) continue;
    text += fmt::format(
        "\n## {}\n\n{} *Other forms*: every fifth case again, swapped, scaled, moved, "
        "with its motion reversed or in two halves, where that is exact.\n\n{}\n",
        kind->title(), kind->legend(), sums(request, counts, *kind).markdown());
    text += by_family(request, counts, *kind);
  }
  return text;
}

}  // namespace touchstone::check
