// Plays configurations in child processes, and counts and sums their errors.
#include "harness/trade/evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace touchstone::trade {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

constexpr double no_value = 1;  // error of an answer that has no number, as a part of the size

bool before(const IndexPair& a, const IndexPair& b) { return a.a != b.a ? a.a < b.a : a.b < b.b; }

double share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

std::size_t gap_bin(Answer truth, double gap) {
  if (grade::is_contact(truth) && std::isnan(gap)) return unknown_depth_bin;
  std::size_t decade = 0;
  while (decade < gap_decades.size() && std::abs(gap) < gap_decades[decade]) ++decade;
  return grade::is_contact(truth) ? decade : gap_bins - 1 - decade;
}

GapRange gap_range(std::size_t bin) {
  if (bin == unknown_depth_bin) return {Outcome::none, 0};
  const bool contact = bin <= gap_decades.size();
  const std::size_t decade = contact ? bin : gap_bins - 1 - bin;
  const double far = decade == 0 ? inf : gap_decades[decade - 1];
  const double near = decade == gap_decades.size() ? 0 : gap_decades[decade];
  return contact ? GapRange{-far, -near} : GapRange{near, far};
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  Spread spread;
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  // The smallest value that 99 % of the errors do not exceed.
  const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(values.size())));
  spread.p99 = values[rank - 1];
  spread.greatest = values.back();
  return spread;
}

double PointErrors::wrong_share() const {
  return share(false_positives + false_negatives + failed + far, near + far);
}
double PointErrors::false_negative_share() const { return share(false_negatives, contacts); }

void ErrorCount::add(const TruePair& truth, const PairAnswer* answer) {
  if (truth.answer == Answer::unknown) return;
  const bool contact = grade::is_contact(truth.answer);
  const bool answered = answer == nullptr || answer->answer != Answer::unknown;
  const bool said_contact = answer != nullptr && grade::is_contact(answer->answer);
  // `touching` within bounds is right if they hold.
  const bool is_resolved =
      answer != nullptr && answer->answer == Answer::touching && truth.gap <= answer->upper;
  GapBin& bin = errors_.bins[gap_bin(truth.answer, truth.gap / truth.size)];
  ++bin.pairs;
  ++errors_.near;
  if (contact) ++errors_.contacts;
  if (!answered) {
    ++bin.failed;
    ++errors_.failed;
  } else if (said_contact != contact && !is_resolved) {
    ++bin.wrong;
    ++(contact ? errors_.false_negatives : errors_.false_positives);
  }
  if (task_ == Task::intersect) return;
  const bool wants_depth = task_ == Task::penetration;
  const double expected = contact != wants_depth ? 0 : std::abs(truth.gap);
  if (!std::isfinite(expected)) return;  // an unknown truth is no error of the answer
  double given = 0;
  if (answer == nullptr) {
    // The pair was not found, so it has no distance, unless a contact was missed: by its depth at
    // least.
    if (!wants_depth && !contact) return;
    if (!wants_depth) given = std::abs(truth.gap);
  } else if (!answered || said_contact == wants_depth) {
    // In this order of arguments NaN stays NaN.
    given = std::max(wants_depth ? -answer->distance : answer->distance, 0.0);
  }
  const double error = std::abs(given - expected) / truth.size;
  values_.push_back(std::isfinite(error) ? error : no_value);
}

void ErrorCount::add(const FrameTruth& truth, std::span<const PairAnswer> answers) {
  std::vector<const PairAnswer*> sorted;
  sorted.reserve(answers.size());
  for (const PairAnswer& answer : answers) sorted.push_back(&answer);
  std::ranges::sort(sorted, before, [](const PairAnswer* answer) { return answer->pair; });
  auto next = sorted.begin();
  const auto pass_far = [&](const IndexPair* until) {
    while (next != sorted.end() && (until == nullptr || before((*next)->pair, *until))) {
      if (grade::is_contact((*next)->answer)) ++errors_.far;
      ++next;
    }
  };
  for (const TruePair& pair : truth.pairs) {
    pass_far(&pair.pair);
    const bool found = next != sorted.end() && !before(pair.pair, (*next)->pair);
    add(pair, found ? *next : nullptr);
    if (found) ++next;
  }
  pass_far(nullptr);
}

PointErrors ErrorCount::errors() {
  errors_.values = static_cast<std::int64_t>(values_.size());
  errors_.value = spread_of(values_);
  return errors_;
}

namespace {

struct Found {  // the result that the child sends
  PointErrors errors;
  PipelineCounters counters;
  StageSeconds rough{};
};

void play(const SceneFrames& frames, const TradePoint& point, std::span<const FrameTruth> truth,
          Task task, Found& found) {
  Executor executor(1);
  FramePipeline pipeline(frames, *point.stand_ins, point.configuration, task, executor);
  pipeline.count_witnesses();
  ErrorCount count(task);
  double timed = 0;
  for (const FrameTruth& frame : truth) {
    if (frame.frame == 0) {
      pipeline.start(0);
    } else {
      // The frame is an update, as in the timed scene.
      pipeline.pass(frame.frame - 1);
      pipeline.advance();
    }
    count.add(frame, pipeline.answers());
    // The scene has more frames, which come later.
    if (frame.frame == 0 && truth.size() > 1) continue;
    ++timed;
    for (std::size_t i = 0; i < found.rough.size(); ++i) found.rough[i] += pipeline.seconds()[i];
  }
  for (double& seconds : found.rough) seconds /= timed;
  found.errors = count.errors();
  found.counters = pipeline.counters();
}

}  // namespace

double Evaluation::rough_seconds() const {
  return std::accumulate(rough.begin(), rough.end(), 0.0);
}

std::vector<Evaluation> evaluate(const SceneFrames& frames, std::span<const TradePoint> points,
                                 std::span<const FrameTruth> truth, Task task,
                                 const EvaluationLimits& limits) {
  process::SharedArray<Found> found(points.size());
  process::IsolationLimits isolation;
  isolation.item_seconds = limits.seconds;
  isolation.memory = limits.memory;
  const process::IsolationReport report =
      process::isolate(points.size(), isolation, [&]() -> process::ItemWork {
        return [&](std::size_t i) { play(frames, points[i], truth, task, found[i]); };
      });
  std::vector<Evaluation> evaluations(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Evaluation& evaluation = evaluations[i];
    evaluation.state = report.states[i];
    if (report.states[i] == process::ItemState::done) {
      evaluation.errors = found[i].errors;
      evaluation.counters = found[i].counters;
      evaluation.rough = found[i].rough;
    }
  }
  for (const process::IsolationFailure& failure : report.failures) {
    evaluations[failure.item].words = failure.reason();
  }
  return evaluations;
}

std::string_view to_string(ErrorMeasure measure) {
  return error_measure_names[static_cast<std::size_t>(measure)];
}

ErrorMeasure default_measure(Task task) {
  return task == Task::intersect ? ErrorMeasure::verdicts : ErrorMeasure::greatest;
}

RepresentationSpread spread_of(std::span<const proxies::RepresentationError> errors) {
  std::vector<double> volumes, distances;
  for (const proxies::RepresentationError& error : errors) {
    volumes.push_back(error.volume_error());
    distances.push_back(error.size > 0 ? error.hausdorff / error.size : 0);
  }
  return {spread_of(std::move(volumes)), spread_of(std::move(distances))};
}

double error_of(const PointErrors& errors, const RepresentationSpread& representation,
                ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::verdicts: return errors.wrong_share();
    case ErrorMeasure::false_negatives: return errors.false_negative_share();
    case ErrorMeasure::mean: return errors.value.mean;
    case ErrorMeasure::p99: return errors.value.p99;
    case ErrorMeasure::greatest: return errors.value.greatest;
    case ErrorMeasure::volume: return representation.volume.greatest;
    case ErrorMeasure::hausdorff: break;
  }
  return representation.hausdorff.greatest;
}

std::vector<std::size_t> pareto_front(std::span<const FrontPoint> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) {
    return std::isnan(points[i].seconds) || std::isnan(points[i].error);
  });
  std::ranges::stable_sort(order, [&](std::size_t i, std::size_t j) {
    return points[i].seconds != points[j].seconds ? points[i].seconds < points[j].seconds
                                                  : points[i].error < points[j].error;
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(points[i].error < least)) continue;
    least = points[i].error;
    front.push_back(i);
  }
  return front;
}

}  // namespace touchstone::trade
