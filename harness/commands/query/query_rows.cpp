// The rows and the summary of touchstone query.
#include "harness/commands/query/query_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace touchstone::commands {

std::vector<std::string> query_columns() {
  return {"id",    "algorithm", "scalar",   "task",     "answer",     "status",       "distance",
          "lower", "upper",     "normal_x", "normal_y", "normal_z",   "a_x",          "a_y",
          "a_z",   "b_x",       "b_y",      "b_z",      "iterations", "support_calls"};
}

void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome) {
  csv.field(head.id).field(head.algorithm).field(head.scalar).field(head.task);
  csv.field(to_string(outcome.answer)).field(to_string(outcome.status));
  csv.field(outcome.distance).field(outcome.lower).field(outcome.upper);
  for (const Vec3d& v : {outcome.normal, outcome.witness_a, outcome.witness_b}) {
    for (const double x : v) csv.field(x);
  }
  for (const std::int32_t count : {outcome.iterations, outcome.support_calls}) {
    if (count < 0) {
      csv.field("");
    } else {
      csv.field(count);
    }
  }
}

std::string status_counts(const std::map<Status, std::size_t>& statuses) {
  std::string text;
  for (const auto& [status, count] : statuses) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(status), count);
    if (status == Status::not_reported) text += " (the library has no status)";
  }
  return text;
}

void print_scalar_hint(const std::vector<std::string>& names, Precision asked) {
  if (names.empty()) return;
  const bool is_double = asked == Precision::float64;
  fmt::print("Without an answer, as they calculate in {} alone: {}; --scalar {} asks them\n",
             is_double ? "float" : "double", fmt::join(names, ", "),
             is_double ? "float" : "double");
}

void tell_extent(const std::string& file, std::span<const Vec3d> vertices) {
  if (vertices.empty()) return;
  Vec3d low = vertices[0], high = low;
  for (const Vec3d& v : vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Vec3d size = high - low;
  fmt::print(stderr, "{}: {} vertices in a box of {:.4g} x {:.4g} x {:.4g}, taken as metres\n",
             file, vertices.size(), size.x(), size.y(), size.z());
}

void QuerySummary::count(std::string_view algorithm, const Outcome& outcome) {
  auto at = std::ranges::find(counts_, algorithm, &Counts::algorithm);
  if (at == counts_.end()) {
    counts_.push_back({std::string(algorithm), {}, {}});
    at = counts_.end() - 1;
  }
  ++at->answers[static_cast<std::size_t>(outcome.answer)];
  ++at->statuses[outcome.status];
}

void QuerySummary::print() const {
  fmt::print("{:<28} {:>9} {:>8} {:>11} {:>7}  {}\n", "algorithm", "separated", "touching",
             "overlapping", "unknown", "status");
  for (const Counts& counts : counts_) {
    fmt::print("{:<28} {:>9} {:>8} {:>11} {:>7}  {}\n", counts.algorithm, counts.answers[0],
               counts.answers[1], counts.answers[2], counts.answers[3],
               status_counts(counts.statuses));
  }
}

}  // namespace touchstone::commands
