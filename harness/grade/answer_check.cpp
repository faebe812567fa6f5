// Compares two sorted lists of pairs, and outcomes with the oracle's answers, part by part for
// bodies that need not be convex.
#include "harness/grade/answer_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "algorithms/core/bounds.h"
#include "algorithms/registry.h"
#include "harness/grade/grade.h"
#include "harness/grade/margins.h"

namespace touchstone::grade {

PairFaults check_pairs(std::vector<IndexPair>& found, std::span<const IndexPair> truth,
                       std::span<const Aabb> before) {
  PairFaults faults;
  std::ranges::sort(found);
  std::optional<IndexPair> first_missing, first_extra, first_duplicate;
  const auto note = [](std::optional<IndexPair>& first, const IndexPair& pair) {
    if (!first) first = pair;
  };
  auto expected = truth.begin();
  for (auto at = found.begin(); at != found.end(); ++at) {
    if (at->a >= at->b || (at != found.begin() && *at == *std::prev(at))) {
      ++faults.duplicate;
      note(first_duplicate, *at);
      continue;
    }
    for (; expected != truth.end() && *expected < *at; ++expected) {
      ++faults.missing;
      note(first_missing, *expected);
    }
    if (expected != truth.end() && *expected == *at) {
      ++expected;
      continue;
    }
    const bool was = at->b < before.size() && overlap(before[at->a], before[at->b]);
    ++(was ? faults.stale : faults.extra);
    note(first_extra, *at);
  }
  for (; expected != truth.end(); ++expected) {
    ++faults.missing;
    note(first_missing, *expected);
  }
  faults.example = first_missing ? first_missing : first_extra ? first_extra : first_duplicate;
  return faults;
}

std::string to_string(const PairFaults& faults) {
  std::string text;
  const auto add = [&](std::int64_t count, const char* kind) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  };
  add(faults.missing, "missing");
  add(faults.stale, "stale");
  add(faults.extra, "extra");
  add(faults.duplicate, "duplicate");
  if (faults.example) text += fmt::format(" (first: {}-{})", faults.example->a, faults.example->b);
  return text;
}

namespace {

// Grows the greatest extent and coordinate by a box.
void grow(ReferenceOutcome& reference, const Aabb& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = box.min[axis], high = box.max[axis];
    reference.size = std::max(reference.size, high - low);
    reference.reach = std::max({reference.reach, std::abs(low), std::abs(high)});
  }
}

// Does the same by a body's box; a half-space has no box.
void grow(ReferenceOutcome& reference, const Shape& shape, const Pose& pose) {
  if (shape.kind == ShapeKind::halfspace) {
    reference.reach = std::max(reference.reach, std::abs(shape.offset));
    return;
  }
  grow(reference, tight_box(shape, pose));
}

}  // namespace

void OutcomeFaults::add(const OutcomeFaults& other) {
  compared += other.compared;
  disagree += other.disagree;
  grazing += other.grazing;
  failed += other.failed;
  crashed += other.crashed;
  timed_out += other.timed_out;
  unanswered += other.unanswered;
  contacts += other.contacts;
  values += other.values;
  if (other.worst_pair && other.worst >= worst) {
    worst = other.worst;
    worst_pair = other.worst_pair;
  }
  worst_value_error = std::max(worst_value_error, other.worst_value_error);
}

OutcomeFaults check_outcomes(std::span<const Outcome> outcomes,
                             std::span<const ReferenceOutcome> reference, Task task,
                             Precision scalar, std::span<const PartList> lists) {
  OutcomeFaults faults;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    const ReferenceOutcome& expected = reference[i];
    if (is_contact(outcome.answer)) ++faults.contacts;
    Verdict verdict = judge(outcome, expected.answer, Touching::contact);
    double by = std::abs(expected.distance);
    const double band = grazing_band(expected.size, expected.reach, scalar);
    if (verdict == Verdict::right && is_within_resolution(outcome)) {
      by = std::max(outcome.lower - expected.distance, expected.distance - outcome.upper);
      if (by > band) verdict = Verdict::silent_error;
    }
    if (verdict == Verdict::right && !lists.empty() && lists[i] != expected.parts) {
      verdict = Verdict::silent_error;
      by = Outcome::none;
    }
    switch (verdict) {
      case Verdict::crashed: ++faults.crashed; continue;
      case Verdict::timed_out: ++faults.timed_out; continue;
      case Verdict::unsupported: ++faults.unanswered; continue;
      case Verdict::honest_failure: {
        const bool says_so = outcome.status != Status::ok && outcome.status != Status::not_reported;
        ++(says_so ? faults.failed : faults.unanswered);
        continue;
      }
      case Verdict::unscored: continue;
      case Verdict::silent_error: {
        ++faults.compared;
        // The comparison is written so that an unknown distance counts as a disagreement.
        if (by <= band) {
          ++faults.grazing;
        } else {
          ++faults.disagree;
          if (!faults.worst_pair || by > faults.worst) {
            faults.worst = std::isnan(by) ? faults.worst : by;
            faults.worst_pair = i;
          }
        }
        continue;
      }
      case Verdict::right: ++faults.compared; break;
    }
    if (task != Task::intersect && std::isfinite(outcome.distance) &&
        std::isfinite(expected.distance) && expected.size > 0) {
      ++faults.values;
      faults.worst_value_error = std::max(
          faults.worst_value_error, std::abs(outcome.distance - expected.distance) / expected.size);
    }
  }
  return faults;
}

Reference::Reference(std::span<const Shape> shapes, Executor& executor)
    : shapes_(shapes),
      executor_(&executor),
      solids_(shapes.begin(), shapes.end()),
      oracles_(static_cast<std::size_t>(executor.width())) {}

std::vector<ReferenceOutcome> Reference::solve(const PairGroup& group,
                                               std::span<const std::uint32_t> shape_of,
                                               std::span<const Pose> poses) {
  std::vector<ReferenceOutcome> reference(group.size());
  executor_->run(group.size(), [&](std::size_t i, int worker) {
    ReferenceOutcome& result = reference[i];
    const auto body = [&](std::uint32_t k) {
      grow(result, shapes_[shape_of[k]], poses[k]);
      return oracle::Body(solids_[shape_of[k]], poses[k]);
    };
    const oracle::Measure measure = oracles_[static_cast<std::size_t>(worker)].measure(
        body(group.first[i]), body(group.second[i]));
    result.answer = measure.answer;
    result.distance = measure.middle();
  });
  return reference;
}

ConcaveReference::ConcaveReference(std::span<const ConcaveBody> bodies)
    : oracle_(registry::find<ConcaveEntry>("exact")->make({})) {
  oracle_->bind(bodies);
}

std::vector<ReferenceOutcome> ConcaveReference::solve(ConcaveTask task, const PairGroup& group,
                                                      std::span<const std::uint32_t> shape_of,
                                                      std::span<const Pose> poses,
                                                      std::span<const Aabb> boxes) {
  std::vector<ReferenceOutcome> reference(group.size());
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < group.size(); ++i) {
    ReferenceOutcome& result = reference[i];
    const std::uint32_t a = group.first[i], b = group.second[i];
    grow(result, boxes[a]);
    grow(result, boxes[b]);
    Outcome outcome;
    pairs.clear();
    oracle_->solve(task, {shape_of[a], poses[a]}, {shape_of[b], poses[b]}, outcome, pairs);
    // Where the oracle is not certain of all parts, its list is not held against others.
    if (outcome.status == Status::ok) result.answer = outcome.answer;
    if (outcome.answer == Answer::separated) result.distance = outcome.distance;
    if (task == ConcaveTask::contacts) result.parts = part_list(pairs);
  }
  return reference;
}

}  // namespace touchstone::grade
