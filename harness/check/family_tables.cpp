// Makes tables of the counts of families, and of their axes.
#include "harness/check/family_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
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

// The axes of a kind, from which value to which.
std::vector<std::string> axes_of_kind(const CheckRequest& request, const kinds::Kind& kind) {
  std::vector<std::string> axes;
  for (const kinds::Family* family : request.families) {
    if (family->kind != &kind) continue;
    if (axes.empty() || axes.back() != family->axis) axes.push_back(family->axis);
  }
  return axes;
}

std::string range_of(const CheckRequest& request, const std::string& axis) {
  std::string first, last;
  for (const kinds::Family* family : request.families) {
    if (family->axis != axis) continue;
    if (first.empty()) first = family->value;
    last = family->value;
  }
  return fmt::format("{} ({} to {})", axis, first, last);
}

std::string first_values(const CheckRequest& request, const FamilyCounts& counts,
                         std::uint32_t contestant, const std::string& axis) {
  std::optional<std::string> wrong, given_up;
  bool is_asked = false;
  for (std::uint32_t place = 0; place < request.families.size(); ++place) {
    const kinds::Family& family = *request.families[place];
    const auto at = counts.find({contestant, place, kinds::CaseForm::as_drawn});
    if (family.axis != axis || at == counts.end()) continue;
    is_asked = true;
    if (!wrong && at->second.silent() + at->second.failed > 0) wrong = family.value;
    if (!given_up && at->second.gave_up > 0) given_up = family.value;
  }
  if (!is_asked) return "";
  return wrong.value_or("-") + (given_up ? " / " + *given_up : "");
}

std::optional<base::Table> table_of(const CheckRequest& request, const FamilyCounts& counts,
                                    const kinds::Kind& kind) {
  const std::vector<std::string> axes = axes_of_kind(request, kind);
  std::vector<std::string> header = {"algorithm"};
  for (const std::string& axis : axes) header.push_back(range_of(request, axis));
  base::Table table(header);
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    if (request.contestants[place].kind != &kind) continue;
    std::vector<std::string> row = {request.contestants[place].name()};
    for (const std::string& axis : axes) {
      row.push_back(first_values(request, counts, place, axis));
    }
    const bool is_empty =
        std::all_of(row.begin() + 1, row.end(), [](auto& c) { return c.empty(); });
    if (!is_empty) table.add(std::move(row));
  }
  if (axes.empty() || table.is_empty()) return std::nullopt;
  return table;
}

}  // namespace

std::string family_summary(const CheckReport& report, std::size_t page_width) {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    if (!has_kind(*report.request, *kind)) continue;
    const base::Table table = sums(*report.request, report.tally.families(), *kind);
    if (!table.is_empty()) text += fmt::format("\n{}\n{}", kind->title(), table.text(page_width));
  }
  return text;
}

std::string family_sections(const CheckReport& report) {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    if (!has_kind(*report.request, *kind)) continue;
    text += fmt::format(
        "\n## {}\n\n{} *Other forms*: every fifth case again, swapped, scaled, moved, "
        "with its motion reversed or in two halves, where that is exact.\n\n{}\n",
        kind->title(), kind->legend(),
        sums(*report.request, report.tally.families(), *kind).markdown());
    text += by_family(*report.request, report.tally.families(), *kind);
  }
  return text;
}

std::string axis_tables(const CheckReport& report, std::size_t page_width) {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    const auto table = table_of(*report.request, report.tally.families(), *kind);
    if (table) text += fmt::format("\n{}\n{}", kind->name(), table->text(page_width));
  }
  return text;
}

std::string axis_sections(const CheckReport& report) {
  if (report.request->contestants.empty()) return "";
  std::string text =
      "\n## Bodies that are not convex, rays, points and motion\n\nThe first value with an answer "
      "that is "
      "missed, false or inexact, or with a crash; after a slash the first that the algorithm gave "
      "up. `-`: nowhere on the axis. Lengths are metres, of "
      "bodies of "
      "about a metre; speeds are paths in the step; turns are radians.\n";
  for (const kinds::Kind* kind : kinds::kinds()) {
    const auto table = table_of(*report.request, report.tally.families(), *kind);
    if (table) text += fmt::format("\n`{}`:\n\n{}", kind->name(), table->markdown());
  }
  return text;
}

}  // namespace touchstone::check
