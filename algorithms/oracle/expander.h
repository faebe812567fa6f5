// Part of the oracle: EPA in integers. A polytope inside the difference of two bodies grows at the
// face nearest to the origin until that face belongs to the difference itself.
// Paper:   van den Bergen, "Proximity queries and penetration depth computation on 3D game
//          objects", GDC 2001.
// Steps:   1. Grow the simplex of the exact GJK to a tetrahedron (`grow`). If that fails, the
//             difference has no volume.
//          2. Choose the face nearest to the origin; for a verdict, a face whose plane contains the
//             origin.
//          3. Find the point of the difference that is furthest along the face's normal.
//          4. If that point is not beyond the face, the face is final. A verdict ends here; a depth
//             ends when no other face can be nearer.
//          5. Otherwise replace the faces that the point sees by faces from the point to their
//             horizon, and repeat from step 2. Curved cores stop when their bounds nearly meet or
//             at an iteration cap.
//          6. Choose the nearest face by exact comparison (`find_nearest`).
#pragma once

#include <vector>

#include "algorithms/oracle/exact_simplex.h"

namespace touchstone::oracle {

enum class ExpansionGoal : std::uint8_t {
  verdict,  // tells if the origin is strictly inside
  depth,    // the distance from the origin to the surface, metres
};

class Expander {
 public:
  explicit Expander(const Filters& filters) : filters_(filters) {}

  // Requires that the simplex contains the origin, possibly on its boundary.
  void expand(GridPair& pair, const ExactSimplex& simplex, ExpansionGoal goal);

  // True if the origin is strictly inside the polytope, and therefore inside the difference.
  bool inside() const { return inside_; }
  // The face nearest to the origin has the plane normal . x = offset. offset / |normal| is a lower
  // bound on the depth; if both bodies are polytopes and the goal is `depth`, it is the depth.
  // Valid only if the difference has volume; otherwise the depth is zero.
  bool has_volume() const { return has_volume_; }
  const IntegerVector& nearest_normal() const { return faces_[nearest_].plane.exact; }
  const Integer& nearest_offset() const { return faces_[nearest_].offset; }
  // The direction of least reach among all that were tried. If the difference has no volume: a
  // direction along which it has no extent.
  const Direction& least() const { return least_; }

  Certificate::Surface surface() const;

 private:
  struct Face {
    std::array<std::uint32_t, 3> vertices;    // anticlockwise seen from outside
    std::array<std::uint32_t, 3> neighbours;  // across the edge from vertices[i] to vertices[i + 1]
    Direction plane;
    Integer offset;
    double rounded_offset;  // plane.rounded . vertex
    double distance;        // from the origin, in the pair's unit, with rounding error
    bool alive = true;
    bool final = false;  // no point of the difference lies beyond it
    std::uint32_t seen = 0;
    bool visible = false;
  };

  bool start(const ExactSimplex& simplex);
  bool grow(ExactSimplex& simplex);
  bool add_if_outside(ExactSimplex& simplex, const IntegerVector& direction);
  std::uint32_t add_point(const DifferencePoint& point);
  std::uint32_t add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  std::uint32_t next_face(ExpansionGoal goal) const;
  bool nearer(const Face& x, const Face& y) const;
  bool sees(std::uint32_t point, const Face& face) const;
  void replace_visible(std::uint32_t face, std::uint32_t point);
  void note_reach(const Face& face, const Integer& along);
  void find_nearest();

  Filters filters_;
  GridPair* pair_ = nullptr;
  std::vector<DifferencePoint> points_;
  std::vector<IntegerVector> at_;
  std::vector<Vec3d> rounded_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> visible_, made_of_;
  std::uint32_t search_ = 0;
  bool has_volume_ = false, inside_ = false;
  std::uint32_t nearest_ = 0;
  Direction least_;
  double least_reach_ = 0;
};

}  // namespace touchstone::oracle
