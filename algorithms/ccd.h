// The contract of continuous collision of features: the first time at which a moving vertex meets a
// moving triangle, or a moving edge another edge. Every vertex moves along a line, at constant speed,
// during the times 0 to 1. Algorithms and the harness include this.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/status.h"
#include "algorithms/core/vec.h"

namespace touchstone {

enum class FeaturePair : std::uint8_t { vertex_face, edge_edge };

// The four vertices at time 0 and at time 1 (world, metres, finite). Vertex-face: the vertex, then the
// triangle's three. Edge-edge: two of the first edge, then two of the second. Features are closed
// and may be degenerate: a triangle may be a segment or a point.
struct CcdQuery {
  std::array<Vec3d, 4> start, end;
};

enum class CcdAnswer : std::uint8_t { hit, miss, unknown };

struct CcdSettings {
  // Metres. An algorithm may call it a hit if the features come within separation + tolerance, and
  // has to if they come within the separation. The oracle has no tolerance.
  double tolerance = 1e-6;
  // Metres, >= 0: features this near to each other are in contact.
  double separation = 0;
  // Greatest number of steps of a query; the default is the algorithm's own. A query that needs more
  // returns not_converged. The exact one has no steps.
  std::optional<int> max_iterations = {};
};

// Fields that are not known are NaN.
struct CcdOutcome {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  CcdAnswer answer = CcdAnswer::unknown;
  Status status = Status::unsupported;
  double toi = none;  // the time of impact, of a hit
  // Proven: there is no contact before this time. It is 1 if there is none at all. Peers have none.
  double free_before = none;
  // Proven: by this time the features were within separation + tolerance.
  double contact_by = none;
  std::int32_t iterations = -1;  // -1: not counted
};

// One instance for each worker, never shared between threads.
class Ccd {
 public:
  virtual ~Ccd() = default;

  // Writes the whole of outcomes[i] for each query i. Never throws on finite input: a failure is a
  // status.
  virtual void solve(FeaturePair pair, std::span<const CcdQuery> queries,
                     std::span<CcdOutcome> outcomes) = 0;
};

struct CcdEntry {
  AlgorithmInfo info;
  // True if it supports a separation > 0; others answer such queries with `unsupported`.
  bool separations = false;
  // Null if it is not built.
  std::function<std::unique_ptr<Ccd>(const CcdSettings&)> make;
};

std::string_view to_string(FeaturePair pair);  // "vertex-face" or "edge-edge"
std::string_view to_string(CcdAnswer answer);

}  // namespace touchstone
