// Broad phases that are right until a hook interferes, and campaigns of them.
#pragma once

#include <atomic>
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/base/random.h"
#include "harness/campaign/campaign.h"
#include "harness/measure/noise.h"
#include "harness/process/isolate.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

// The naive broad phase, which calls hook(call, sink) at the end of each find_pairs; calls are
// counted from 1 in each instance.
class FakeBroadPhase final : public BroadPhase {
 public:
  using Hook = std::function<void(int call, PairSink& sink)>;
  FakeBroadPhase(Executor& executor, Hook hook)
      : naive_(registry::find<BroadPhaseEntry>("naive")->make(executor)), hook_(std::move(hook)) {}
  void build(std::span<const Aabb> boxes) override { naive_->build(boxes); }
  void update(const FrameChange& change) override { naive_->update(change); }
  Status find_pairs(PairSink& sink) override {
    const Status status = naive_->find_pairs(sink);
    hook_(++calls_, sink);
    return status;
  }

 private:
  std::unique_ptr<BroadPhase> naive_;
  Hook hook_;
  int calls_ = 0;
};

inline BroadPhaseEntry fake(const std::string& name, const FakeBroadPhase::Hook& hook) {
  BroadPhaseEntry entry;
  entry.info.name = name;
  entry.info.origin = Origin::peer;
  entry.make = [hook](Executor& executor) -> std::unique_ptr<BroadPhase> {
    return std::make_unique<FakeBroadPhase>(executor, hook);
  };
  return entry;
}

// The clock of the process that a fake works in: only the fake's work moves it, so times are exact
// on any machine.
class FakeClock {
 public:
  static void start() {
    now_ = base::Stopwatch::Clock::now();
    base::Stopwatch::use([] { return now_; });
  }
  static void spend(double seconds) {
    now_ += std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
  }

 private:
  inline static base::Stopwatch::Clock::time_point now_;
};

// The seconds that a broad phase takes for a frame by that clock. Its instances are numbered in the
// order of their construction: 0 is the check's; then each process of a campaign makes one, or for
// the baseline two, itself and its twin.
// is the baseline two, itself and its twin.
using Cost = std::function<double(int instance, base::Random& random)>;
inline BroadPhaseEntry timed_fake(const std::string& name, std::uint64_t seed, const Cost& cost) {
  BroadPhaseEntry entry = fake(name, nullptr);
  const auto instances = std::make_shared<process::SharedArray<std::atomic<int>>>(1);
  entry.make = [=](Executor& executor) -> std::unique_ptr<BroadPhase> {
    const int instance = (*instances)[0]++;
    FakeClock::start();
    const auto random = std::make_shared<base::Random>(seed, static_cast<std::uint64_t>(instance));
    return std::make_unique<FakeBroadPhase>(
        executor, [=](int, PairSink&) { FakeClock::spend(cost(instance, *random)); });
  };
  return entry;
}

// While it lives no round is flagged, whatever other work the machine does.
class QuietMachine {
 public:
  QuietMachine() {
    measure::noise_judge() = [](const measure::NoiseReading&, const measure::NoiseReading&, double,
                                double) { return std::string(); };
  }
  ~QuietMachine() { measure::noise_judge() = &measure::noise_flags; }
  QuietMachine(const QuietMachine&) = delete;
  QuietMachine& operator=(const QuietMachine&) = delete;
};

// A campaign of one block of a small scene, without narrow phases.
struct FakeCampaign {
  static constexpr int frames = 3;
  TemporaryFolder folder;
  std::vector<BroadPhaseEntry> fakes;  // the test fills it before campaign()
  double time_limit = 60;              // more than a frame takes on the busiest machine

  campaign::Campaign campaign(std::optional<int> squares) const {
    std::ofstream(folder.path() / "scene.toml")
        << "generator = 'uniform'\ncount = 40\noverlaps = 4\nframes = " << frames << "\n";
    campaign::Campaign campaign;
    campaign.name = "fakes";
    campaign::CampaignGroup group;
    group.scenes = {folder.path() / "scene.toml"};
    group.threads = {1};
    for (const BroadPhaseEntry& entry : fakes) group.broad.push_back(&entry);
    group.squares = squares;
    group.seconds = 0.05;  // gives short samples
    group.time_limit = time_limit;
    group.memory_limit = std::size_t{256} << 20;
    campaign.groups.push_back(group);
    return campaign;
  }
  std::filesystem::path out() const { return folder.path() / "out"; }
};

}  // namespace touchstone
