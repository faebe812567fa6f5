// Finds the first failures along each axis, and writes them as tables.
#include "harness/check/axes/envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/grade/answer_count.h"

namespace touchstone::check {
namespace {

std::string name_at(const StressAxis& axis, const std::optional<std::size_t>& place) {
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

std::vector<const StressAxis*> axes_of(const StressRequest& request) {
  std::vector<const StressAxis*> list;
  for (const StressCell& cell : request.cells) {
    if (list.empty() || list.back() != cell.axis) list.push_back(cell.axis);
  }
  return list;
}

std::vector<Reach> envelope(const StressRequest& request, std::span<const StressRow> rows) {
  std::vector<Reach> reaches;
  const std::vector<const StressAxis*> axes = axes_of(request);
  for (std::uint32_t entry = 0; entry < request.narrow.size(); ++entry) {
    for (const Precision scalar : request.scalars) {
      for (const StressAxis* axis : axes) {
        Reach reach;
        reach.entry = entry;
        reach.scalar = scalar;
        reach.axis = axis;
        for (const StressRow& row : rows) {
          const StressCell& cell = request.cells[row.cell];
          if (row.entry != entry || row.scalar != scalar || cell.axis != axis) continue;
          reach.answers += row.answers();
          reach.skipped += row.skipped;
          grade::keep_greater(reach.margin, row.margin);
          grade::keep_greater(reach.error, row.error);
          if (!std::isnan(row.margin) && (!reach.first_side || cell.place < *reach.first_side)) {
            reach.first_side = cell.place;
          }
          for (const grade::AnswerClass outcome : grade::all_answer_classes) {
            const auto i = static_cast<std::size_t>(outcome);
            reach.counts[i] += row.counts[i];
            if (row.counts[i] == 0 || outcome == grade::AnswerClass::right) continue;
            if (!reach.first[i] || cell.place < *reach.first[i]) reach.first[i] = cell.place;
          }
        }
        if (reach.answers > 0) reaches.push_back(reach);
      }
    }
  }
  return reaches;
}

std::vector<std::string> broken_promises(const StressRequest& request,
                                         std::span<const StressRow> rows) {
  std::vector<std::string> lines;
  for (const StressRow& row : rows) {
    const AlgorithmInfo& info = request.narrow[row.entry]->info;
    if (info.origin != Origin::ours || row.scalar != Precision::float64) continue;
    const StressCell& cell = request.cells[row.cell];
    for (const grade::AnswerClass outcome :
         {grade::AnswerClass::silent, grade::AnswerClass::crashed, grade::AnswerClass::hung}) {
      if (row.count(outcome) == 0) continue;
      lines.push_back(fmt::format("{} double {}: {} of {} {} at {} {}", info.name,
                                  to_string(row.task), row.count(outcome), row.answers(),
                                  to_string(outcome), cell.axis->name, cell.value().name));
    }
  }
  return lines;
}

void write_envelope(const StressRequest& request, std::span<const Reach> reaches,
                    const std::filesystem::path& file) {
  std::vector<std::string> header = {"algorithm", "origin", "scalar", "axis",
                                     "unit",      "from",   "to",     "answers"};
  for (const grade::AnswerClass outcome : grade::all_answer_classes)
    header.emplace_back(to_string(outcome));
  header.emplace_back("skipped");
  for (const grade::AnswerClass outcome : grade::all_answer_classes) {
    if (outcome == grade::AnswerClass::right) continue;
    header.push_back("first_" + std::string(to_string(outcome)));
  }
  header.insert(header.end(), {"first_wrong_side", "worst_margin", "worst_error"});
  files::CsvWriter csv(file, header);
  for (const Reach& reach : reaches) {
    const AlgorithmInfo& info = request.narrow[reach.entry]->info;
    const StressAxis& axis = *reach.axis;
    csv.field(info.name).field(to_string(info.origin)).field(to_string(reach.scalar));
    csv.field(axis.name).field(axis.unit);
    csv.field(axis.values.front().name).field(axis.values.back().name).field(reach.answers);
    for (const std::int64_t count : reach.counts) csv.field(count);
    csv.field(reach.skipped);
    for (const grade::AnswerClass outcome : grade::all_answer_classes) {
      if (outcome != grade::AnswerClass::right) csv.field(name_at(axis, reach.first_of(outcome)));
    }
    csv.field(name_at(axis, reach.first_side)).field(reach.margin).field(reach.error).end_row();
  }
  csv.close();
}

std::vector<std::vector<std::string>> table(const StressRequest& request,
                                            std::span<const Reach> reaches, EnvelopeTable which) {
  const std::vector<const StressAxis*> axes = axes_of(request);
  std::vector<std::vector<std::string>> rows = {{"algorithm"}};
  for (const StressAxis* axis : axes) rows.front().push_back(axis->name);
  const Reach* last = nullptr;
  for (const Reach& reach : reaches) {
    if (last == nullptr || last->entry != reach.entry || last->scalar != reach.scalar) {
      rows.emplace_back(axes.size() + 1);
      rows.back()[0] =
          fmt::format("{} {}", request.narrow[reach.entry]->info.name, to_string(reach.scalar));
    }
    last = &reach;
    const auto column =
        static_cast<std::size_t>(std::ranges::find(axes, reach.axis) - axes.begin()) + 1;
    rows.back()[column] = which == EnvelopeTable::honest
                              ? first_honest(reach)
                              : first_wrong(reach, which == EnvelopeTable::side);
  }
  return rows;
}

}  // namespace touchstone::check
