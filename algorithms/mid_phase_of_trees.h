// A mid-phase that keeps a tree for each body: what such mid-phases share of the contract.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/mid_phase.h"

namespace touchstone {

// Tree is made from a body's boxes and has refit(boxes).
template <class Tree>
class MidPhaseOfTrees : public MidPhase {
 public:
  std::uint32_t add(std::span<const Aabb> parts) final {
    trees_.emplace_back(parts);
    return static_cast<std::uint32_t>(trees_.size() - 1);
  }
  void refit(std::uint32_t body, std::span<const Aabb> parts) final { trees_[body].refit(parts); }

 protected:
  const Tree& tree(std::uint32_t body) const { return trees_[body]; }

 private:
  std::vector<Tree> trees_;
};

}  // namespace touchstone
