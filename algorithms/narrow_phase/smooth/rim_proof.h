// Part of smooth: which normals outside of a cap a growing polytope proves. Includes kernels.
//
// Let the faces of the polytope be the planes m . x = d. The normals along which the polytope is
// lower than h are those inside the polar polytope with the vertices h m / d. So none is outside of
// the cap if no such vertex there is further than 1 from the origin, nor any point where an edge of
// the polar crosses the plane of the cap's rim. The edges belong to neighbouring faces.
// Paper:   Ziegler, "Lectures on Polytopes", 1995, sec. 2.3 (polarity).
// Steps:   1. `start` takes all faces, `extend` those that a point brought, and whether their planes are
//             too low outside of the cap.
//          2. `failure` tells the lowest of these planes.
//          3. Where none is too low, it tests the vertices and the edges of the faces that are not
//             proven yet, and tells the worst. Two faces become neighbours only if one of them is
//             new, so both sides of an edge are tested with the newer face, and a face that is
//             proven stays so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algorithms/kernels/epa/epa_hull.h"

namespace touchstone {

// The part of the sphere of normals that the polytope has to prove: outside of the cap.
struct Rim {
  Vec3d normal = Vec3d::Zero();
  double cosine = 0;  // of the cap's angle; 0 without a cap
  double height = 0;  // that is to be proven

  // Positive if the vertex of the polar is inside of the plane of the rim.
  double inside(const Vec3d& m, double distance) const {
    return cosine > 0 ? height * m.dot(normal) - distance * cosine : -1;
  }
};

class RimProof {
 public:
  // A normal along which the polytope may be too low, and a face that sees what is there.
  struct Failure {
    int face = -1;  // -1: there is none
    Vec3d along = Vec3d::Zero();
  };

  explicit RimProof(std::size_t most_faces);

  void start(const EpaHull<double>& surface, const Rim& rim);
  // The surface has one point more.
  void extend(const EpaHull<double>& surface);
  Failure failure(const EpaHull<double>& surface);

 private:
  // A face as a vertex of the polar.
  struct Vertex {
    Vec3d normal;
    // A height that the polytope has along the normal, and, as far as the neighbours' heights say,
    // along those between: the least of the corners', whatever rounding did to the normal.
    double height;
    double inside;  // of the rim
  };
  static constexpr std::size_t faces_a_word = 64;

  void add(const EpaHull<double>& surface, int face);
  void measure(const EpaHull<double>& surface, int face);
  Failure failure_on_rim(const EpaHull<double>& surface);

  Rim rim_;
  std::vector<Vertex> vertices_;  // indexed by face
  // Bits of faces: not proven yet, and with a plane that is too low. Those of faces that are gone
  // are cleared when they are met.
  std::vector<std::uint64_t> open_, low_;
  std::size_t words_ = 1;  // in use; the others are 0
};

}  // namespace touchstone
