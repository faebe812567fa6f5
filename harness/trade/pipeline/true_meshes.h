// The exact answer for a pair with a mesh: triangle by triangle, and inside of it.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/narrow_phase.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {

// The mesh's triangles, each a flat hull, in the mesh's own frame.
std::vector<proxies::Part> triangle_parts(const geometry::Mesh& mesh);

// How often a closed mesh goes around a point (metres, its frame), from solid angles (van Oosterom,
// Strackee, IEEE Trans. Biomedical Engineering 30(2), 1983): 1 inside, 0 outside, nothing if the
// point is on the surface up to rounding. Small holes change it little.
std::optional<double> winding_number(const geometry::Mesh& mesh, const Vec3d& point);

class TrueMeshes {
 public:
  // The frames and the executor must outlive this object.
  TrueMeshes(const SceneFrames& frames, Executor& executor);

  // Returns the answer and the gap; the gap is NaN in contact, because meshes have no depth. Calls
  // with one worker never overlap in time.
  std::pair<Answer, double> solve(std::size_t frame, const IndexPair& pair, int worker);

 private:
  bool has_inside(std::uint32_t body, const Pose& pose, const StandIn& other,
                  const Pose& pose_of_other) const;

  const SceneFrames* frames_;
  StandInLibrary library_;
  std::shared_ptr<const StandIns> solids_;
  std::vector<std::unique_ptr<NarrowPhase>> certified_;  // one a worker
};

}  // namespace touchstone::trade
