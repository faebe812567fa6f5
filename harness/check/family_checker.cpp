// Asks the batches of families, and makes tables of the counts and of their axes.
#include "harness/check/family_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "harness/base/table.h"
#include "harness/grade/failures/shrunk_failure.h"

namespace touchstone::check {
namespace {

// The cases of a family in a round: as many as the request says, or fewer.
kinds::BatchRange cases_of_round(const CheckRequest& request, const kinds::Family& family,
                                 std::uint64_t round) {
  const auto cases = request.mode == CheckMode::count
                         ? static_cast<std::size_t>(kinds::cases_of_a_count_job)
                         : static_cast<std::size_t>(std::max(request.cases / family.one_in, 1));
  return {request.seed, round * cases, cases};
}

// Asks all contestants for all cases, of the mode `cases` in every form. A contestant that takes none
// has no count.
std::vector<FamilyCount> counts_of_family(const CheckRequest& request, std::uint32_t family,
                                          std::uint64_t round) {
  constexpr std::span<const kinds::CaseForm> all_forms = kinds::all_case_forms;
  const auto forms = request.mode == CheckMode::cases ? all_forms : all_forms.first(1);
  std::vector<FamilyCount> counts;
  const kinds::Family& of = *request.families[family];
  const kinds::BatchRange range = cases_of_round(request, of, round);
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

std::string first_value(const CheckRequest& request, const FamilyCounts& counts,
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

// A row for each contestant of the kind, and a column for each axis.
base::Table first_values(const CheckRequest& request, const FamilyCounts& counts,
                         const kinds::Kind& kind) {
  const std::vector<std::string> axes = axes_of_kind(request, kind);
  std::vector<std::string> header = {"algorithm"};
  for (const std::string& axis : axes) header.push_back(range_of(request, axis));
  base::Table table(header);
  for (std::uint32_t place = 0; place < request.contestants.size(); ++place) {
    if (request.contestants[place].kind != &kind) continue;
    std::vector<std::string> row = {request.contestants[place].name()};
    for (const std::string& axis : axes) {
      row.push_back(first_value(request, counts, place, axis));
    }
    const bool is_empty =
        std::all_of(row.begin() + 1, row.end(), [](auto& c) { return c.empty(); });
    if (!is_empty) table.add(std::move(row));
  }
  return table;
}

}  // namespace

kinds::JobRows<FamilyCount> FamilyChecker::rows_of_job(std::uint32_t family, std::uint64_t round) {
  kinds::JobRows<FamilyCount> rows;
  rows.of<FamilyCount>() = counts_of_family(request_, family, round);
  return rows;
}

void FamilyChecker::add(const FamilyCount& count) {
  FamilyCount& sum = counts_[{count.contestant, count.family, count.form}];
  sum.family = count.family;
  sum.contestant = count.contestant;
  sum.form = count.form;
  sum.add(count);
}

void FamilyChecker::finish() {
  record::OwnFiles own(request_.out);
  for (const auto& [key, count] : counts_) {
    if (count.first_wrong < 0) continue;
    const kinds::Contestant& contestant = request_.contestants[key.contestant];
    if (!contestant.promised && key.form != kinds::CaseForm::as_drawn) continue;
    const kinds::Family& family = *request_.families[key.family];
    std::string name = fmt::format("{}-{}-{}", family.kind->name(), contestant.name(), family.name);
    if (key.form != kinds::CaseForm::as_drawn) name += "-" + std::string(to_string(key.form));
    std::ranges::replace(name, ' ', '-');
    const std::filesystem::path case_stem = own.free_stem(grade::failures_folder, name);
    const auto first = static_cast<std::uint64_t>(count.first_wrong);
    const auto batch = family.kind->draw(family, {request_.seed, first, 1});
    failures_.push_back({count, batch->write(contestant, 0, case_stem)});
    own.note_stem(case_stem);
  }
}

std::vector<std::string> FamilyChecker::ours_wrong() const {
  std::vector<std::string> lines;
  for (const auto& [count, command] : failures_) {
    const kinds::Contestant& contestant = request_.contestants[count.contestant];
    if (!contestant.promised) continue;
    lines.push_back(fmt::format(
        "{} on {}, {}: of {} cases {} missed, {} false, {} inexact, {} failed; first case {}: {}",
        contestant.name(), request_.families[count.family]->name, to_string(count.form),
        count.cases, count.missed, count.false_hits, count.inexact, count.failed, count.first_wrong,
        command));
  }
  return lines;
}

std::string FamilyChecker::text(std::size_t page_width) const {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    if (!has_kind(request_, *kind)) continue;
    const bool has_axes = request_.mode == CheckMode::axes;
    const base::Table table =
        has_axes ? first_values(request_, counts_, *kind) : sums(request_, counts_, *kind);
    if (table.is_empty()) continue;
    if (has_axes && text.empty()) {
      text =
          "\nOf bodies that are not convex, rays, points and motion, the first value with an "
          "answer "
          "that is missed, false or inexact, or with a query that failed; after a slash the first "
          "that was given up:\n";
    }
    text +=
        fmt::format("\n{}\n{}", has_axes ? kind->name() : kind->title(), table.text(page_width));
  }
  return text;
}

std::string FamilyChecker::page(const std::string& /*pictures*/) const {
  std::string text;
  for (const kinds::Kind* kind : kinds::kinds()) {
    if (!has_kind(request_, *kind)) continue;
    if (request_.mode != CheckMode::axes) {
      text += fmt::format(
          "\n## {}\n\n{} *Other forms*: every fifth case again, swapped, scaled, moved, "
          "with its motion reversed or in two halves, where that is exact.\n\n{}\n",
          kind->title(), kind->legend(), sums(request_, counts_, *kind).markdown());
      text += by_family(request_, counts_, *kind);
      continue;
    }
    const base::Table table = first_values(request_, counts_, *kind);
    if (table.is_empty()) continue;
    if (text.empty()) {
      text =
          "\n## Bodies that are not convex, rays, points and motion\n\nThe first value with an "
          "answer "
          "that is missed, false or inexact, or with a crash; after a slash the first that the "
          "algorithm gave up. `-`: nowhere on the axis. Lengths are metres, of bodies of about a "
          "metre; speeds are paths in the step; turns are radians.\n";
    }
    text += fmt::format("\n`{}`:\n\n{}", kind->name(), table.markdown());
  }
  return text;
}

}  // namespace touchstone::check
