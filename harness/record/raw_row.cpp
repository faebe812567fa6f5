// Names of a row's enumerations and labels.
#include "harness/record/raw_row.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

namespace touchstone::record {

static_assert(base::enumerators<RowStatus>.size() == base::enumerators<Status>.size() + 1);
static_assert(row_status(Status::garbage) == RowStatus::garbage);
static_assert(row_origin(Origin::module) == RowOrigin::module);

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::build: return "build";
    case Phase::update: return "update";
    case Phase::find_pairs: return "find_pairs";
    case Phase::narrow: return "narrow";
    case Phase::convert: return "convert";
    case Phase::answer: return "answer";
  }
  return "?";
}

std::string_view to_string(RowKind kind) { return kind == RowKind::check ? "check" : "sample"; }

std::string_view to_string(RowStatus status) {
  return status == RowStatus::wrong ? "wrong" : to_string(static_cast<Status>(status));
}

std::string_view to_string(RowOrigin origin) {
  return origin == RowOrigin::limit ? "limit" : to_string(static_cast<Origin>(origin));
}

void RawRow::take(const BroadPhaseWork& work) {
  box_tests = work.box_tests;
  node_visits = work.node_visits;
  candidates = work.candidates;
  bytes = work.bytes;
}

std::string narrow_label(std::string_view name, std::string_view scalar, double tolerance,
                         double duality_gap, bool warm, std::int64_t batch) {
  std::string label = fmt::format("{} {}", name, scalar);
  if (!std::isnan(tolerance)) label += fmt::format(" {:g}", tolerance);
  if (!std::isnan(duality_gap)) label += fmt::format(" gap {:g}", duality_gap);
  if (warm) label += " warm";
  if (batch > 0) label += fmt::format(" by {}", batch);
  return label;
}

std::string algorithm_label(const RawRow& row) {
  if (row.is_of_set()) return row.algorithm;
  if (!row.is_narrow()) return row.broad;
  return narrow_label(row.narrow, row.scalar ? to_string(*row.scalar) : "", row.tolerance,
                      row.duality_gap, row.is_warm(), row.batch);
}

std::string label_on(std::string algorithm, std::optional<ExecutorKind> executor) {
  if (executor.value_or(usual_executor) == usual_executor) return algorithm;
  return fmt::format("{} {}", algorithm, to_string(*executor));
}

std::string label_of(const RawRow& row) { return label_on(algorithm_label(row), row.executor); }

}  // namespace touchstone::record
