// Part of mpr-ray-cast-lanes: the search for a portal of two hulls that move without turning, a pair in each
// lane of vectors. It takes the steps of mpr_ray_cast.cpp, with the bounds of MovingPair.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "algorithms/cast/mpr_ray_cast/path_portal.h"

namespace touchstone {

// How a search for a portal ended: at a face of the difference, at a plane that parts the bodies to the end, or
// with neither.
enum class PortalEnd : std::uint8_t { closed, miss, open };

// What a search starts from. Both shapes of the pair are hulls; it is at time 0.
struct PortalQuery {
  const MovingPair* pair;
  double lean;       // how far directions lean to the entry while a portal is looked for
  double tolerance;  // in the pair's unit
};

struct PortalAnswer {
  PortalEnd end = PortalEnd::open;
  Vec3d along = Vec3d::Zero();  // unit length: the direction of the path
  double time = 0;              // before which the pair is proven free
  Vec3d plane = Vec3d::Zero();  // normal of the last plane through which time grew; zero if none
  // Of a portal that is closed: its corners, and where they are relative to the path.
  std::array<CornerPair, 3> corners;
  std::array<Vec3d, 3> places;
  // True if the path is proven to be in the difference at the time `upper`, and the portal is nearer to it than
  // the tolerance at `time`, at the point with these weights.
  bool is_proven = false;
  double upper = 0;
  std::array<double, 3> weights;
  int iterations = 0;
};

// Both have the same size. A lane whose search has ended takes the next query.
void search_portals(std::span<const PortalQuery> queries, int most_iterations,
                    std::span<PortalAnswer> answers);

}  // namespace touchstone
