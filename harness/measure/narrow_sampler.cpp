// Solves the pairs of frames with a narrow phase, cold or warm, and times it. Warm pairs are in the
// order of slot and task.
#include "harness/measure/narrow_sampler.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "harness/base/clock.h"
#include "harness/record/raw_row.h"

namespace touchstone::measure {
namespace {

std::uint64_t key(const grade::PairGroup& group, std::size_t i) {
  const auto [low, high] = std::minmax(group.first[i], group.second[i]);
  return (std::uint64_t{low} << 32) + high;
}

}  // namespace

WarmPairs::WarmPairs(const NarrowSet& set, std::size_t slots_a_task) {
  std::vector<std::uint64_t> keys;
  keys.reserve(set.pairs());
  for (const grade::PairGroup& group : set.frames) {
    for (std::size_t i = 0; i < group.size(); ++i) keys.push_back(key(group, i));
  }
  std::ranges::sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  slots_ = keys.size();
  tasks_ = (slots_ + slots_a_task - 1) / slots_a_task;

  for (const grade::PairGroup& group : set.frames) {
    Frame& frame = frames_.emplace_back();
    frame.pairs.kind_a = group.kind_a;
    frame.pairs.kind_b = group.kind_b;
    std::vector<std::uint32_t> slots(group.size()), order(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
      slots[i] =
          static_cast<std::uint32_t>(std::ranges::lower_bound(keys, key(group, i)) - keys.begin());
    }
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return slots[i] / slots_a_task; });
    frame.begins.push_back(0);
    for (const std::uint32_t i : order) {
      while (frame.begins.size() <= slots[i] / slots_a_task) {
        frame.begins.push_back(frame.slots.size());
      }
      frame.pairs.first.push_back(group.first[i]);
      frame.pairs.second.push_back(group.second[i]);
      frame.slots.push_back(slots[i]);
    }
    frame.begins.resize(tasks_ + 1, frame.slots.size());
    if (!std::ranges::is_sorted(order)) frame.places = std::move(order);
  }
}

namespace {

// A pair of bodies of many parts takes as long as hundreds of convex ones.
constexpr std::size_t concave_pairs_a_task = 8;

void count(std::int64_t& sum, std::int32_t value) {
  if (value >= 0) sum = std::max<std::int64_t>(sum, 0) + value;
}

}  // namespace

NarrowSampler::NarrowSampler(const NarrowChoice& choice, const BlockInput& input,
                             std::span<const NarrowSet> sets, Executor& executor)
    : input_(&input),
      sets_(sets),
      executor_(&executor),
      starts_warm_(choice.warm),
      batch_(static_cast<std::size_t>(choice.batch)),
      pairs_a_task_(choice.concave != nullptr ? concave_pairs_a_task : usual_batch),
      found_(static_cast<std::size_t>(executor.width())),
      warm_(sets.size()) {
  for (int worker = 0; worker < executor.width(); ++worker) {
    if (choice.concave != nullptr) {
      concave_.push_back(choice.make_concave(input.bodies));
      continue;
    }
    instances_.push_back(choice.entry->make(choice.settings));
    instances_.back()->bind(input.shapes);
  }
}

std::vector<std::size_t> NarrowSampler::frames_of(const SampleRequest& request) const {
  const std::size_t all = input_->frames.size();
  const std::size_t first = request.skips_first ? 1 : 0;
  std::vector<std::size_t> frames;
  for (std::uint32_t i = 0; i < request.frames; ++i) {
    frames.push_back(first + (request.frame - first + i) % (all - first));
  }
  return frames;
}

std::vector<NarrowSampler::Chunk> NarrowSampler::cut(const NarrowSet& set,
                                                     std::span<const std::size_t> frames) const {
  std::vector<Chunk> chunks;
  std::size_t total = 0;
  for (const std::size_t frame : frames) {
    const grade::PairGroup& group = set.frames[frame];
    for (std::size_t begin = 0; begin < group.size(); begin += pairs_a_task_) {
      const std::size_t end = std::min(begin + pairs_a_task_, group.size());
      chunks.push_back(
          {group.batch(input_->shape_of, input_->frames[frame].poses, begin, end), total + begin});
    }
    total += group.size();
  }
  return chunks;
}

std::vector<std::size_t> NarrowSampler::tasks_of(std::span<const Chunk> chunks) const {
  std::vector<std::size_t> tasks = {0};
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    pairs += chunks[i].batch.size();
    if (pairs < pairs_a_task_ && i + 1 < chunks.size()) continue;
    tasks.push_back(i + 1);
    pairs = 0;
  }
  return tasks;
}

void NarrowSampler::solve(record::QueryTask task, const PairBatch& batch, std::size_t first,
                          int worker) {
  if (concave_.empty()) {
    solve(*record::narrow_task(task), batch, std::span(outcomes_).subspan(first, batch.size()),
          worker);
  } else {
    solve_concave(*record::concave_task(task), batch, first, worker);
  }
}

void NarrowSampler::solve_concave(ConcaveTask task, const PairBatch& batch, std::size_t first,
                                  int worker) {
  const auto own = static_cast<std::size_t>(worker);
  std::vector<IndexPair>& found = found_[own];
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const std::uint32_t a = batch.pairs.first[i], b = batch.pairs.second[i];
    found.clear();
    concave_[own]->solve(task, {batch.pairs.shape_of[a], batch.pairs.poses[a]},
                         {batch.pairs.shape_of[b], batch.pairs.poses[b]}, outcomes_[first + i],
                         found);
    // The fingerprint takes a nanosecond a pair, and keeping the pairs would take more.
    if (!lists_.empty()) lists_[first + i] = grade::part_list(found);
  }
}

void NarrowSampler::solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes,
                          int worker) {
  NarrowPhase& narrow = *instances_[static_cast<std::size_t>(worker)];
  if (batch_ == 1) {
    for (std::size_t i = 0; i < batch.size(); ++i) narrow.solve_alone(task, batch, i, outcomes[i]);
    return;
  }
  if (batch.size() <= batch_) {
    narrow.solve(task, batch, outcomes);
    return;
  }
  for (std::size_t begin = 0; begin < batch.size(); begin += batch_) {
    const std::size_t count = std::min(batch_, batch.size() - begin);
    narrow.solve(task, batch.part(begin, count), outcomes.subspan(begin, count));
  }
}

double NarrowSampler::solve_cold(const NarrowSet& set, std::span<const std::size_t> frames) {
  const std::vector<Chunk> chunks = cut(set, frames);
  const std::vector<std::size_t> tasks = tasks_of(chunks);
  // The capture is by reference, so that std::function does not allocate.
  const auto work = [&](std::size_t task, int worker) {
    for (std::size_t i = tasks[task]; i < tasks[task + 1]; ++i) {
      solve(set.task, chunks[i].batch, chunks[i].first, worker);
    }
  };
  const base::Stopwatch watch;
  executor_->run(tasks.size() - 1, std::cref(work));
  return watch.seconds();
}

NarrowSampler::Warm& NarrowSampler::warm(std::uint32_t set) {
  std::optional<Warm>& warm = warm_[set];
  if (!warm) {
    warm.emplace(Warm{WarmPairs(sets_[set], pairs_a_task_), {}});
    warm->memory.resize(warm->pairs.slots());
  }
  return *warm;
}

PairBatch NarrowSampler::batch(Warm& warm, std::size_t frame, std::size_t begin,
                               std::size_t end) const {
  const WarmPairs::Frame& pairs = warm.pairs.frame(frame);
  PairBatch batch = pairs.pairs.batch(input_->shape_of, input_->frames[frame].poses, begin, end);
  batch.memory = warm.memory;
  batch.memory_of = std::span(pairs.slots).subspan(begin, end - begin);
  return batch;
}

double NarrowSampler::play(Warm& warm, Task task, std::span<const std::size_t> frames,
                           std::span<Outcome> outcomes) {
  std::vector<std::size_t> firsts;
  std::size_t total = 0;
  for (const std::size_t frame : frames) {
    firsts.push_back(total);
    total += warm.pairs.frame(frame).slots.size();
  }
  const auto work = [&](std::size_t part, int worker) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const WarmPairs::Frame& frame = warm.pairs.frame(frames[i]);
      const std::size_t begin = frame.begins[part], end = frame.begins[part + 1];
      if (begin == end) continue;
      solve(task, batch(warm, frames[i], begin, end),
            outcomes.subspan(firsts[i] + begin, end - begin), worker);
    }
  };
  const base::Stopwatch watch;
  executor_->run(warm.pairs.tasks(), std::cref(work));
  const double seconds = watch.seconds();
  warm.at = static_cast<std::ptrdiff_t>(frames.back());
  // Restores the order of the set.
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<std::uint32_t>& places = warm.pairs.frame(frames[i]).places;
    if (places.empty()) continue;
    const std::span<Outcome> own = outcomes.subspan(firsts[i], places.size());
    const std::vector<Outcome> solved(own.begin(), own.end());
    for (std::size_t k = 0; k < places.size(); ++k) own[places[k]] = solved[k];
  }
  return seconds;
}

void NarrowSampler::play_up_to(Warm& warm, Task task, std::size_t frame) {
  if (frame > 0 && warm.at == static_cast<std::ptrdiff_t>(frame) - 1) return;
  std::ranges::fill(warm.memory, PairMemory{});
  warm.at = -1;
  std::vector<Outcome> untold;
  for (std::size_t before = 0; before < frame; ++before) {
    untold.assign(warm.pairs.frame(before).slots.size(), Outcome{});
    play(warm, task, std::array{before}, untold);
  }
}

double NarrowSampler::solve_warm(const SampleRequest& request,
                                 std::span<const std::size_t> frames) {
  const Task task = *record::narrow_task(sets_[request.set].task);
  Warm& kept = warm(request.set);
  double seconds = 0;
  std::size_t first = 0;
  while (!frames.empty()) {
    // A run of frames ends where the scene begins again.
    std::size_t row = 1, pairs = kept.pairs.frame(frames[0]).slots.size();
    for (; row < frames.size() && frames[row] == frames[row - 1] + 1; ++row) {
      pairs += kept.pairs.frame(frames[row]).slots.size();
    }
    play_up_to(kept, task, frames[0]);
    seconds += play(kept, task, frames.subspan(0, row), std::span(outcomes_).subspan(first, pairs));
    first += pairs;
    frames = frames.subspan(row);
  }
  return seconds;
}

SampleReply NarrowSampler::sample(const SampleRequest& request) {
  const NarrowSet& set = sets_[request.set];
  const std::vector<std::size_t> frames = frames_of(request);
  std::size_t total = 0;
  for (const std::size_t frame : frames) total += set.frames[frame].size();
  outcomes_.assign(total, Outcome{});
  lists_.assign(set.task == record::QueryTask::contacts ? total : 0, grade::PartList{});
  SampleReply reply;
  reply.durations.add(to_string(record::Phase::narrow),
                      starts_warm_ ? solve_warm(request, frames) : solve_cold(set, frames));
  reply.pairs = static_cast<std::int64_t>(outcomes_.size());
  reply.contacts = 0;
  for (const Outcome& outcome : outcomes_) {
    reply.contacts +=
        outcome.answer == Answer::touching || outcome.answer == Answer::overlapping ? 1 : 0;
    count(reply.iterations, outcome.iterations);
    count(reply.support_calls, outcome.support_calls);
  }
  if (!lists_.empty()) reply.part_pairs = 0;
  for (const grade::PartList& list : lists_) {
    reply.part_pairs += static_cast<std::int64_t>(list.count);
  }
  std::size_t first = 0;
  for (const std::size_t frame : frames) {
    const grade::PairGroup& group = set.frames[frame];
    reply.outcome_hash += list_hash(group, std::span(lists_).subspan(lists_.empty() ? 0 : first));
    reply.pair_hash += group_hash(group);
    reply.outcome_hash += outcome_hash(group, std::span(outcomes_).subspan(first, group.size()));
    first += group.size();
  }
  return reply;
}

Allocations NarrowSampler::count_allocations(const SampleRequest& request) {
  const std::size_t frame = request.frame;
  std::vector<Chunk> chunks = cut(sets_[request.set], std::array{frame});
  std::vector<PairMemory> before;
  if (starts_warm_) {
    Warm& kept = warm(request.set);
    before = kept.memory;
    chunks = {{batch(kept, frame, 0, outcomes_.size()), 0}};
  }
  const AllocationCount counted;
  for (const Chunk& chunk : chunks) {
    solve(sets_[request.set].task, chunk.batch, chunk.first, 0);
  }
  const Allocations allocations = counted.so_far();
  if (starts_warm_) warm(request.set).memory = std::move(before);
  return allocations;
}

}  // namespace touchstone::measure
