// Makes tables of axes.
#include "harness/check/families/axis_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "harness/base/table.h"

namespace touchstone::check {
namespace {

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

std::string axis_tables(const CheckRequest& request, const FamilyCounts& counts,
                        std::size_t page_width) {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    const auto table = table_of(request, counts, *kind);
    if (table) text += fmt::format("\n{}\n{}", kind->name(), table->text(page_width));
  }
  return text;
}

std::string axis_sections(const CheckRequest& request, const FamilyCounts& counts) {
  if (request.contestants.empty()) return "";
  std::string text =
      "\n## Bodies that are not convex, rays, points and motion\n\nThe first value with an answer "
      "that is "
      "missed, false or inexact, or with a crash; after a slash the first that the algorithm gave "
      "up. `-`: nowhere on the axis. Lengths are metres, of "
      "bodies of "
      "about a metre; speeds are paths in the step; turns are radians.\n";
  for (const kinds::Kind* kind : kinds::kinds()) {
    const auto table = table_of(request, counts, *kind);
    if (table) text += fmt::format("\n`{}`:\n\n{}", kind->name(), table->markdown());
  }
  return text;
}

}  // namespace touchstone::check
