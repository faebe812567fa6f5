// Asks algorithms about the pairs of a played scene, and broad phases for what they keep.
#include "harness/report/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "harness/grade/grade.h"
#include "harness/process/isolate.h"
#include "harness/report/packed_numbers.h"

namespace touchstone::report {

ScenePairs::ScenePairs(const measure::BlockInput& input) : input_(&input) {
  for (const measure::BlockFrame& frame : input.frames) {
    std::size_t asked = frame.truth.size();
    if (input.shapes.empty()) {  // boxes alone: their pairs have no kind
      grade::PairGroup& all = groups_.emplace_back().emplace_back();
      for (const IndexPair& pair : frame.truth) {
        all.first.push_back(pair.a);
        all.second.push_back(pair.b);
      }
    } else {
      std::vector<IndexPair> convex = frame.truth;
      input.filter.apply(convex);
      asked = convex.size();
      const auto concave = std::ranges::stable_partition(convex, [&](const IndexPair& pair) {
        return !input.is_concave(pair.a) && !input.is_concave(pair.b);
      });
      concave_.emplace_back(concave.begin(), concave.end());
      convex.erase(concave.begin(), concave.end());
      groups_.push_back(grade::group_by_kind(convex, input.shapes, input.shape_of));
    }
    concave_.resize(groups_.size());
    starts_.push_back(starts_.back() + asked);
  }
}

std::vector<std::uint32_t> ScenePairs::bodies(std::size_t frame) const {
  std::vector<std::uint32_t> bodies;
  for (const grade::PairGroup& group : groups_[frame]) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      bodies.insert(bodies.end(), {group.first[i], group.second[i]});
    }
  }
  for (const IndexPair& pair : concave_[frame]) bodies.insert(bodies.end(), {pair.a, pair.b});
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

std::vector<Outcome> ScenePairs::solve(ConcavePhase& phase, const ConcaveEntry& entry,
                                       ConcaveTask task, std::size_t frame) const {
  std::vector<Outcome> outcomes(start(frame + 1) - start(frame));
  std::size_t at = outcomes.size() - concave_[frame].size();
  std::vector<IndexPair> parts;
  const std::vector<Pose>& poses = input_->frames[frame].poses;
  for (const IndexPair& pair : concave_[frame]) {
    const std::uint32_t a = input_->shape_of[pair.a], b = input_->shape_of[pair.b];
    Outcome& outcome = outcomes[at++];
    if (entry.supports != nullptr && !entry.supports(input_->bodies[a], input_->bodies[b]))
      continue;
    parts.clear();
    phase.solve(task, {a, poses[pair.a]}, {b, poses[pair.b]}, outcome, parts);
  }
  return outcomes;
}

template <class Number, class Take>
std::vector<Number> ScenePairs::ask(const measure::NarrowChoice& choice, record::QueryTask task,
                                    double time_limit, Number lost, const Take& take) const {
  process::SharedArray<Number> numbers(all());
  std::ranges::fill(numbers.span(), lost);
  if (input_->shapes.empty()) return std::vector<Number>(all(), lost);
  process::isolate(
      frames(), {.item_seconds = time_limit, .failures = 3}, [&]() -> process::ItemWork {
        std::shared_ptr<NarrowPhase> narrow;
        std::shared_ptr<ConcavePhase> concave;
        if (choice.entry != nullptr) {
          narrow = choice.entry->make(choice.settings);
          narrow->bind(input_->shapes);
        } else {
          concave = choice.make_concave(input_->bodies);
        }
        return [&, narrow, concave](std::size_t frame) {
          const std::vector<Outcome> outcomes =
              narrow != nullptr
                  ? solve(*narrow, *choice.entry, *record::narrow_task(task), frame)
                  : solve(*concave, *choice.concave, *record::concave_task(task), frame);
          for (std::size_t i = 0; i < outcomes.size(); ++i) {
            numbers[start(frame) + i] = take(outcomes[i]);
          }
        };
      });
  return {numbers.span().begin(), numbers.span().end()};
}

std::vector<std::uint8_t> ScenePairs::verdicts(const measure::NarrowChoice& choice,
                                               double time_limit) const {
  constexpr auto unknown = static_cast<std::uint8_t>(Answer::unknown);
  return ask(choice, record::QueryTask::intersect, time_limit, unknown, [](const Outcome& outcome) {
    return grade::stands_by(outcome) ? static_cast<std::uint8_t>(outcome.answer) : unknown;
  });
}

std::vector<double> ScenePairs::distances(double time_limit) const {
  constexpr double none = Outcome::none;
  const auto of = [](const Outcome& outcome) {
    if (!grade::stands_by(outcome)) return none;
    return outcome.answer == Answer::touching ? 0.0 : outcome.distance;
  };
  const measure::NarrowChoice certified{.entry = registry::find<NarrowPhaseEntry>("certified"),
                                        .settings = {}};
  std::vector<double> found = ask(certified, record::QueryTask::distance, time_limit, none, of);
  const auto add = [&](const std::vector<double>& more) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (std::isnan(found[i])) found[i] = more[i];
    }
  };
  add(ask(certified, record::QueryTask::penetration, time_limit, none, of));
  if (input_->bodies.empty()) return found;
  const auto fused = measure::concave_choices(std::array{registry::find<ConcaveEntry>("fused")}, {},
                                              std::array{Precision::float64});
  add(ask(fused.at(0), record::QueryTask::distance, time_limit, none, of));
  return found;
}

namespace {

using files::OrderedJson;

OrderedJson structure_view(BroadPhase& broad, const measure::BlockInput& input, bool& shows) {
  OrderedJson frames = OrderedJson::array();
  for (const measure::BlockFrame& frame : input.frames) {
    if (frames.empty()) {
      broad.build(frame.boxes);
    } else {
      broad.update(frame.change());
    }
    // Some decide in the search what they keep.
    PairSink sink;
    broad.find_pairs(sink);
    std::vector<float> corners;
    std::vector<std::uint8_t> levels;
    for (const StructureBox& each : broad.structure()) {
      append(corners, each.box);
      levels.push_back(static_cast<std::uint8_t>(std::min(each.level, 255u)));
    }
    shows = shows || !levels.empty();
    frames.push_back({{"boxes", packed(corners)}, {"levels", packed(levels)}});
  }
  return frames;
}

}  // namespace

void append(std::vector<float>& numbers, const Aabb& box) {
  numbers.insert(numbers.end(), box.min.begin(), box.min.end());
  numbers.insert(numbers.end(), box.max.begin(), box.max.end());
}

OrderedJson structure_views(const measure::BlockInput& input,
                            const std::vector<const BroadPhaseEntry*>& broad) {
  Executor executor(1);
  OrderedJson views = OrderedJson::array();
  for (const BroadPhaseEntry* entry : broad) {
    bool shows = false;
    const std::unique_ptr<BroadPhase> algorithm = entry->make(executor);
    OrderedJson frames = structure_view(*algorithm, input, shows);
    if (shows) views.push_back({{"broad", entry->info.name}, {"frames", std::move(frames)}});
  }
  return views;
}

}  // namespace touchstone::report
