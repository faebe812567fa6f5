// The contract of a narrow phase: what two convex bodies do to each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/encoding.h"

namespace touchstone {

struct NarrowPhaseSettings {
  Precision scalar = Precision::float64;
  // The error in a distance or depth at which the algorithm may stop, as a part of the size of the
  // pair. Without it: the algorithm's own default for the scalar.
  std::optional<double> tolerance = {};
  // Greatest number of iterations of each loop of a query (GJK's, EPA's, the portal's); without it
  // the algorithm's own. A query that needs more says not_converged.
  std::optional<int> max_iterations = {};
  // Instead of a tolerance, for those that know it (NarrowPhaseEntry::stops_by_duality_gap): the
  // Frank-Wolfe duality gap 2 x . (x - s) of |x|^2 (square metres) at which a distance is found, x
  // being the nearest point of the difference so far and s the newest support point (Montaut et
  // al., RSS 2022, sec. III). It is absolute, so that it allows a greater error in the distance the
  // nearer the bodies are; published counts of iterations are for such a stop.
  std::optional<double> duality_gap = {};
};

// What an algorithm keeps of a pair from one frame to the next, in a form of its own. The caller
// owns it, keeps it with the two bodies as long as their pair lives, and hands it on unread. All
// zeros: nothing is known yet. What is in it may make an answer quicker, never worse.
struct PairMemory {
  alignas(64) std::array<std::byte, 64> bytes{};
};

// Pairs of one kind of shapes, kind_a <= kind_b. Pair i is of bodies first[i] and second[i]; body k
// has the shape shapes[shape_of[k]] of those that were bound, and the pose poses[k].
struct PairBatch {
  Task task;
  ShapeKind kind_a, kind_b;
  std::span<const std::uint32_t> first, second;
  std::span<const std::uint32_t> shape_of;
  std::span<const Pose> poses;
  // Pair i has memory[memory_of[i]], which was last written by the same algorithm with the same
  // shapes bound. Both are empty where every query is to start cold.
  std::span<PairMemory> memory = {};
  std::span<const std::uint32_t> memory_of = {};

  std::size_t size() const { return first.size(); }
};

// One instance a worker, never shared between threads.
class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;

  // Once for each scene: builds what the algorithm needs of each shape, so that no query does. The
  // shapes stay alive and unchanged. Numbers are finite and sizes >= 0; zero sizes are good input.
  virtual void bind(std::span<const Shape> shapes) = 0;

  // Answers pair i into outcomes[i]; what the task does not ask for is left as it was. Poses are
  // converted to the algorithm's own scalar and types here, so the conversion is timed with the
  // query. Never throws on finite input: a failure is a status.
  virtual void solve(const PairBatch& batch, std::span<Outcome> outcomes) = 0;
};

struct NarrowPhaseEntry {
  AlgorithmInfo info;
  std::vector<Task> tasks;
  std::vector<Precision> scalars;
  // Which pairs it takes, kind_a <= kind_b; null: all of them. A pair that is not taken is never
  // given to solve: its outcome is `unsupported`.
  bool (*supports)(ShapeKind kind_a, ShapeKind kind_b, Task task) = nullptr;
  // Known to answer for more than the body, such as SAT over face normals only, so that
  // "overlapping" is no promise. Its disagreements are counted as the price of its speed, not as
  // faults.
  bool approximate = false;
  // The depth is that of one separating translation, an upper bound, and not in general the least.
  bool depth_is_bound = false;
  bool stops_by_duality_gap = false;  // honours NarrowPhaseSettings::duality_gap
  bool starts_warm = false;           // reads and writes PairMemory where it is given some
  // What it is given of a pair of these kinds, kind_a <= kind_b; null: the pair as it stands, in
  // both scalars. Its errors are stated against the exact answer for that, and for the pair.
  Encoding (*encoding)(ShapeKind kind_a, ShapeKind kind_b, Task task, Precision scalar) = nullptr;
  // Null where it is not built.
  std::function<std::unique_ptr<NarrowPhase>(const NarrowPhaseSettings&)> make;
};

}  // namespace touchstone
