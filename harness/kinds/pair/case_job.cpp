// The job of a regime's cases: draws them, runs every algorithm on them, and grades the answers.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "algorithms/core/bounds.h"
#include "algorithms/oracle/certificates/certificate_check.h"
#include "harness/files/certificates.h"
#include "harness/grade/margins.h"
#include "harness/kinds/pair/pair_checkers.h"
#include "harness/process/isolate.h"
#include "harness/process/solve_case.h"

namespace touchstone::kinds {
namespace {

// One query: a case, or one of its variants.
struct PairItem {
  std::size_t place;  // place of the case
  const Variant* variant;
  Task task;
};

void note_worst(JobSummary& summary, bool is_first, std::uint64_t index) {
  if (is_first) summary.worst_index = index;
}

// An algorithm may lose so many queries of a job, since each hang costs a time limit.
constexpr std::size_t most_lost_answers = 100;

class PairJob {
 public:
  PairJob(const PairRequest& request, std::uint32_t regime, std::uint64_t round,
          oracle::Oracle& oracle)
      : request_(request), oracle_(oracle) {
    JobSummary& summary = summary_;
    summary.regime = regime;
    summary.round = round;
    summary.cases = request.cases;
    const auto count = static_cast<std::uint64_t>(request.cases);
    for (std::uint64_t index = summary.round * count; index < (summary.round + 1) * count;
         ++index) {
      cases_.emplace_back(make(this->regime(), request.seed, index), index, oracle);
      variants_.push_back(sampled_variants(cases_.back().pair(), request.seed, index));
    }
  }

  CaseRows run() {
    for (grade::TrueCase& c : cases_) check_case(c);
    for (const auto& [entry, scalar] : request_.algorithms) ask(entry, scalar);
    for (auto& [key, count] : counts_) rows_.of<VariantCount>().push_back(count);
    rows_.of<JobSummary>() = {summary_};
    return std::move(rows_);
  }

 private:
  const Regime& regime() const { return *request_.regimes[summary_.regime]; }

  // Checks the certificate and the boxes of a case, which do not depend on any algorithm.
  void check_case(grade::TrueCase& c) {
    JobSummary& summary = summary_;
    const grade::TrueCase::Truth& truth = c.truth(Encoding::as_given);
    if (truth.measure.answer == Answer::unknown) ++summary.unresolved;
    const auto is_first = [&] { return summary.refused + summary.boxes_broken == 1; };
    if (is_sampled(c.index())) {
      oracle::Certificate certificate;
      oracle_.prove(truth.pair.a(), truth.pair.b(), certificate);
      const bool good = oracle::fault(certificate, truth.pair.a(), truth.pair.b()).empty();
      ++(good ? summary.proven : summary.refused);
      note_worst(summary, !good && is_first(), c.index());
    }
    const auto check_boxes = [&](const Shape& shape, const Pose& pose, const oracle::Body& body) {
      const double reach = loose_reach(shape, pose.rotation);
      for (const Aabb& box : {tight_box(shape, pose), loose_box(reach, pose.translation)}) {
        ++summary.boxes;
        if (oracle::holds(box, body)) continue;
        ++summary.boxes_broken;
        note_worst(summary, is_first(), c.index());
      }
    };
    check_boxes(c.pair().shape_a, c.pair().pose_a, truth.pair.a());
    check_boxes(c.pair().shape_b, c.pair().pose_b, truth.pair.b());
  }

  // Runs all queries of one algorithm in a child process.
  void ask(std::uint32_t entry, Precision scalar) {
    const NarrowPhaseEntry& algorithm = *request_.narrow[entry];
    std::vector<PairItem> items;
    for (std::size_t place = 0; place < cases_.size(); ++place) {
      const files::Case& c = cases_[place].pair();
      for (const Task task : all_tasks) {
        if (!offers(algorithm, c.shape_a.kind, c.shape_b.kind, task)) continue;
        items.push_back({place, nullptr, task});
        for (const Variant& variant : variants_[place]) items.push_back({place, &variant, task});
      }
    }
    const NarrowPhaseSettings settings = {.scalar = scalar};
    const process::IsolationLimits limits = {.item_seconds = request_.time_limit,
                                             .failures = most_lost_answers};
    const auto solved = process::isolated_answers<Outcome>(items.size(), limits, [&] {
      return [&](std::size_t i) {
        const PairItem& item = items[i];
        const files::Case& c =
            item.variant != nullptr ? item.variant->transformed : cases_[item.place].pair();
        return process::solve_case(algorithm, settings, c, item.task);
      };
    });
    grade::GradedAnswer* original = nullptr;
    const Outcome* original_outcome = nullptr;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const Outcome& outcome = solved.answers[i];
      if (outcome.status == Status::unsupported) {  // a peer may refuse what its kinds allow
        if (items[i].variant == nullptr) original = nullptr;
        continue;
      }
      if (items[i].variant == nullptr) {
        const grade::Query query = {summary_.regime, entry, scalar, items[i].task};
        auto& answers = rows_.of<grade::GradedAnswer>();
        answers.push_back(grade::grade_answer(algorithm, regime().extreme, query,
                                              cases_[items[i].place], outcome));
        original = &answers.back();
        original_outcome = &outcome;
      } else if (original != nullptr) {
        compare(*original, *original_outcome, *items[i].variant, outcome);
      }
    }
  }

  void compare(const grade::GradedAnswer& original, const Outcome& outcome, const Variant& variant,
               const Outcome& of_variant) {
    const NarrowPhaseEntry& algorithm = *request_.narrow[original.entry];
    const std::string kind = kind_of(variant);
    VariantCount& count = counts_[{original.entry, original.scalar, original.task, kind}];
    count.regime = summary_.regime;
    count.round = summary_.round;
    count.entry = original.entry;
    count.scalar = original.scalar;
    count.task = original.task;
    count.kind = kind;
    const grade::Margins margins = grade::documented_margins(original.scalar, regime().extreme);
    bool beyond = false;
    bool worse = false;
    if (process::is_lost(of_variant.status) && !process::is_lost(outcome.status)) {
      ++count.lost;
      beyond = true;
    }
    if (grade::stands_by(outcome) && grade::stands_by(of_variant)) {
      ++count.compared;
      const Outcome turned_back = to_original(variant, of_variant);
      const double scale = original.scale;
      const bool takes_sides =
          !grade::is_within_resolution(outcome) && !grade::is_within_resolution(of_variant);
      const bool other_side =
          grade::is_contact(outcome.answer) != grade::is_contact(of_variant.answer);
      if (takes_sides && other_side) {
        if (original.exact == Answer::separated || original.exact == Answer::overlapping) {
          const double gap = original.exact == Answer::separated ? original.lower : -original.upper;
          ++count.flips;
          worse = gap / scale > count.worst_flip;
          count.worst_flip = std::max(count.worst_flip, gap / scale);
          beyond = beyond || (gap / scale >= margins.verdict && !algorithm.traits.approximate);
        }
      } else if (!other_side && asks_for_number(original.task, outcome.answer) &&
                 std::isfinite(outcome.distance) && std::isfinite(turned_back.distance)) {
        const double difference = std::abs(outcome.distance - turned_back.distance) / scale;
        count.worst_difference = std::max(count.worst_difference, difference);
        const bool any_depth = asks_depth(original.task) && outcome.answer != Answer::separated &&
                               algorithm.traits.depth_is_bound;
        beyond = beyond || (difference > 2 * margins.length && !any_depth);
      }
    }
    beyond = beyond && is_answerable(algorithm.info.origin);
    if (beyond ? count.beyond == 0 : worse && count.beyond == 0) count.worst_index = original.index;
    if (beyond) ++count.beyond;
  }

  const PairRequest& request_;
  oracle::Oracle& oracle_;
  std::vector<grade::TrueCase> cases_;
  std::vector<std::vector<Variant>> variants_;  // variants of each case
  std::map<std::tuple<std::uint32_t, Precision, Task, std::string>, VariantCount> counts_;
  JobSummary summary_;
  CaseRows rows_;
};

}  // namespace

std::string proof_line(const files::Case& c, oracle::Oracle& oracle) {
  files::StoredCertificate stored;
  stored.id = c.id;
  stored.encoding = to_string(Encoding::as_given);
  stored.shape_a = c.shape_a;
  stored.shape_b = c.shape_b;
  stored.pose_a = c.pose_a;
  stored.pose_b = c.pose_b;
  const oracle::Solid a(c.shape_a), b(c.shape_b);
  oracle.prove({a, c.pose_a}, {b, c.pose_b}, stored.certificate);
  return files::to_json(stored) + '\n';
}

std::string CaseChecker::certificates(std::uint32_t family) {
  const Regime& regime = *request_.regimes[request_.regime_of(family)];
  std::string lines;
  for (int index = 0; index < request_.cases; ++index) {
    lines += proof_line(make(regime, request_.seed, static_cast<std::uint64_t>(index)), oracle_);
  }
  return lines;
}

CaseRows CaseChecker::rows_of_job(std::uint32_t family, std::uint64_t round) {
  return PairJob(request_, request_.regime_of(family), round, oracle_).run();
}

}  // namespace touchstone::kinds
