// Plays steps with casts.
#include "harness/measure/motion.h"

#include <algorithm>
#include <functional>
#include <new>
#include <ranges>
#include <span>
#include <utility>

#include "algorithms/core/executor/parallel_blocks.h"
#include "harness/base/error.h"

namespace touchstone::measure {
namespace {

// Pairs differ in what they cost, so that each worker gets several blocks, but none of a few pairs alone.
constexpr std::size_t blocks_a_worker = 16, fewest_pairs = 8, most_pairs = 64;

IndexPair in_order(std::uint32_t i, std::uint32_t j) {
  return i < j ? IndexPair{i, j} : IndexPair{j, i};
}

}  // namespace

ContinuousSteps::ContinuousSteps(const MotionInput& input, ContinuousChoice choice,
                                 Executor& executor)
    : input_(&input),
      choice_(std::move(choice)),
      executor_(&executor),
      moving_(*choice_.broad, executor, choice_.parts),
      boxes_(input.bodies()),
      swept_(input.bodies()),
      steps_(input.steps.size()) {
  for (const CastEntry* entry : choice_.casts) {
    std::vector<std::unique_ptr<Cast>>& instances = casts_.emplace_back();
    for (int worker = 0; worker < executor.width(); ++worker) {
      instances.push_back(entry->make(choice_.settings));
      instances.back()->bind(input.shapes);
    }
  }
}

void ContinuousSteps::place_boxes(const scene::MotionStep& step) {
  for_each_block(*executor_, boxes_.size(), bodies_a_block,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) {
                     // In place: a copy of numbers just written would wait for them.
                     new (&boxes_[i]) MovingBox(moving_box(input_->shapes[input_->shape_of[i]],
                                                           step.poses[i], step.motions[i]));
                     new (&swept_[i]) Aabb(swept_box(boxes_[i]));
                   }
                 });
  cut_halfspaces(*input_, boxes_, swept_);
}

void ContinuousSteps::group(const scene::MotionStep& motions, Step& step) {
  step.not_taken.clear();
  // Casts of straight motion take the pairs of a turning scene that do not turn.
  for (grade::PairGrouping& grouping : groups_) grouping.clear();
  for (const IndexPair& pair : pairs_) {
    const bool turns = motions.motions[pair.a].turns() || motions.motions[pair.b].turns();
    groups_[turns ? 0 : 1].add(pair.a, input_->kind_of(pair.a), pair.b, input_->kind_of(pair.b));
  }
  std::size_t batches = 0;
  // Pairs that turn take longest, and pairs of two hulls longer than most, so these go first: the
  // cheap ones, which are left for the end, even the workers out.
  for (const bool turns : {true, false}) {
    for (const grade::PairGroup& group : groups_[turns ? 0 : 1].groups() | std::views::reverse) {
      if (group.size() == 0) continue;
      const auto taker = std::ranges::find_if(choice_.casts, [&](const CastEntry* entry) {
        return offers(*entry, group.kind_a, group.kind_b, turns);
      });
      if (taker == choice_.casts.end()) {
        for (std::size_t i = 0; i < group.size(); ++i)
          step.not_taken.push_back(in_order(group.first[i], group.second[i]));
        continue;
      }
      if (batches == step.batches.size()) step.batches.emplace_back();
      Batch& batch = step.batches[batches++];
      batch.cast = static_cast<std::size_t>(taker - choice_.casts.begin());
      batch.outcomes.resize(group.size());
      batch.pairs = group;
    }
  }
  step.batches.resize(batches);
}

void ContinuousSteps::cast(const scene::MotionStep& motions, Step& step) {
  struct Piece {
    Batch* batch;
    std::size_t first, count;
  };
  std::vector<Piece> pieces;
  const auto blocks = blocks_a_worker * static_cast<std::size_t>(executor_->width());
  const std::size_t pairs_a_block = std::clamp(pairs_.size() / blocks, fewest_pairs, most_pairs);
  for (Batch& batch : step.batches) {
    // Even pieces: a few pairs left over would be worth no task.
    const std::size_t size = batch.pairs.size(), count = block_count(size, pairs_a_block);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t first = i * size / count;
      pieces.push_back({&batch, first, (i + 1) * size / count - first});
    }
  }
  const auto work = [&](std::size_t task, int worker) {
    const Piece& piece = pieces[task];
    const grade::PairGroup& group = piece.batch->pairs;
    const CastBatch batch = {group.kind_a,
                             group.kind_b,
                             {std::span(group.first).subspan(piece.first, piece.count),
                              std::span(group.second).subspan(piece.first, piece.count),
                              input_->shape_of, motions.poses},
                             motions.motions};
    casts_[piece.batch->cast][static_cast<std::size_t>(worker)]->solve(
        batch, std::span(piece.batch->outcomes).subspan(piece.first, piece.count));
  };
  executor_->run(pieces.size(), std::cref(work));
}

void ContinuousSteps::play() {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const scene::MotionStep& motions = input_->steps[i];
    place_boxes(motions);
    if (moving_.find_pairs(boxes_, swept_, pairs_) != Status::ok) {
      throw base::InputError("the broad phase '" + choice_.broad->info.name +
                             "' found not all pairs; expected one that does");
    }
    input_->filter.apply(pairs_);
    group(motions, steps_[i]);
    cast(motions, steps_[i]);
  }
}

std::vector<StepAnswer> ContinuousSteps::answers() const {
  std::vector<StepAnswer> answers;
  for (const Step& step : steps_) {
    StepAnswer& answer = answers.emplace_back();
    answer.unknown = step.not_taken;
    answer.pairs = step.not_taken.size();
    for (const Batch& batch : step.batches) {
      answer.pairs += batch.pairs.size();
      for (std::size_t i = 0; i < batch.pairs.size(); ++i) {
        const CastOutcome& outcome = batch.outcomes[i];
        const bool is_sure = outcome.status == Status::ok || outcome.status == Status::not_reported;
        const IndexPair pair = in_order(batch.pairs.first[i], batch.pairs.second[i]);
        if (!is_sure || outcome.answer == CastAnswer::unknown) {
          answer.unknown.push_back(pair);
        } else if (outcome.answer == CastAnswer::hit) {
          answer.hits.push_back(pair);
        } else {
          answer.misses.push_back(pair);
        }
      }
    }
    std::ranges::sort(answer.hits);
    std::ranges::sort(answer.misses);
    std::ranges::sort(answer.unknown);
  }
  return answers;
}

}  // namespace touchstone::measure
