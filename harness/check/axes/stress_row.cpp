#include "harness/check/axes/stress_row.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace touchstone {
namespace {

constexpr std::size_t first_count = 5;  // column

// Three digits tell enough.
std::string short_number(double x) { return std::isnan(x) ? "" : fmt::format("{:.2e}", x); }

double number(const CsvReader::Row& row, std::size_t column) {
  return row.text(column).empty() ? Outcome::none : row.number(column);
}

template <class Has>
std::uint32_t place(const CsvReader::Row& row, std::size_t column, std::size_t size,
                    const Has& has) {
  for (std::size_t i = 0; i < size; ++i) {
    if (has(i)) return static_cast<std::uint32_t>(i);
  }
  row.fail(fmt::format("column {}: found '{}'; expected one of this sweep's",
                       stress_header()[column], row.text(column)));
}

}  // namespace

std::int32_t StressRow::answers() const {
  return std::accumulate(counts.begin(), counts.end(), std::int32_t{0});
}

std::vector<std::string> stress_header() {
  std::vector<std::string> header = {"axis", "value", "algorithm", "scalar", "task"};
  for (const StressOutcome outcome : all_stress_outcomes) header.emplace_back(to_string(outcome));
  header.insert(header.end(),
                {"skipped", "worst_margin", "worst_error", "worst_index", "lost_index"});
  return header;
}

void write(CsvWriter& file, const StressRow& row, const StressRequest& request) {
  const StressCell& cell = request.cells[row.cell];
  file.field(cell.axis->name).field(cell.value().name);
  file.field(request.narrow[row.entry]->info.name);
  file.field(to_string(row.scalar)).field(to_string(row.task));
  for (const std::int32_t count : row.counts) file.field(count);
  file.field(row.skipped).field(short_number(row.margin)).field(short_number(row.error));
  for (const std::int64_t index : {row.worst, row.lost}) {
    if (index < 0) {
      file.field("");
    } else {
      file.field(index);
    }
  }
  file.end_row();
}

StressRow read_stress_row(const CsvReader::Row& row, const StressRequest& request) {
  StressRow out;
  out.cell = place(row, 1, request.cells.size(), [&](std::size_t i) {
    const StressCell& cell = request.cells[i];
    return cell.axis->name == row.text(0) && cell.value().name == row.text(1);
  });
  out.entry = place(row, 2, request.narrow.size(),
                    [&](std::size_t i) { return request.narrow[i]->info.name == row.text(2); });
  constexpr std::array<Precision, 2> scalars = {Precision::float32, Precision::float64};
  out.scalar = scalars[place(row, 3, scalars.size(),
                             [&](std::size_t i) { return to_string(scalars[i]) == row.text(3); })];
  constexpr std::array<Task, 3> tasks = {Task::intersect, Task::distance, Task::penetration};
  out.task = tasks[place(row, 4, tasks.size(),
                         [&](std::size_t i) { return to_string(tasks[i]) == row.text(4); })];
  std::size_t column = first_count;
  for (std::int32_t& count : out.counts) {
    count = static_cast<std::int32_t>(row.integer(column++));
  }
  out.skipped = static_cast<std::int32_t>(row.integer(column++));
  out.margin = number(row, column++);
  out.error = number(row, column++);
  for (std::int64_t* index : {&out.worst, &out.lost}) {
    if (!row.text(column).empty()) *index = row.integer(column);
    ++column;
  }
  return out;
}

}  // namespace touchstone
