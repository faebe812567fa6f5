#include "harness/measure/sampler.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>

#include "harness/measure/outcome_hash.h"

namespace touchstone {
namespace {

// Pairs that one task of the executor answers: enough to hide the cost of handing it out, few
// enough to share a small group between two threads.
constexpr std::size_t pairs_a_task = 256;

void count(std::int64_t& sum, std::int32_t value) {
  if (value >= 0) sum = std::max<std::int64_t>(sum, 0) + value;
}

}  // namespace

BroadSampler::BroadSampler(const BroadPhaseEntry& entry, const BlockInput& input, bool rebuild,
                           Executor& executor)
    : input_(&input),
      rebuild_(rebuild || input.frames.size() == 1),
      algorithm_(entry.make(executor)) {}

void BroadSampler::prepare(std::size_t frame) {
  const BlockFrame& now = input_->frames[frame];
  if (is_built(frame)) {
    algorithm_->build(now.boxes);
  } else {
    algorithm_->update(now.change());
  }
}

void BroadSampler::step(std::size_t frame, SampleReply& reply) {
  const Stopwatch preparing;
  prepare(frame);
  reply.prepare += preparing.seconds();
  const Stopwatch finding;
  const Status status = algorithm_->find_pairs(sink_);
  reply.query += finding.seconds();
  if (status != Status::ok) reply.status = status;
  reply.pairs += static_cast<std::int64_t>(sink_.size());
  at_ = static_cast<std::ptrdiff_t>(frame);
}

// The least of some repetitions; none where nothing is converted.
double BroadSampler::time_conversion(std::size_t frame) {
  constexpr int repetitions = 3;
  const BlockFrame& now = input_->frames[frame];
  std::vector<Aabb> converted;
  if (is_built(frame)) {
    std::ranges::copy_if(now.boxes, std::back_inserter(converted),
                         [](const Aabb& box) { return !box.is_empty(); });
  } else {
    const FrameChange change = now.change();
    for (const std::uint32_t id : change.moved) converted.push_back(now.boxes[id]);
    for (const std::uint32_t id : change.inserted) converted.push_back(now.boxes[id]);
  }
  if (!algorithm_->convert(converted)) return Outcome::none;  // and makes room for them
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i) {
    const Stopwatch converting;
    algorithm_->convert(converted);
    least = std::min(least, converting.seconds());
  }
  return least;
}

void BroadSampler::play_up_to(std::size_t frame) {
  if (at_ == static_cast<std::ptrdiff_t>(frame) - 1) return;
  SampleReply untimed;
  untimed.prepare = 0;
  for (std::size_t before = 0; before < frame; ++before) step(before, untimed);
}

SampleReply BroadSampler::play(std::size_t frame) {
  SampleReply reply;
  reply.prepare = 0;
  if (!is_built(frame)) play_up_to(frame);
  step(frame, reply);
  reply.work = algorithm_->work();
  reply.convert = time_conversion(frame);
  for (const PairBuffer& chunk : sink_.chunks()) reply.pair_hash += pair_hash(chunk.pairs());
  return reply;
}

BroadSampler::FrameAllocations BroadSampler::count_allocations(std::size_t frame) {
  if (!is_built(frame)) play_up_to(frame);
  FrameAllocations allocations;
  {
    const AllocationCount count;
    prepare(frame);
    allocations.prepare = count.so_far();
  }
  {
    const AllocationCount count;
    algorithm_->find_pairs(sink_);
    allocations.query = count.so_far();
  }
  at_ = static_cast<std::ptrdiff_t>(frame);
  return allocations;
}

SampleReply BroadSampler::sample(const SampleRequest& request) {
  if (request.hashed) return play(request.frame);
  SampleReply untimed, reply;
  untimed.prepare = reply.prepare = 0;
  std::size_t frame = request.frame;
  if (!rebuild_) play_up_to(frame);
  for (std::uint32_t i = 0; i < request.frames; ++i) {
    if (frame == input_->frames.size()) frame = 0;
    if (frame == 0 && !rebuild_) step(frame++, untimed);
    step(frame++, reply);
  }
  return reply;
}

NarrowSampler::NarrowSampler(const NarrowChoice& choice, const BlockInput& input,
                             std::span<const NarrowSet> sets, Executor& executor)
    : input_(&input), sets_(sets), executor_(&executor) {
  for (int worker = 0; worker < executor.width(); ++worker) {
    instances_.push_back(choice.entry->make(choice.settings));
    instances_.back()->bind(input.shapes);
  }
}

template <class Visit>
void NarrowSampler::each_frame(const SampleRequest& request, const Visit& visit) const {
  for (std::uint32_t i = 0; i < request.frames; ++i) {
    visit((request.frame + i) % input_->frames.size());
  }
}

std::vector<NarrowSampler::Chunk> NarrowSampler::cut(const SampleRequest& request) {
  const NarrowSet& set = sets_[request.set];
  std::vector<Chunk> chunks;
  std::size_t total = 0;
  each_frame(request, [&](std::size_t frame) {
    const PairGroup& group = set.frames[frame];
    for (std::size_t begin = 0; begin < group.size(); begin += pairs_a_task) {
      const std::size_t end = std::min(begin + pairs_a_task, group.size());
      chunks.push_back(
          {group.batch(set.task, input_->shape_of, input_->frames[frame].poses, begin, end),
           total + begin});
    }
    total += group.size();
  });
  outcomes_.assign(total, Outcome{});
  return chunks;
}

std::vector<std::size_t> NarrowSampler::tasks_of(std::span<const Chunk> chunks) {
  std::vector<std::size_t> tasks = {0};
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    pairs += chunks[i].batch.size();
    if (pairs < pairs_a_task && i + 1 < chunks.size()) continue;
    tasks.push_back(i + 1);
    pairs = 0;
  }
  return tasks;
}

void NarrowSampler::solve(const Chunk& chunk, int worker) {
  instances_[static_cast<std::size_t>(worker)]->solve(
      chunk.batch, std::span(outcomes_).subspan(chunk.first, chunk.batch.size()));
}

SampleReply NarrowSampler::sample(const SampleRequest& request) {
  const NarrowSet& set = sets_[request.set];
  const std::vector<Chunk> chunks = cut(request);
  const std::vector<std::size_t> tasks = tasks_of(chunks);
  // By reference, so that std::function does not allocate.
  const auto work = [&](std::size_t task, int worker) {
    for (std::size_t i = tasks[task]; i < tasks[task + 1]; ++i) solve(chunks[i], worker);
  };
  SampleReply reply;
  const Stopwatch watch;
  executor_->run(tasks.size() - 1, std::cref(work));
  reply.query = watch.seconds();
  reply.pairs = static_cast<std::int64_t>(outcomes_.size());
  reply.contacts = 0;
  for (const Outcome& outcome : outcomes_) {
    reply.contacts +=
        outcome.answer == Answer::touching || outcome.answer == Answer::overlapping ? 1 : 0;
    count(reply.iterations, outcome.iterations);
    count(reply.support_calls, outcome.support_calls);
  }
  std::size_t first = 0;
  each_frame(request, [&](std::size_t frame) {
    const PairGroup& group = set.frames[frame];
    reply.pair_hash += group_hash(group);
    reply.outcome_hash += outcome_hash(group, std::span(outcomes_).subspan(first, group.size()));
    first += group.size();
  });
  return reply;
}

Allocations NarrowSampler::count_allocations(const SampleRequest& request) {
  const std::vector<Chunk> chunks = cut(request);
  const AllocationCount counted;
  for (const Chunk& chunk : chunks) solve(chunk, 0);
  return counted.so_far();
}

}  // namespace touchstone
