// A pair of bodies that move without turning: the search for their first contact by GJK, and what an
// outcome needs after any search. Used by gjk-ray-cast and mpr-ray-cast.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "algorithms/cast.h"
#include "algorithms/kernels/motion/linear/approach.h"
#include "algorithms/kernels/motion/linear/moving_pair.h"
#include "algorithms/kernels/motion/moving_scene.h"

namespace touchstone {

// How a search ended: `open` if it gave up.
enum class PathEnd : std::uint8_t { hit, miss, open };

// What a search found. The pair is at the greatest time before which it is proven free.
struct PathContact {
  Simplex<double> simplex;       // points that touch or nearly do, with weights
  NearestPoint<double> nearest;  // to the origin, of the simplex at the pair's time
  Vec3d plane = Vec3d::Zero();   // normal, from a to b, of the last plane through which time grew
  Vec3d direction = Vec3d::Zero();  // the next one for GJK; zero if it has not begun
  int iterations = 0;
};

// The tolerance is in the pair's unit.
using PathSearch = PathEnd (*)(MovingPair& pair, double tolerance, int most_iterations,
                               PathContact& found);

// By GJK, from the time at which the pair is. Time grows only through planes whose gap is proven.
PathEnd search_by_gjk(MovingPair& pair, double tolerance, int most_iterations, PathContact& found);

// Moves the pair to where a support plane with this unit normal closes, if that is later than where it is,
// and sets `found.plane`. Returns true if the plane parts the bodies up to time 1. `gap` is that of the plane at
// the pair's time.
bool part_by_plane(MovingPair& pair, const Vec3d& normal, double gap, PathContact& found);

// Casts one pair at a time by a search, with half-spaces in closed form.
class LinearCast {
 public:
  LinearCast(const CastSettings& settings, PathSearch search)
      : settings_(settings),
        most_iterations_(std::max(1, settings.max_iterations.value_or(128))),
        search_(search) {
    if (settings.start == StartContact::approach) approach_.emplace(most_iterations_);
  }

  void bind(std::span<const Shape> shapes) { scene_.bind(shapes); }
  void solve(const CastBatch& batch, std::size_t i, CastOutcome& outcome);
  // All pairs, one after the other.
  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes);
  // Metres, for a pair of shapes of the scene.
  double tolerance(std::uint32_t shape_a, std::uint32_t shape_b) const;

  // What `solve` does of a pair of bounded bodies, in two parts, with a search between them.
  struct Begun {
    // The reach is as MovingPair has it; the tolerance is in metres.
    Begun(const MovingBody& body_a, const MovingBody& body_b, const CentreOffset& offset,
          double reach, double metres)
        : a(body_a),
          b(body_b),
          pair(offset, b.motion->displacement - a.motion->displacement, reach, *a.shape,
               a.pose->rotation, *b.shape, b.pose->rotation),
          tolerance(std::max(metres / pair.unit(), 4 * MovingPair::rounding)) {}

    MovingBody a, b;
    MovingPair pair;
    // In the pair's unit. A gap that rounding hides can be told neither from contact nor from a miss.
    double tolerance;
  };
  // Places the pair and returns true, if balls of the bodies do not tell its answer. Otherwise the outcome is
  // written.
  bool begin(const CastBatch& batch, std::size_t i, std::optional<Begun>& begun,
             CastOutcome& outcome) const;
  // Writes a hit at the time, at this point of body a (relative to its centre, in the pair's unit and world axes).
  static void write_hit(const Begun& begun, double time, const Vec3d& on_a, CastOutcome& outcome);
  // Writes the outcome of a search.
  void finish(Begun& begun, PathEnd end, PathContact& found, CastOutcome& outcome);
  int most_iterations() const { return most_iterations_; }

 private:
  CastSettings settings_;
  int most_iterations_;
  PathSearch search_;
  std::optional<ApproachTest> approach_;  // for StartContact::approach
  MovingScene scene_;
};

}  // namespace touchstone
