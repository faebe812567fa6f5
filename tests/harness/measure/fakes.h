// Broad phases that are right until they do something, and campaigns of them.
#pragma once

#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/run/campaign.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

// The naive one, which calls hook(call, sink) at the end of each find_pairs; calls are counted from
// 1 in each instance.
class FakeBroadPhase final : public BroadPhase {
 public:
  using Hook = std::function<void(int call, PairSink& sink)>;
  FakeBroadPhase(Executor& executor, Hook hook)
      : naive_(find_broad_phase("naive")->make(executor)), hook_(std::move(hook)) {}
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

// One block of a small scene, without narrow phases.
struct FakeCampaign {
  static constexpr int frames = 3;
  TemporaryFolder folder;
  std::vector<BroadPhaseEntry> fakes;  // to be filled before campaign()

  Campaign campaign(int squares) const {
    std::ofstream(folder.path() / "scene.toml")
        << "generator = 'uniform'\ncount = 40\noverlaps = 4\nframes = " << frames << "\n";
    Campaign campaign;
    campaign.name = "fakes";
    CampaignGroup group;
    group.scenes = {folder.path() / "scene.toml"};
    group.threads = {1};
    for (const BroadPhaseEntry& entry : fakes) group.broad.push_back(&entry);
    group.squares = squares;
    group.seconds = 0.05;  // short samples
    group.time_limit = 0.5;
    group.memory_limit = std::size_t{256} << 20;
    campaign.groups.push_back(group);
    return campaign;
  }
  std::filesystem::path out() const { return folder.path() / "out"; }
};

}  // namespace touchstone
