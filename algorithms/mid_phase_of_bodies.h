// A mid-phase that keeps something for each body, a tree or its boxes: what such mid-phases share of the contract.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/mid_phase.h"

namespace touchstone {

// Kept is made from a body's boxes and has refit(boxes).
template <class Kept>
class MidPhaseOfBodies : public MidPhase {
 public:
  std::uint32_t add(std::span<const Aabb> parts) final {
    bodies_.emplace_back(parts);
    return static_cast<std::uint32_t>(bodies_.size() - 1);
  }
  void refit(std::uint32_t body, std::span<const Aabb> parts) final { bodies_[body].refit(parts); }

 protected:
  const Kept& kept(std::uint32_t body) const { return bodies_[body]; }

 private:
  std::vector<Kept> bodies_;
};

}  // namespace touchstone
