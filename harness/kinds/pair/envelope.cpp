// Finds the first failures along each axis, and writes them as tables.
#include "harness/kinds/pair/envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/grade/graded_answer.h"

namespace touchstone::kinds {
namespace {

std::string name_at(const Axis& axis, const std::optional<std::size_t>& place) {
  return place ? axis.values[*place].name : "";
}

// Returns the first value with a wrong answer, such as "1e-6" or "1e-6 crashes". The text names a
// crash, a hang and an error that the conversion of the input caused.
std::string first_wrong(const Reach& reach, bool side_only) {
  using Place = std::optional<std::size_t>;
  const auto first = [&](grade::AnswerClass outcome) { return reach.first_of(outcome); };
  const std::array<std::pair<Place, const char*>, 4> all = {
      {{side_only ? reach.first_side : first(grade::AnswerClass::silent), ""},
       {side_only ? Place() : first(grade::AnswerClass::rounded), " (input)"},
       {first(grade::AnswerClass::crashed), " crashes"},
       {first(grade::AnswerClass::hung), " hangs"}}};
  const std::pair<Place, const char*>* found = nullptr;
  for (const auto& one : all) {
    if (one.first && (found == nullptr || *one.first < *found->first)) found = &one;
  }
  return found == nullptr ? "-" : name_at(*reach.axis, found->first) + found->second;
}

std::string first_honest(const Reach& reach) {
  const std::optional<std::size_t> place = reach.first_of(grade::AnswerClass::honest);
  return place ? name_at(*reach.axis, place) : "-";
}

}  // namespace

std::vector<Reach> envelope(const PairRequest& request, std::span<const AxisCount> rows) {
  std::vector<Reach> reaches;
  const std::vector<const Axis*> axes = request.axes();
  for (const auto& [entry, scalar] : request.algorithms) {
    for (const Axis* axis : axes) {
      Reach reach;
      reach.entry = entry;
      reach.scalar = scalar;
      reach.axis = axis;
      for (const AxisCount& row : rows) {
        const Regime& regime = *request.regimes[row.regime];
        if (row.entry != entry || row.scalar != scalar || regime.axis != axis) continue;
        reach.answers += row.answers();
        reach.skipped += row.skipped;
        grade::keep_greater(reach.margin, row.margin);
        grade::keep_greater(reach.error, row.error);
        if (!std::isnan(row.margin) && (!reach.first_side || regime.place < *reach.first_side)) {
          reach.first_side = regime.place;
        }
        for (const grade::AnswerClass outcome : grade::all_answer_classes) {
          const auto i = static_cast<std::size_t>(outcome);
          reach.counts[i] += row.counts[i];
          if (row.counts[i] == 0 || outcome == grade::AnswerClass::right) continue;
          if (!reach.first[i] || regime.place < *reach.first[i]) reach.first[i] = regime.place;
        }
      }
      if (reach.answers > 0) reaches.push_back(reach);
    }
  }
  return reaches;
}

// A row of envelope.csv.
template <record::row_of<Reach> Row, class Visit>
void columns(Row& row, Visit visit, const PairRequest& request) {
  const auto value = [&](const auto& place) {
    return record::derived([&row, &place] { return name_at(*row.axis, place); });
  };
  visit("algorithm", record::derived([&] { return request.narrow[row.entry]->info.name; }),
        "The narrow phase.");
  visit("origin", record::derived([&] { return request.narrow[row.entry]->info.origin; }),
        "Origin of the algorithm.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("axis", record::derived([&] { return row.axis->name; }), "The axis.");
  visit("unit", record::derived([&] { return row.axis->unit; }), "Unit of its values.");
  visit("from", record::derived([&] { return row.axis->values.front().name; }), "Its mild end.");
  visit("to", record::derived([&] { return row.axis->values.back().name; }), "Its extreme end.");
  visit("answers", row.answers, "Answers that were asked for and graded.");
  for (const grade::AnswerClass one : grade::all_answer_classes) {
    visit(to_string(one), row.counts[static_cast<std::size_t>(one)], "Answers of this class.");
  }
  visit("skipped", row.skipped, "Queries that were not asked, after too many crashes and hangs.");
  for (const grade::AnswerClass one : grade::all_answer_classes) {
    if (one == grade::AnswerClass::right) continue;
    visit("first_" + std::string(to_string(one)), value(row.first[static_cast<std::size_t>(one)]),
          "First value with an answer of this class; empty where there is none.");
  }
  visit("first_wrong_side", value(row.first_side),
        "First value with a silent answer on the wrong side of contact.");
  visit("worst_margin", row.margin,
        "Greatest exact distance or depth that was called wrongly, part of the scale.");
  visit("worst_error", row.error, "Greatest error of a number, part of the scale.");
}

void write_envelope(const PairRequest& request, std::span<const AxisCount> rows,
                    const std::filesystem::path& file) {
  record::write_rows(file, envelope(request, rows), request);
}

base::Table table(const PairRequest& request, std::span<const Reach> reaches, EnvelopeTable which) {
  const std::vector<const Axis*> axes = request.axes();
  std::vector<std::string> header = {"algorithm"};
  for (const Axis* axis : axes) header.push_back(axis->name);
  base::Table table(header);
  for (auto reach = reaches.begin(); reach != reaches.end();) {
    const Reach& first = *reach;
    std::vector<std::string> row(header.size());
    row[0] = request.name({first.entry, first.scalar});
    for (; reach != reaches.end() && reach->entry == first.entry && reach->scalar == first.scalar;
         ++reach) {
      const auto axis =
          static_cast<std::size_t>(std::ranges::find(axes, reach->axis) - axes.begin());
      row[axis + 1] = which == EnvelopeTable::honest
                          ? first_honest(*reach)
                          : first_wrong(*reach, which == EnvelopeTable::side);
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace touchstone::kinds
