#include "harness/check/graded_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <type_traits>

namespace touchstone {
namespace {

static_assert(std::is_trivially_copyable_v<GradedAnswer>);

// Every column once, in order: `visit` is called with its name and a reference to its field.
template <class Row, class Visit>
void for_each_number(Row& row, const Visit& visit) {
  visit("size", row.size);
  visit("scale", row.scale);
  visit("exact_lower", row.lower);
  visit("exact_upper", row.upper);
  visit("given_lower", row.given_lower);
  visit("given_upper", row.given_upper);
  visit("margin", row.given.margin);
  visit("distance_error", row.given.distance_error);
  visit("depth_error", row.given.depth_error);
  visit("separation_error", row.given.separation_error);
  visit("excess", row.given.excess);
  visit("bounds_error", row.given.bounds_error);
  visit("end_margin", row.end_to_end.margin);
  visit("end_distance_error", row.end_to_end.distance_error);
  visit("end_depth_error", row.end_to_end.depth_error);
  visit("end_separation_error", row.end_to_end.separation_error);
  visit("end_excess", row.end_to_end.excess);
  visit("end_bounds_error", row.end_to_end.bounds_error);
  visit("witness_error", row.witnesses.off_body);
  visit("witness_length_error", row.witnesses.length_error);
  visit("normal_error", row.witnesses.normal_error);
}

constexpr std::array<std::string_view, 17> names = {
    "regime",      "index",        "kind_a",        "kind_b",     "algorithm", "scalar",
    "task",        "encoding",     "exact",         "answer",     "status",    "verdict",
    "end_verdict", "not_a_number", "beyond_margin", "iterations", "group"};

// The value of an enumeration with this written name.
template <class Value, std::size_t size>
Value value_of(const CsvReader::Row& row, std::size_t column,
               const std::array<Value, size>& values) {
  const std::string_view text = row.text(column);
  for (const Value value : values) {
    if (to_string(value) == text) return value;
  }
  row.fail(fmt::format("column {}: found '{}'; expected what `check` writes", names[column], text));
}

template <class Value, int count>
constexpr std::array<Value, static_cast<std::size_t>(count)> all_of() {
  std::array<Value, static_cast<std::size_t>(count)> values{};
  for (int i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = static_cast<Value>(i);
  return values;
}
constexpr auto all_precisions = all_of<Precision, 2>();
constexpr auto all_tasks = all_of<Task, 3>();
constexpr auto all_answers = all_of<Answer, 4>();
constexpr auto all_statuses = all_of<Status, 8>();
constexpr auto all_verdicts = all_of<Verdict, 7>();

template <class Name>
std::uint32_t place_of(const CsvReader::Row& row, std::size_t column, std::size_t count,
                       const Name& name_of) {
  for (std::size_t i = 0; i < count; ++i) {
    if (name_of(i) == row.text(column)) return static_cast<std::uint32_t>(i);
  }
  row.fail(fmt::format("column {}: found '{}'; expected one that is checked", names[column],
                       row.text(column)));
}

}  // namespace

std::vector<std::string> graded_answer_header() {
  std::vector<std::string> header(names.begin(), names.end());
  GradedAnswer row;
  for_each_number(row, [&](const char* name, double) { header.emplace_back(name); });
  return header;
}

void write(CsvWriter& file, const GradedAnswer& row, const CheckSubjects& subjects) {
  const Regime& regime = *subjects.regimes[row.regime];
  file.field(regime.name).field(static_cast<std::int64_t>(row.index));
  file.field(to_string(row.kind_a)).field(to_string(row.kind_b));
  file.field(subjects.narrow[row.entry]->info.name).field(to_string(row.scalar));
  file.field(to_string(row.task)).field(to_string(row.encoding));
  file.field(to_string(row.exact)).field(to_string(row.answer)).field(to_string(row.status));
  file.field(to_string(row.given.verdict)).field(to_string(row.end_to_end.verdict));
  file.field(row.witnesses.not_a_number ? 1 : 0).field(row.beyond ? 1 : 0);
  if (row.iterations < 0) {
    file.field("");
  } else {
    file.field(row.iterations);
  }
  file.field(regime.group);
  for_each_number(row, [&](const char*, double value) { file.field(value); });
  file.end_row();
}

GradedAnswer read_graded_answer(const CsvReader::Row& row, const CheckSubjects& subjects) {
  GradedAnswer out;
  out.regime = place_of(row, 0, subjects.regimes.size(),
                        [&](std::size_t i) { return subjects.regimes[i]->name; });
  out.index = static_cast<std::uint64_t>(row.integer(1));
  out.kind_a = value_of(row, 2, all_shape_kinds);
  out.kind_b = value_of(row, 3, all_shape_kinds);
  out.entry = place_of(row, 4, subjects.narrow.size(),
                       [&](std::size_t i) { return subjects.narrow[i]->info.name; });
  out.scalar = value_of(row, 5, all_precisions);
  out.task = value_of(row, 6, all_tasks);
  out.encoding = value_of(row, 7, all_encodings);
  out.exact = value_of(row, 8, all_answers);
  out.answer = value_of(row, 9, all_answers);
  out.status = value_of(row, 10, all_statuses);
  out.given.verdict = value_of(row, 11, all_verdicts);
  out.end_to_end.verdict = value_of(row, 12, all_verdicts);
  out.witnesses.not_a_number = row.integer(13) != 0;
  out.beyond = row.integer(14) != 0;
  if (!row.text(15).empty()) out.iterations = static_cast<std::int32_t>(row.integer(15));
  std::size_t column = names.size();
  for_each_number(out, [&](const char*, double& value) {
    value = row.text(column).empty() ? Outcome::none : row.number(column);
    ++column;
  });
  return out;
}

}  // namespace touchstone
