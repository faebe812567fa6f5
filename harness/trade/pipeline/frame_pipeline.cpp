// The stages of a configuration's frame.
#include "harness/trade/pipeline/frame_pipeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/base/clock.h"
#include "harness/measure/narrow_choice.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {
namespace {

constexpr std::size_t queries_a_piece = 256;
// The number of pairs in a task, for bodies with many parts.
constexpr std::size_t pairs_a_task = 32;
constexpr std::size_t whole_pairs_a_task = 8;

double& of(StageSeconds& seconds, Stage stage) { return seconds[static_cast<std::size_t>(stage)]; }

}  // namespace

FramePipeline::FramePipeline(const SceneFrames& frames, const StandIns& stand_ins,
                             const Configuration& configuration, Task task, Executor& executor)
    : frames_(&frames),
      stand_ins_(&stand_ins),
      configuration_(&configuration),
      task_(task),
      executor_(&executor),
      boxes_(frames, stand_ins, configuration.boxes, executor) {
  if (configuration.broad != nullptr) broad_ = configuration.broad->make(executor);
  counters_.hulls_built = stand_ins.hulls;
  // Only the narrow phases of the chain that take some pair of the scene are made.
  std::vector<std::size_t> place(configuration.narrow.size(), configuration.narrow.size());
  for (const auto& [a, b] : stand_ins.kind_pairs) {
    for (std::size_t i = 0; i < configuration.narrow.size(); ++i) {
      const NarrowPhaseEntry& entry = *configuration.narrow[i];
      if (!offers(entry, a, b, task)) continue;
      if (place[i] == configuration.narrow.size()) {
        place[i] = narrow_.size();
        auto& instances = narrow_.emplace_back();
        for (int worker = 0; worker < executor.width(); ++worker) {
          instances.push_back(entry.make(configuration.settings));
          instances.back()->bind(stand_ins.shapes);
          counters_.shapes_bound += static_cast<std::int64_t>(stand_ins.shapes.size());
        }
      }
      takes_[grade::PairGrouping::index(a, b)] = static_cast<std::uint8_t>(place[i]);
      break;
    }
  }
  if (configuration.concave != nullptr) {
    bodies_ = whole_bodies(frames, stand_ins, configuration);
    const measure::NarrowChoice choice =
        measure::concave_choices(
            std::array{configuration.concave},
            std::array{registry::find<MidPhaseEntry>(measure::usual_mid_phase)},
            std::array{configuration.settings.scalar})
            .at(0);
    for (int worker = 0; worker < executor.width(); ++worker) {
      concave_.push_back(choice.make_concave(bodies_));
      counters_.shapes_bound += static_cast<std::int64_t>(bodies_.size());
    }
    found_.resize(concave_.size());
  }
  if (!stand_ins.plain) part_poses_.resize(stand_ins.shape_of.size());
  if (!stand_ins.single) placed_at_.assign(stand_ins.shape_of.size(), 0);
}

// Prepares boxes, and the poses of bodies of one part; bodies of many parts are placed when needed.
void FramePipeline::prepare(std::size_t frame, bool anew) {
  frame_ = frame;
  if (broad_ != nullptr) {
    if (anew) {
      boxes_.start(frame);
    } else {
      boxes_.advance(frame);
    }
  }
  if (stand_ins_->plain) return;
  const auto one_part = [&](std::uint32_t body) {
    const StandIn& stand_in = *stand_ins_->of[body];
    if (stand_in.parts.size() != 1) return;
    part_poses_[stand_ins_->first[body]] =
        placed(frames_->frames[frame].poses[body], stand_in.parts[0].pose);
  };
  if (anew) {
    std::ranges::fill(placed_at_, 0U);
    for (std::uint32_t body = 0; body < stand_ins_->of.size(); ++body) one_part(body);
  } else {
    for (const std::uint32_t body : frames_->movers) one_part(body);
  }
}

void FramePipeline::find_pairs(bool anew) {
  if (broad_ == nullptr) {
    pairs_ = frames_->scene->pairs;
    return;
  }
  base::Stopwatch watch;
  const bool changed = anew || boxes_.changed();
  if (anew) {
    broad_->build(boxes_.boxes());
    ++counters_.builds;
  } else if (changed) {
    broad_->update(boxes_.change());
    ++counters_.updates;
  }
  of(seconds_, Stage::update) = watch.seconds();
  watch.restart();
  // If no box is new, no pair is new.
  if (changed) {
    if (broad_->find_pairs(sink_) != Status::ok) {
      throw std::runtime_error("the broad phase gave up: its store was full");
    }
    ++counters_.searches;
  }
  of(seconds_, Stage::find_pairs) = watch.seconds();
  if (!changed) return;
  pairs_.clear();
  for (const PairBuffer& chunk : sink_.chunks()) {
    pairs_.insert(pairs_.end(), chunk.pairs().begin(), chunk.pairs().end());
  }
  frames_->scene->filter.apply(pairs_);
}

void FramePipeline::append_parts(const IndexPair& pair, std::vector<PartPair>& found) const {
  const std::vector<Pose>& poses = frames_->frames[frame_].poses;
  const PartTree &a = stand_ins_->of[pair.a]->tree, &b = stand_ins_->of[pair.b]->tree;
  if (task_ == Task::distance) {
    nearest_parts(a, poses[pair.a], b, poses[pair.b], found);
  } else {
    meeting_parts(a, poses[pair.a], b, poses[pair.b], found);
  }
}

void FramePipeline::place(std::uint32_t body, std::uint32_t part) {
  const StandIn& stand_in = *stand_ins_->of[body];
  if (stand_in.parts.size() == 1) return;
  const bool moves = frames_->moves[body] != 0;
  const auto stamp = static_cast<std::uint32_t>(frame_ + 1);
  std::uint32_t& at = placed_at_[part];
  if (at == stamp || (at != 0 && !moves)) return;
  at = stamp;
  part_poses_[part] = placed(frames_->frames[frame_].poses[body],
                             stand_in.parts[part - stand_ins_->first[body]].pose);
}

void FramePipeline::split_into_parts() {
  const base::Stopwatch watch;
  asked_.clear();
  reduced_ = false;
  for (const IndexPair& pair : pairs_) {
    // Frame 0 settles the pairs of two bodies that never move.
    if (frame_ > 0 && frames_->moves[pair.a] == 0 && frames_->moves[pair.b] == 0) {
      ++counters_.settled;
    } else {
      asked_.push_back(pair);
    }
  }
  counters_.pairs += static_cast<std::int64_t>(asked_.size());
  batches_.clear();
  for (std::vector<std::uint32_t>& owners : owners_) owners.clear();
  if (!narrow_.empty()) {
    const auto add = [&](std::uint32_t part_a, std::uint32_t part_b, std::size_t owner) {
      const auto kind = [&](std::uint32_t part) {
        return stand_ins_->shapes[stand_ins_->shape_of[part]].kind;
      };
      const std::size_t batch = batches_.add(part_a, kind(part_a), part_b, kind(part_b));
      owners_[batch].push_back(static_cast<std::uint32_t>(owner));
    };
    const std::vector<std::uint32_t>& first = stand_ins_->first;
    if (stand_ins_->single) {
      for (std::size_t i = 0; i < asked_.size(); ++i) {
        add(first[asked_[i].a], first[asked_[i].b], i);
      }
    } else {
      const std::size_t tasks = (asked_.size() + pairs_a_task - 1) / pairs_a_task;
      if (part_pairs_.size() < tasks) part_pairs_.resize(tasks);
      std::vector<std::uint32_t> ends(asked_.size());
      executor_->run(tasks, [&](std::size_t task, int) {
        std::vector<PartPair>& found = part_pairs_[task];
        found.clear();
        const std::size_t end = std::min(asked_.size(), (task + 1) * pairs_a_task);
        for (std::size_t i = task * pairs_a_task; i < end; ++i) {
          append_parts(asked_[i], found);
          ends[i] = static_cast<std::uint32_t>(found.size());
        }
      });
      for (std::size_t i = 0; i < asked_.size(); ++i) {
        const std::vector<PartPair>& found = part_pairs_[i / pairs_a_task];
        const auto [a, b] = asked_[i];
        for (std::size_t k = i % pairs_a_task == 0 ? 0 : ends[i - 1]; k < ends[i]; ++k) {
          const std::uint32_t part_a = first[a] + found[k].first;
          const std::uint32_t part_b = first[b] + found[k].second;
          place(a, part_a);
          place(b, part_b);
          add(part_a, part_b, i);
        }
      }
    }
  }
  of(seconds_, Stage::parts) = watch.seconds();
}

void FramePipeline::solve() {
  if (!concave_.empty()) return solve_whole();
  const base::Stopwatch watch;
  pieces_.clear();
  std::size_t total = 0;
  const auto batches = batches_.groups();
  for (std::size_t k = 0; k < batches.size(); ++k) {
    for (std::size_t begin = 0; begin < batches[k].size(); begin += queries_a_piece) {
      const std::size_t end = std::min(batches[k].size(), begin + queries_a_piece);
      pieces_.push_back({k, begin, end, total});
      total += end - begin;
    }
  }
  if (counts_witnesses_) outcomes_.clear();
  outcomes_.resize(total);
  const std::span<const Pose> poses =
      stand_ins_->plain ? std::span<const Pose>(frames_->frames[frame_].poses) : part_poses_;
  executor_->run(pieces_.size(), [&](std::size_t i, int worker) {
    const Piece& piece = pieces_[i];
    const std::span<Outcome> outcomes =
        std::span(outcomes_).subspan(piece.outcome, piece.end - piece.begin);
    // solve() does not write numbers that the task does not ask for.
    if (task_ != Task::intersect) {
      for (Outcome& outcome : outcomes) outcome.distance = Outcome::none;
    }
    narrow_[takes_[piece.batch]][static_cast<std::size_t>(worker)]->solve(
        task_, batches[piece.batch].batch(stand_ins_->shape_of, poses, piece.begin, piece.end),
        outcomes);
  });
  // Bodies of several parts get their answer here; with one part the outcome is the answer.
  if (!stand_ins_->single && !narrow_.empty()) reduce();
  of(seconds_, Stage::narrow) = watch.seconds();
  counters_.queries += static_cast<std::int64_t>(total);
  if (!counts_witnesses_) return;
  counters_.witnesses += std::ranges::count_if(outcomes_, [](const Outcome& outcome) {
    return std::isfinite(outcome.witness_a.x()) || std::isfinite(outcome.witness_b.x());
  });
}

// Asks the concave phase about pairs of bodies, whose parts it finds itself.
void FramePipeline::solve_whole() {
  const base::Stopwatch watch;
  const ConcaveTask task = task_ == Task::distance ? ConcaveTask::distance : ConcaveTask::intersect;
  const std::vector<Pose>& poses = frames_->frames[frame_].poses;
  answers_.resize(asked_.size());
  const std::size_t tasks = (asked_.size() + whole_pairs_a_task - 1) / whole_pairs_a_task;
  executor_->run(tasks, [&](std::size_t number, int worker) {
    const auto own = static_cast<std::size_t>(worker);
    const std::size_t end = std::min(asked_.size(), (number + 1) * whole_pairs_a_task);
    for (std::size_t i = number * whole_pairs_a_task; i < end; ++i) {
      const auto [a, b] = asked_[i];
      Outcome outcome;
      found_[own].clear();
      concave_[own]->solve(task, {frames_->scene->bodies[a].shape, poses[a]},
                           {frames_->scene->bodies[b].shape, poses[b]}, outcome, found_[own]);
      answers_[i] = {asked_[i], outcome.answer, outcome.status, outcome.distance, 0};
    }
  });
  reduced_ = true;
  of(seconds_, Stage::narrow) = watch.seconds();
  counters_.queries += static_cast<std::int64_t>(asked_.size());
}

void FramePipeline::reduce() {
  reduced_ = true;
  answers_.resize(asked_.size());
  const bool asks_nobody = narrow_.empty();
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    // If no pair of parts could meet, the bodies are apart.
    answers_[i] = {asked_[i], asks_nobody ? Answer::overlapping : Answer::separated, Status::ok,
                   Outcome::none, 0};
  }
  for (const Piece& piece : pieces_) {
    for (std::size_t i = piece.begin; i < piece.end; ++i) {
      const Outcome& outcome = outcomes_[piece.outcome + i - piece.begin];
      PairAnswer& answer = answers_[owners_[piece.batch][i]];
      // The condition is true for a first number too, which is compared with none (NaN).
      if (std::isfinite(outcome.distance) && !(answer.distance <= outcome.distance)) {
        answer.distance = outcome.distance;
      }
      if (grade::is_contact(answer.answer)) continue;
      if (grade::is_contact(outcome.answer) || outcome.answer == Answer::unknown) {
        answer.answer = outcome.answer;
        answer.status = outcome.status;
        if (grade::is_within_resolution(outcome)) answer.upper = outcome.upper;
      }
    }
  }
}

void FramePipeline::start(std::size_t frame) {
  seconds_ = {};
  const base::Stopwatch watch;
  prepare(frame, true);
  of(seconds_, Stage::boxes) = watch.seconds();
  find_pairs(true);
  split_into_parts();
  solve();
}

void FramePipeline::advance() {
  seconds_ = {};
  const base::Stopwatch watch;
  prepare(frame_ + 1, false);
  of(seconds_, Stage::boxes) = watch.seconds();
  find_pairs(false);
  split_into_parts();
  solve();
}

void FramePipeline::pass(std::size_t frame) {
  seconds_ = {};
  prepare(frame, true);
  find_pairs(true);
}

std::span<const PairAnswer> FramePipeline::answers() {
  if (!reduced_) reduce();
  return answers_;
}

PipelineCounters FramePipeline::counters() const {
  PipelineCounters counters = counters_;
  counters.boxes = boxes_.computed();
  return counters;
}

}  // namespace touchstone::trade
