// Part of the oracle: what proves where a ray meets bodies of many parts. harness/files reads and writes it.
//
// No part of any body has a point of the ray at the times [0, lower), of a hit or an unknown answer, or [0, t_max],
// of a miss. That is shown by a cover, a walk over the tree of the bodies by their boxes in the world, and by a cover
// of the parts of each body that it leads to, a walk over the tree of these as in parts_certificate.h. A node is halved;
// or the planes along a direction part all that is in it from these points of the ray, at the end of a half-open
// span perhaps with a touch, as the gap is linear in time; or it is one body, whose parts have a cover; or one
// triangle, of which the check finds out by itself.
//
// The part that is hit has the point of the time `upper`. The check finds out by itself, but for hulls of more
// than three vertices: these need a closed surface of triangles between vertices, each minus the point, around
// 0. `lower` = `upper` is the exact time. Otherwise the first hit is in the bracket. Of an ordered one the cover
// shows more: all other parts are free at the times [0, upper), and so the part that is named is the first that is
// hit, or one of several at `upper`. Without order another part may be hit before it, in the bracket.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "algorithms/core/cast_outcome.h"
#include "algorithms/oracle/certificates/cast_certificate.h"

namespace touchstone::oracle {

struct SceneRayCertificate {
  // The points origin + t * direction with 0 <= t <= t_max.
  Vec3d origin = Vec3d::Zero();     // world (metres)
  Vec3d direction = Vec3d::Zero();  // not zero
  double t_max = std::numeric_limits<double>::infinity();
  // Of a hit: what was asked for is the first, or else any, whose `lower` is 0.
  bool is_first = true;
  bool is_ordered = true;  // false for a first hit alone, and then nothing is claimed of the order

  CastAnswer answer = CastAnswer::unknown;
  TimeFraction lower;                 // not of a miss
  TimeFraction upper;                 // of a hit
  std::uint32_t body = 0, part = 0;   // of a hit
  Certificate::Surface surface;       // of a hit at a hull; the point is generator 0 of a
  std::vector<Generator> generators;  // of b

  struct Step {
    enum class Kind : std::uint8_t {
      halve,
      plane,      // along `direction`, from the ray to what is in the node
      body,       // the next of `of_bodies` is of its parts
      own_plane,  // that of the half-space which the part is
      triangle,
    };
    Kind kind = Kind::triangle;
    IntegerVector direction{};
  };
  struct Cover {
    std::vector<std::uint32_t> order;  // each body or part once
    std::vector<Step> steps;
  };
  Cover cover;  // of the bodies; empty where no time has to be free
  std::vector<Cover> of_bodies;
};

}  // namespace touchstone::oracle
