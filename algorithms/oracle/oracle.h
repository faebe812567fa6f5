// The oracle's interface: the exact answer for a pair of bodies. README.md states the problem.
#pragma once

#include <memory>

#include "algorithms/core/aabb.h"
#include "algorithms/core/outcome.h"
#include "algorithms/oracle/numbers/filters.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

struct Certificate;
struct ExactMeasure;

// The signed distance of a pair.
struct Measure {
  Answer answer = Answer::unknown;  // unknown: the enclosure contains zero (curved cores only)
  bool exact = false;               // the cores' signed distance is known exactly
  // Enclosure of the bodies' signed distance in metres: > 0 is the gap, < 0 is minus the depth. If
  // the answer is exact these are the adjacent doubles on both sides of it.
  double lower = 0, upper = 0;
  // Direction of about unit length from a to b: of the shortest connection, or of the shortest
  // translation of b that separates. Zero if there is none.
  Vec3d normal = Vec3d::Zero();

  double middle() const { return lower + (upper - lower) / 2; }
};

struct Enclosure {
  double lower, upper;
};

// Keeps memory between queries; use one for each thread. All numbers of the bodies must be finite.
class Oracle {
 public:
  explicit Oracle(const Filters& filters = {});
  ~Oracle();
  Oracle(Oracle&&) noexcept;

  // Returns separated, touching or overlapping, with no more work than that needs. Returns unknown
  // only for curved cores.
  Answer verdict(const Body& a, const Body& b);
  // Returns the exact signed distance if both cores are polytopes or half-spaces, otherwise an
  // enclosure.
  Measure measure(const Body& a, const Body& b);
  // Like `measure`, with the cores' signed distance, for which exact_measure.h is needed.
  ExactMeasure measure_exactly(const Body& a, const Body& b);
  // Like `measure`, and writes the proof. `certificate.answer` is the verdict.
  Measure prove(const Body& a, const Body& b, Certificate& certificate);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

// The distance in metres by which b must move along n (nonzero, any length) until the bodies have
// no interior point in common: the support of the difference a - b along n, over |n|. It is
// negative if they are already apart along n, and infinite if a half-space prevents it.
Enclosure separation_along(const Body& a, const Body& b, const Vec3d& n);

// Returns true if every point of the body lies in the closed box; exact.
bool holds(const Aabb& box, const Body& body);

}  // namespace touchstone::oracle
