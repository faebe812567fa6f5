// Plays steps with narrow phases.
#include "harness/measure/motion.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "algorithms/core/bounds.h"
#include "algorithms/core/executor/parallel_blocks.h"
#include "harness/base/error.h"
#include "harness/base/reproducible_math.h"
#include "harness/grade/grade.h"
#include "harness/grade/pair_groups.h"

namespace touchstone::measure {
namespace {

constexpr std::size_t pairs_a_task = 256;

void sort_once(std::vector<IndexPair>& pairs) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

DiscreteSteps::DiscreteSteps(const MotionInput& input, DiscreteChoice choice, Executor& executor)
    : input_(&input),
      choice_(std::move(choice)),
      executor_(&executor),
      broad_(choice_.broad->make(executor)),
      poses_(input.bodies()),
      starts_(input.steps.size()) {
  for (const NarrowPhaseEntry* entry : choice_.narrow) {
    std::vector<std::unique_ptr<NarrowPhase>>& instances = narrow_.emplace_back();
    for (int worker = 0; worker < executor.width(); ++worker) {
      instances.push_back(entry->make(choice_.settings));
      instances.back()->bind(input.shapes);
    }
  }
  for (std::uint32_t body = 0; body < input.bodies(); ++body) {
    const auto moves = [body](const scene::MotionStep& step) {
      return step.motions[body].turns() || !step.motions[body].displacement.isZero(0);
    };
    if (std::ranges::any_of(input.steps, moves)) movers_.push_back(body);
  }
  for (std::vector<Aabb>& boxes : boxes_) boxes.resize(input.bodies());
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    place(input.steps[i], 0);
    search(true);
    look(starts_[i]);
    sort_once(starts_[i].hits);
  }
  steps_ = starts_;
}

void DiscreteSteps::place(const scene::MotionStep& step, double time) {
  current_ = 1 - current_;
  std::vector<Aabb>& boxes = boxes_[current_];
  for_each_block(*executor_, poses_.size(), bodies_a_block,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     const Motion& motion = step.motions[i];
                     poses_[i] = step.poses[i];
                     poses_[i].translation += time * motion.displacement;
                     if (motion.turns()) {
                       poses_[i].rotation =
                           base::product(base::rotation_over(motion.rotation_vector, time),
                                         step.poses[i].rotation);
                     }
                     boxes[i] = tight_box(input_->shapes[input_->shape_of[i]], poses_[i]);
                   }
                 });
  if (!input_->has_halfspaces()) return;
  std::vector<MovingBox> still;
  std::vector<Aabb> swept;
  still.reserve(boxes.size());
  swept.reserve(boxes.size());
  for (const Aabb& box : boxes) {
    still.push_back({box, {0, 0, 0}, 0});
    swept.push_back(swept_box(still.back()));
  }
  cut_halfspaces(*input_, still, swept);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = still[i].box;
}

void DiscreteSteps::search(bool is_first) {
  if (is_first) {
    broad_->build(boxes_[current_]);
  } else {
    std::vector<std::uint32_t> moved;
    for (const std::uint32_t body : movers_) {
      if (boxes_[0][body] != boxes_[1][body]) moved.push_back(body);
    }
    // The cut of a half-space follows the others.
    for (std::uint32_t body = 0; body < input_->bodies(); ++body) {
      if (input_->kind_of(body) == ShapeKind::halfspace &&
          !std::ranges::binary_search(movers_, body) && boxes_[0][body] != boxes_[1][body])
        moved.push_back(body);
    }
    std::ranges::sort(moved);
    broad_->update({boxes_[current_], moved, {}, {}});
  }
  if (broad_->find_pairs(found_) != Status::ok) {
    throw base::InputError("the broad phase '" + choice_.broad->info.name +
                           "' found not all pairs; expected one that does");
  }
}

void DiscreteSteps::look(StepAnswer& answer) {
  std::vector<IndexPair> asked = found_.gather();
  input_->filter.apply(asked);
  const std::vector<grade::PairGroup> groups =
      grade::group_by_kind(asked, input_->shapes, input_->shape_of);
  for (const grade::PairGroup& group : groups) {
    answer.pairs += group.size();
    const auto taker = std::ranges::find_if(choice_.narrow, [&](const NarrowPhaseEntry* entry) {
      return offers(*entry, group.kind_a, group.kind_b, Task::intersect);
    });
    std::vector<Outcome> outcomes(group.size());
    if (taker != choice_.narrow.end()) {
      auto& instances = narrow_[static_cast<std::size_t>(taker - choice_.narrow.begin())];
      const auto work = [&](std::size_t block, int worker) {
        const std::size_t first = block * pairs_a_task;
        const std::size_t last = std::min(first + pairs_a_task, group.size());
        instances[static_cast<std::size_t>(worker)]->solve(
            Task::intersect, group.batch(input_->shape_of, poses_, first, last),
            std::span(outcomes).subspan(first, last - first));
      };
      executor_->run(block_count(group.size(), pairs_a_task), std::cref(work));
    }
    for (std::size_t i = 0; i < group.size(); ++i) {
      const IndexPair pair = {std::min(group.first[i], group.second[i]),
                              std::max(group.first[i], group.second[i])};
      if (grade::is_contact(outcomes[i].answer)) answer.hits.push_back(pair);
      if (outcomes[i].answer == Answer::unknown) answer.unknown.push_back(pair);
    }
  }
}

void DiscreteSteps::play() {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    StepAnswer& answer = steps_[i];
    answer.pairs = 0;
    answer.hits = starts_[i].hits;
    answer.unknown.clear();
    for (int k = 1; k <= choice_.substeps; ++k) {
      place(input_->steps[i], static_cast<double>(k) / choice_.substeps);
      search(i == 0 && k == 1);
      look(answer);
    }
    sort_once(answer.hits);
  }
}

std::vector<StepAnswer> DiscreteSteps::answers() const {
  std::vector<StepAnswer> answers = steps_;
  for (StepAnswer& answer : answers) {
    sort_once(answer.unknown);
    std::vector<IndexPair> open;  // what was seen in touch at some time is known
    std::ranges::set_difference(answer.unknown, answer.hits, std::back_inserter(open));
    answer.unknown = std::move(open);
  }
  return answers;
}

}  // namespace touchstone::measure
