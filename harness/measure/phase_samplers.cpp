// Plays frames with a broad phase, and times its parts; makes samplers of broad and narrow phases.
#include "harness/measure/phase_samplers.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/measure/narrow_sampler.h"
#include "harness/record/raw_row.h"

namespace touchstone::measure {

BroadSampler::BroadSampler(const BroadPhaseEntry& entry, const BlockInput& input, bool rebuild,
                           Executor& executor)
    : input_(&input),
      rebuild_(rebuild || input.frames.size() == 1),
      algorithm_(entry.make(executor)) {}

void BroadSampler::make_ready(std::size_t frame) {
  if (!is_built(frame)) return;
  algorithm_->discard();
  algorithm_->prepare(input_->frames[frame].boxes.size());
}

void BroadSampler::prepare(std::size_t frame) {
  const BlockFrame& now = input_->frames[frame];
  if (is_built(frame)) {
    algorithm_->build(now.boxes);
  } else {
    algorithm_->update(now.change());
  }
}

void BroadSampler::step(std::size_t frame, SampleReply& reply) {
  make_ready(frame);
  const base::Stopwatch preparing;
  prepare(frame);
  const double prepared = preparing.seconds();
  const base::Stopwatch finding;
  const Status status = algorithm_->find_pairs(sink_);
  const double found = finding.seconds();
  reply.durations.add(to_string(is_built(frame) ? record::Phase::build : record::Phase::update),
                      prepared);
  reply.durations.add(to_string(record::Phase::find_pairs), found);
  // NaN, of no frame yet, is less than nothing.
  if (!(reply.worst_frame >= prepared + found)) reply.worst_frame = prepared + found;
  if (status != Status::ok) reply.status = status;
  reply.pairs += static_cast<std::int64_t>(sink_.size());
  at_ = static_cast<std::ptrdiff_t>(frame);
}

// Returns the least of some repetitions; NaN if the algorithm converts nothing.
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
  auto* const peer = dynamic_cast<PeerBroadPhase*>(algorithm_.get());
  if (peer == nullptr) return std::numeric_limits<double>::quiet_NaN();
  peer->convert(converted);  // allocates the memory for them
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repetitions; ++i) {
    const base::Stopwatch converting;
    peer->convert(converted);
    least = std::min(least, converting.seconds());
  }
  return least;
}

void BroadSampler::play_up_to(std::size_t frame) {
  if (at_ == static_cast<std::ptrdiff_t>(frame) - 1) return;
  SampleReply untimed;
  for (std::size_t before = 0; before < frame; ++before) step(before, untimed);
}

SampleReply BroadSampler::play(std::size_t frame) {
  SampleReply reply;
  if (!is_built(frame)) play_up_to(frame);
  step(frame, reply);
  reply.work = algorithm_->work();
  if (const double seconds = time_conversion(frame); seconds >= 0) {
    reply.durations.add(to_string(record::Phase::convert), seconds);
  }
  for (const PairBuffer& chunk : sink_.chunks()) reply.pair_hash += base::pair_hash(chunk.pairs());
  return reply;
}

BroadSampler::FrameAllocations BroadSampler::count_allocations(std::size_t frame) {
  if (!is_built(frame)) play_up_to(frame);
  FrameAllocations allocations;
  make_ready(frame);
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
  std::size_t frame = request.frame;
  if (!rebuild_) play_up_to(frame);
  for (std::uint32_t i = 0; i < request.frames; ++i) {
    if (frame == input_->frames.size()) frame = 0;
    if (frame == 0 && !rebuild_) step(frame++, untimed);
    step(frame++, reply);
  }
  return reply;
}

namespace {

// A sampler with the executor that it runs on.
template <class Made>
class Owning final : public Sampler {
 public:
  template <class Build>
  Owning(Threads threads, const Build& build)
      : executor_(threads.width, Pinning::one_a_thread, threads.kind), sampler_(build(executor_)) {}
  SampleReply sample(const SampleRequest& request) override { return sampler_.sample(request); }

 private:
  Executor executor_;
  Made sampler_;
};

}  // namespace

Worker::Make broad_maker(const BroadPhaseEntry& entry, const BlockInput& input, bool rebuild,
                         Threads threads) {
  return [&entry, &input, rebuild, threads] {
    return std::make_unique<Owning<BroadSampler>>(
        threads, [&](Executor& executor) { return BroadSampler(entry, input, rebuild, executor); });
  };
}

Worker::Make narrow_maker(const NarrowChoice& choice, const BlockInput& input,
                          std::span<const NarrowSet> sets, Threads threads) {
  return [&choice, &input, sets, threads] {
    return std::make_unique<Owning<NarrowSampler>>(
        threads, [&](Executor& executor) { return NarrowSampler(choice, input, sets, executor); });
  };
}

}  // namespace touchstone::measure
