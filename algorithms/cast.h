// The contract of casts: the first time at which two moving convex bodies touch. Casts and the
// harness include this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/body_pairs.h"
#include "algorithms/core/cast_outcome.h"
#include "algorithms/core/motion.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

struct CastSettings {
  Precision scalar = Precision::float64;
  // The distance of the bodies (metres) at which a hit may be reported, and with it how early. The
  // default is the algorithm's own, and is no less than what rounding hides: some hundred roundings of the
  // greatest size, distance and displacement.
  std::optional<double> tolerance = {};
  // Greatest number of iterations of each loop of a query; the default is the algorithm's own. A
  // query that needs more returns not_converged.
  std::optional<int> max_iterations = {};
  StartContact start = StartContact::counts;
};

// Pairs of one combination of kinds, kind_a <= kind_b. Body k of the pairs has motions[k].
struct CastBatch {
  ShapeKind kind_a, kind_b;
  BodyPairs pairs;
  std::span<const Motion> motions;

  std::size_t size() const { return pairs.first.size(); }
};

// One instance for each worker, never shared between threads.
class Cast {
 public:
  virtual ~Cast() = default;

  // Prepares what the algorithm needs of each shape of a scene, so that no query does. May come again,
  // and then for another scene in place of this one; the shapes stay alive and unchanged until then.
  // Numbers are finite and sizes >= 0; zero sizes are valid.
  virtual void bind(std::span<const Shape> shapes) = 0;

  // Writes outcomes[i] for each pair i. Never throws on finite input: a failure is a status.
  virtual void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) = 0;
};

struct CastEntry {
  AlgorithmInfo info;
  std::vector<Precision> scalars;
  // True if bodies may turn. Otherwise `solve` never gets a motion with a rotation.
  bool rotation = false;
  // True if it honours StartContact::approach for bodies that do not turn; otherwise it is never made with that.
  bool approach = false;
  // True if it promises that a hit's time is no later than the contact, but for rounding (1e-14 of the step).
  // That of others may be late by as much as the bodies move within the tolerance.
  bool in_time = false;
  // The tolerance that it has whatever is asked: metres, or a share of the length that the bodies move; 0 if it
  // takes what is asked.
  double fixed_tolerance = 0, fixed_share_of_path = 0;
  double default_tolerance = 0;  // metres, if none is asked; 0: 1e-9 of the size
  // True for the kinds of pairs that it supports, kind_a <= kind_b, if one of them turns or none
  // does; null means all. `solve` never gets other pairs: their outcome is `unsupported`.
  bool (*supports)(ShapeKind kind_a, ShapeKind kind_b, bool turns) = nullptr;
  // True for the kinds of pairs whose hits may lack the point, as where axes alone tell the time, and a
  // point would take as long again; null means none. Every other hit with `ok` of ours has a point, and
  // all have a normal, except at time 0: there either may be unknown.
  bool (*lacks_point)(ShapeKind kind_a, ShapeKind kind_b) = nullptr;
  // Null if it is not built.
  std::function<std::unique_ptr<Cast>(const CastSettings&)> make;
};

}  // namespace touchstone
