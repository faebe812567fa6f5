// Asks algorithms about the pairs of a played scene.
#include "harness/report/scene_pairs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "harness/grade/grade.h"
#include "harness/process/isolate.h"

namespace touchstone::report {

ScenePairs::ScenePairs(const measure::BlockInput& input) : input_(&input) {
  for (const measure::BlockFrame& frame : input.frames) {
    if (input.shapes.empty()) {  // boxes alone: their pairs have no kind
      grade::PairGroup& all = groups_.emplace_back().emplace_back();
      for (const IndexPair& pair : frame.truth) {
        all.first.push_back(pair.a);
        all.second.push_back(pair.b);
      }
    } else {
      groups_.push_back(grade::group_by_kind(frame.truth, input.shapes, input.shape_of));
    }
    starts_.push_back(starts_.back() + frame.truth.size());
  }
}

std::vector<std::uint32_t> ScenePairs::bodies(std::size_t frame) const {
  std::vector<std::uint32_t> bodies;
  for (const grade::PairGroup& group : groups_[frame]) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      bodies.insert(bodies.end(), {group.first[i], group.second[i]});
    }
  }
  return bodies;
}

std::vector<Outcome> ScenePairs::solve(NarrowPhase& narrow, const NarrowPhaseEntry& entry,
                                       Task task, std::size_t frame) const {
  std::vector<Outcome> outcomes(start(frame + 1) - start(frame));
  std::size_t first = 0;
  for (const grade::PairGroup& group : groups_[frame]) {
    const std::span part = std::span(outcomes).subspan(first, group.size());
    first += group.size();
    if (!offers(entry, group.kind_a, group.kind_b, task)) continue;
    narrow.solve(task, group.batch(input_->shape_of, input_->frames[frame].poses, 0, group.size()),
                 part);
  }
  return outcomes;
}

template <class Number, class Take>
std::vector<Number> ScenePairs::ask(const NarrowPhaseEntry& entry, Task task, double time_limit,
                                    Number lost, const Take& take) const {
  process::SharedArray<Number> numbers(all());
  std::ranges::fill(numbers.span(), lost);
  if (input_->shapes.empty()) return std::vector<Number>(all(), lost);
  NarrowPhaseSettings settings;
  if (!offers(entry, settings.scalar)) settings.scalar = Precision::float32;
  process::isolate(frames(), {.item_seconds = time_limit, .failures = 3},
                   [&]() -> process::ItemWork {
                     const std::shared_ptr<NarrowPhase> narrow = entry.make(settings);
                     narrow->bind(input_->shapes);
                     return [&, narrow](std::size_t frame) {
                       const std::vector<Outcome> outcomes = solve(*narrow, entry, task, frame);
                       for (std::size_t i = 0; i < outcomes.size(); ++i) {
                         numbers[start(frame) + i] = take(outcomes[i]);
                       }
                     };
                   });
  return {numbers.span().begin(), numbers.span().end()};
}

std::vector<std::uint8_t> ScenePairs::verdicts(const NarrowPhaseEntry& entry,
                                               double time_limit) const {
  constexpr auto unknown = static_cast<std::uint8_t>(Answer::unknown);
  return ask(entry, Task::intersect, time_limit, unknown, [](const Outcome& outcome) {
    return grade::stands_by(outcome) ? static_cast<std::uint8_t>(outcome.answer) : unknown;
  });
}

std::vector<double> ScenePairs::distances(const NarrowPhaseEntry& entry, double time_limit) const {
  constexpr double none = Outcome::none;
  const auto of = [](const Outcome& outcome) {
    if (!grade::stands_by(outcome)) return none;
    return outcome.answer == Answer::touching ? 0.0 : outcome.distance;
  };
  std::vector<double> found = ask(entry, Task::distance, time_limit, none, of);
  const std::vector<double> depths = ask(entry, Task::penetration, time_limit, none, of);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isnan(found[i])) found[i] = depths[i];
  }
  return found;
}

}  // namespace touchstone::report
