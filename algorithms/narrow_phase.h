// The contract of a narrow phase: queries of pairs of convex bodies. Narrow phases and the harness
// include this.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "algorithms/encoding.h"

namespace touchstone {

struct NarrowPhaseSettings {
  Precision scalar = Precision::float64;
  // The error in a distance or depth at which the algorithm may stop, as a part of the size of the
  // pair. The default is the algorithm's own for the scalar.
  std::optional<double> tolerance = {};
  // Greatest number of iterations of each loop of a query (GJK's, EPA's, the portal's); the default
  // is the algorithm's own. A query that needs more returns not_converged.
  std::optional<int> max_iterations = {};
  // A stopping criterion in place of the tolerance, for algorithms with
  // Traits::stops_by_duality_gap: the Frank-Wolfe duality gap 2 x . (x - s) of |x|^2 (square
  // metres) at which a distance is found, where x is the nearest point of the difference so far and
  // s the newest support point (Montaut et al., RSS 2022, sec. III). It is absolute, so it allows a
  // greater error in the distance the nearer the bodies are; published counts of iterations use
  // this criterion.
  std::optional<double> duality_gap = {};
  // Metres, >= 0: bodies that are further apart need no distance. Where the task asks for one, they
  // are `separated` without a number, a normal or points, and `lower` is a proven bound beyond the
  // margin if the algorithm has bounds, NaN if not. The registry sees to this form; an algorithm may
  // stop as soon as it knows.
  std::optional<double> margin = {};
};

// Data that an algorithm keeps for a pair from one frame to the next, in its own format. The caller
// owns it, keeps it with the two bodies as long as their pair lives, and never reads it. All zeros
// mean that nothing is known yet. The data may make an answer faster, never worse.
struct PairMemory {
  alignas(64) std::array<std::byte, 64> bytes{};
};

// Pairs of one combination of kinds, kind_a <= kind_b. Body k has the shape shapes[shape_of[k]] of
// the bound ones.
struct PairBatch {
  ShapeKind kind_a, kind_b;
  BodyPairs pairs;
  // Pair i has memory[memory_of[i]], last written by the same algorithm with the same shapes bound.
  // Both spans are empty if every query starts cold.
  std::span<PairMemory> memory = {};
  std::span<const std::uint32_t> memory_of = {};

  std::size_t size() const { return pairs.first.size(); }
  // Returns the pairs [begin, begin + count).
  PairBatch part(std::size_t begin, std::size_t count) const {
    PairBatch part = *this;
    part.pairs.first = pairs.first.subspan(begin, count);
    part.pairs.second = pairs.second.subspan(begin, count);
    if (!memory_of.empty()) part.memory_of = memory_of.subspan(begin, count);
    return part;
  }
};

// A rotation is taken as it is given, orthonormal or not: it moves the points of a core. The ball of a sphere or capsule stays
// one of its radius.
//
// One instance for each worker, never shared between threads.
class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;

  // Prepares what the algorithm needs of each shape of a scene, so that no query does. May come again,
  // and then for another scene in place of this one; the shapes stay alive and unchanged until then.
  // Numbers are finite and sizes >= 0; zero sizes are valid.
  virtual void bind(std::span<const Shape> shapes) = 0;

  // Writes outcomes[i] for each pair i, whatever it held: all that `only_given` takes of it, NaN
  // where that is not known. Its other fields may stay as they are. Poses are converted to the
  // algorithm's own scalar and types here, so the conversion is timed with the query. Never throws
  // on finite input: a failure is a status.
  virtual void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) = 0;

  // Writes the outcome of pair i alone, for callers that have one pair at a time. It is as right as
  // that of the batch, and may differ from it in rounding.
  virtual void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) {
    solve(task, batch.part(i, 1), {&outcome, 1});
  }
};

// The properties of an algorithm that a harness must know to call it and to judge its answers.
struct Traits {
  // True if it answers for more than the body, as SAT over face normals only does, so that
  // "overlapping" is no promise. Its disagreements count as the price of its speed, not as faults.
  bool approximate = false;
  // The depth is that of some separating translation: an upper bound, in general not the least.
  bool depth_is_bound = false;
  bool stops_by_duality_gap = false;  // honours NarrowPhaseSettings::duality_gap
  bool starts_warm = false;           // reads and writes PairMemory if there is some
};

struct NarrowPhaseEntry {
  AlgorithmInfo info;
  std::vector<Task> tasks;
  std::vector<Precision> scalars;
  // True for the kinds of pairs that it supports, kind_a <= kind_b; null means all. solve never
  // gets other pairs: their outcome is `unsupported`.
  bool (*supports)(ShapeKind kind_a, ShapeKind kind_b, Task task) = nullptr;
  Traits traits = {};
  // The encoding in which it gets a pair of these kinds, kind_a <= kind_b; null means as given, in
  // both scalars. Its errors are stated against the exact answer for that encoding, and for the
  // pair.
  Encoding (*encoding)(ShapeKind kind_a, ShapeKind kind_b, Task task, Precision scalar) = nullptr;
  // The length that NarrowPhaseSettings::tolerance limits, and its default, in one line; empty if
  // there is none to set.
  std::string tolerance = {};
  // Null if it is not built.
  std::function<std::unique_ptr<NarrowPhase>(const NarrowPhaseSettings&)> make;
};

}  // namespace touchstone
