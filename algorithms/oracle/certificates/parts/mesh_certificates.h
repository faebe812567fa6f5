// Part of the oracle: what the answers to rays and points at a mesh claim. harness/files reads and writes it.
//
// These claims need no witness beside the numbers in them: mesh_certificate_check.h derives each from the mesh
// again, in rationals and triangle by triangle, and leaves out only those whose exact box has no part in it.
#pragma once

#include <cstdint>
#include <limits>

#include "algorithms/core/vec.h"
#include "algorithms/oracle/certificates/cast_certificate.h"

namespace touchstone::oracle {

inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

// The points origin + t * direction with 0 <= t <= t_max. A miss: no triangle has one of them. A hit: the
// triangle has the one of the time `t`, and none before. If that is the first hit, no triangle has a point of the
// ray before, and none with a lower number has that one.
struct RayCertificate {
  Vec3d origin = Vec3d::Zero();     // mesh coordinates (metres)
  Vec3d direction = Vec3d::Zero();  // not zero
  double t_max = std::numeric_limits<double>::infinity();
  bool is_first = true;  // of a hit: what was asked for is the first, or else any
  bool hit = false;
  std::uint32_t triangle = no_triangle;  // of a hit
  TimeFraction t;                        // of a hit
};

// The nearest triangle: it has a point whose squared distance is the fraction, in square metres, and none has
// one that is nearer; no triangle if the mesh has none. A side: the surface is closed, and the point is on one
// of its triangles, or on none, and then the surface winds that often around it; inside is where that is not 0.
struct PointCertificate {
  enum class Claim : std::uint8_t { nearest, surface, inside, outside };

  Vec3d point = Vec3d::Zero();  // mesh coordinates (metres)
  Claim claim = Claim::nearest;
  std::uint32_t triangle = no_triangle;  // of the nearest
  TimeFraction square;                   // of the nearest
  std::int32_t winding = 0;              // of a point that is not on the surface
};

}  // namespace touchstone::oracle
