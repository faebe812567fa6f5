// Concave phases by name, and bodies for them, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"

namespace touchstone::reference {

// All that are built and ours, or the oracle.
inline std::vector<std::string> concave_names() {
  std::vector<std::string> names;
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (is_built(entry.info) && entry.info.origin != Origin::peer) names.push_back(entry.info.name);
  }
  return names;
}

inline ConcaveSettings concave_settings(const std::string& mid = "wide-bvh") {
  return {.scalar = Precision::float64,
          .mid_phase = registry::find<MidPhaseEntry>(mid)->make,
          .narrow_phase = [] { return registry::find<NarrowPhaseEntry>("certified")->make({}); }};
}

struct Answered {
  Outcome outcome;
  std::vector<IndexPair> pairs;  // sorted

  bool meets() const { return outcome.answer == Answer::overlapping; }
};

inline Answered ask(const std::string& name, ConcaveTask task,
                    const std::array<ConcaveBody, 2>& bodies, const Pose& a, const Pose& b,
                    const std::string& mid = "wide-bvh") {
  const auto phase = registry::find<ConcaveEntry>(name)->make(concave_settings(mid));
  phase->bind(bodies);
  Answered answered;
  phase->solve(task, {0, a}, {1, b}, answered.outcome, answered.pairs);
  std::ranges::sort(answered.pairs);
  return answered;
}

inline ConcaveBody mesh_of(const std::vector<std::array<Vec3d, 3>>& triangles) {
  TriangleMesh mesh;
  for (const auto& corners : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return {std::make_shared<const TriangleMesh>(std::move(mesh)), {}};
}

}  // namespace touchstone::reference
