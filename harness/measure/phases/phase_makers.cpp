// Makes samplers of broad and narrow phases.
#include "harness/measure/phases/phase_makers.h"

#include "harness/measure/phases/broad_sampler.h"
#include "harness/measure/phases/narrow_sampler.h"

namespace touchstone::measure {
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
