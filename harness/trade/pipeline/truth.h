// The exact answers for the pairs of bodies of a scene that are near each other; those with a mesh triangle by triangle,
// and inside of it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/core/executor/executor.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/narrow_phase.h"
#include "harness/trade/pipeline/scene_frames.h"
#include "harness/trade/pipeline/stand_ins.h"

namespace touchstone::trade {

struct TruePair {
  IndexPair pair;
  Answer answer = Answer::unknown;
  // Metres, signed. NaN if it is not known: meshes in contact have no depth.
  double gap = Outcome::none;
  double size = 0;  // metres: the size of the smaller body, by which errors are divided
};

struct FrameTruth {
  std::size_t frame = 0;
  std::vector<TruePair> pairs;  // the pairs, sorted
};

// Bodies are near if their boxes, tight and grown by this part of each body's own size, overlap, or
// if the scene lists the pair.
inline constexpr double nearness = 0.05;

// Returns all frames of a scene in the order in which they are sampled: frame 0, which has the
// pairs of bodies at rest, then frames whose every prefix is evenly spread.
std::vector<std::size_t> sampling_order(std::size_t frames);

// The diameter of each body's box at its own attitude, metres; 0 for half-spaces.
std::vector<double> body_sizes(const SceneFrames& frames);

// Finds the truth of these frames, one after the other until so many seconds are spent, but always
// that of the first. Pairs of two bodies at rest are in that of frame 0 alone. A mesh is a solid: a
// body inside of it is in contact with it. The answers come from exact arithmetic, or from
// `certified` for pairs of triangles, in a child process with so many threads. Throws
// std::runtime_error if the first frame fails.
std::vector<FrameTruth> find_truth(const SceneFrames& frames, std::span<const std::size_t> wanted,
                                   double seconds, int threads);

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
