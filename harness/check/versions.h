// One library in several versions over the same cases: how many answers of each are wrong, which answers changed from a
// version to the next, and which of the two is right.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/core/outcome.h"
#include "harness/base/table.h"
#include "harness/check/family_checker.h"
#include "harness/record/row.h"

namespace touchstone::check {

// A row of versions.csv: the answers of a version in a group of regimes, over all tasks.
struct VersionCount {
  std::string library, version, algorithm;
  Precision scalar{};
  std::string group;
  std::int64_t answers = 0, wrong = 0, wrong_pairs = 0, gave_up = 0, failed = 0;
  double worst = Outcome::none;
  std::string worst_case;
};

template <record::row_of<VersionCount> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("library", row.library, "Name of the peer.");
  visit("version", row.version, "Version of the library.");
  visit("algorithm", row.algorithm, "Name by which that version is asked.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("group", row.group, "Group of regimes.");
  visit("answers", row.answers, "Answers, over all tasks.");
  visit("wrong", row.wrong,
        "Answers off by more than 1e-4 of the pair's scale, in the side of contact or a number.");
  visit("wrong_pairs", row.wrong_pairs, "Pairs about which these are.");
  visit("gave_up", row.gave_up, "Gave up: the status says so, or there is no answer.");
  visit("failed", row.failed, "Crashed, gave no answer in time, or cannot be read.");
  visit("worst", row.worst, "Greatest error of a wrong answer, as a part of the scale.");
  visit("worst_case", row.worst_case, "Regime and index of that case.");
}

// A row of version_changes.csv: an answer that changed from a version to the next.
struct VersionChange {
  std::string library;
  Precision scalar{};
  std::string from, to, regime;
  std::int64_t index = 0;
  std::string kind_a, kind_b, task, exact;
  double exact_lower = 0, exact_upper = 0;
  std::string before, after;
  double error_before = 0, error_after = 0;
  std::string became;
};

template <record::row_of<VersionChange> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("library", row.library, "Name of the peer.");
  visit("scalar", row.scalar, "Precision that it computes in.");
  visit("from", row.from, "The version before.");
  visit("to", row.to, "The version after.");
  visit("regime", row.regime, "Regime of the case.");
  visit("index", row.index, "Number of the case in its regime.");
  visit("kind_a", row.kind_a, "Kind of the first shape.");
  visit("kind_b", row.kind_b, "Kind of the second shape.");
  visit("task", row.task, "What was asked.");
  visit("exact", row.exact, "The exact answer.");
  visit("exact_lower", row.exact_lower, "Proven lower bound of the signed distance, metres.");
  visit("exact_upper", row.exact_upper, "Proven upper bound of it.");
  visit("before", row.before, "Answer of the version before, or how it failed.");
  visit("after", row.after, "Answer of the version after.");
  visit("error_before", row.error_before, "Its greatest error, as a part of the scale.");
  visit("error_after", row.error_after, "The same of the version after.");
  visit(
      "became", row.became,
      "`right` or `wrong`; `lost`, if it was right and is given up; `other`, if both are wrong, or "
      "both are right and touch.");
}

struct CheckedAnswer;

// Returns what is so of the answer's question, whatever the answer.
VersionChange change_of(const CheckedAnswer& one);

struct VersionReport {
  std::vector<VersionCount> counts;    // in the order of the versions, then of the groups
  std::vector<VersionChange> changes;  // in the order of the cases

  bool is_empty() const { return counts.empty(); }
  base::Table table() const;               // over all groups
  std::vector<std::string> since() const;  // a line for each pair of versions with changes
};

// Compares the versions of each library, such as mujoco@3.9.0 and mujoco@3.14.0, in the order in which they were asked,
// if two or more of one were asked. Libraries that are built in have one version each; those whose depths are bounds by
// design are left out. It reads the grades.csv of the finished check, and writes versions.csv, version_changes.csv and
// wrong_pairs.jsonl (wrong_pairs.h) beside it if there are some. Throws base::InputError for a file that cannot be read
// or written.
VersionReport compare_versions(const CheckRequest& request);

}  // namespace touchstone::check
