// The exact answer for a pair of bodies.
#pragma once

#include <memory>

#include "algorithms/core/aabb.h"
#include "algorithms/core/outcome.h"
#include "algorithms/oracle/certificates/certificate.h"
#include "algorithms/oracle/numbers/filters.h"
#include "algorithms/oracle/solid.h"

namespace touchstone::oracle {

// The signed distance of a pair.
struct Measure {
  Answer answer = Answer::unknown;    // unknown: zero is in the enclosure, for curved cores only
  SignedRoot core_lower, core_upper;  // of the cores' signed distance; see certificate.h
  bool exact = false;                 // core_lower == core_upper
  // Metres: the bodies' signed distance (> 0 the gap, < 0 minus the depth) is between these; for an
  // exact answer they are the doubles on both sides of it.
  double lower = 0, upper = 0;
  // Of about unit length, from a to b: the direction of the shortest connection, or of the shortest
  // separating translation of b. Zero where there is none.
  Vec3d normal = Vec3d::Zero();

  double middle() const { return lower + (upper - lower) / 2; }
};

struct Enclosure {
  double lower, upper;
};

// Keeps memory from query to query; one for each thread. Numbers of the bodies are finite.
class Oracle {
 public:
  explicit Oracle(const Filters& filters = {});
  ~Oracle();
  Oracle(Oracle&&) noexcept;

  // Separated, touching or overlapping; unknown only for curved cores. No more work than that
  // needs.
  Answer verdict(const Body& a, const Body& b);
  // The exact signed distance where both cores are polytopes or half-spaces, else an enclosure.
  Measure measure(const Body& a, const Body& b);
  // The same with its proof. `certificate.answer` is the verdict.
  Measure prove(const Body& a, const Body& b, Certificate& certificate);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

// How far b has to be moved along n (not zero, any length) until the bodies have no interior point
// in common, in metres: the support of the difference a - b along n, over |n|. Negative where they
// are apart along n already. Infinite where a half-space forbids it.
Enclosure separation_along(const Body& a, const Body& b, const Vec3d& n);

// Whether every point of the body lies in the closed box, exactly.
bool holds(const Aabb& box, const Body& body);

}  // namespace touchstone::oracle
