// Part of smooth: proves that a foot's height is the least of all, and so the depth.
//
// With n a foot's normal and t across n, the height of the difference along n + t is at least
//   held + slide . t + (t . K t) / 2        for |t| <= width,
// because |w + d| >= |w| + (d along w) + (d across w)^2 / (2 |w| + 2 |d|) for a disc or a ball, and
// because the excess of a tie or a disc over its balanced point, (1 - share) |g . t|, is at least
// (1 - share) (g . t)^2 / (|g| width). If K has no eigenvalue below `held`, no normal within the cap
// |t| <= width has a height below `held`, up to the slide: sqrt(1 + t^2) <= 1 + t^2 / 2.
// Outside of that cap a polytope in the difference proves it (rim_proof).
// Steps:   1. Start with GJK's tetrahedron around the origin, and descend to a foot from the lowest of
//             its faces' normals and of the kinks known (`best_kink`).
//          2. Find the widest cap that is proven around the foot.
//          3. Add the support points along the normals where the proof fails: the nearest face's
//             outside of the cap, then those on the rim.
//          4. If such a point is lower than the foot, descend from there and start over at 2 with the
//             lower of both.
// Paper:   Newton's caps: see smooth_foot.h; the polytope: van den Bergen, GDC 2001, as in
//          kernels/epa.
#pragma once

#include <optional>

#include "algorithms/kernels/epa/epa_hull.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/narrow_phase/smooth/rim_proof.h"
#include "algorithms/narrow_phase/smooth/smooth_foot.h"

namespace touchstone {

struct LeastOverlap {
  SmoothFoot foot;
  double lower;  // lower bound on the cores' depth; its upper bound is foot.height
  int iterations = 0;
};

class LeastOverlapSearch {
 public:
  // `most_points` of the polytope, at least 4.
  explicit LeastOverlapSearch(int most_points)
      : most_points_(most_points),
        surface_(static_cast<std::size_t>(most_points) + 4),
        proof_(surface_.face_capacity()) {}

  // `simplex` is a tetrahedron around the origin. `tolerance` is that of the depth, in the pair's
  // unit. Returns none if it proves no depth.
  std::optional<LeastOverlap> find(SupportPair<double>& pair, const Simplex<double>& simplex,
                                   double tolerance);

 private:
  int most_points_;
  EpaHull<double> surface_;
  RimProof proof_;
};

}  // namespace touchstone
