// EPA in integers: a polytope inside the difference of two bodies grows at its face nearest to the
// origin until that face is one of the difference's own.
// Paper: van den Bergen, "Proximity queries and penetration depth computation on 3D game objects",
// GDC 2001.
#pragma once

#include <vector>

#include "algorithms/oracle/exact_simplex.h"

namespace touchstone::oracle {

enum class ExpansionGoal : std::uint8_t {
  verdict,  // whether the origin is strictly inside
  depth,    // how far it is from the surface
};

class Expander {
 public:
  explicit Expander(const Filters& filters) : filters_(filters) {}

  // The simplex contains the origin; at least weakly.
  void expand(GridPair& pair, const ExactSimplex& simplex, ExpansionGoal goal);

  // The origin is strictly inside the polytope, hence inside the difference.
  bool inside() const { return inside_; }
  // The plane normal . x = offset of the face nearest to the origin: a lower bound on the depth,
  // offset / |normal|, and where the bodies are polytopes and the goal was the depth the depth
  // itself. Not for a difference without volume, where depth is zero.
  bool has_volume() const { return has_volume_; }
  const IntegerVector& nearest_normal() const { return faces_[nearest_].plane.exact; }
  const Integer& nearest_offset() const { return faces_[nearest_].offset; }
  // Along which the difference reaches least far of all directions that were tried. Without volume:
  // along which it has no extent.
  const Direction& least() const { return least_; }

  Certificate::Surface surface() const;

 private:
  struct Face {
    std::array<std::uint32_t, 3> vertices;    // anticlockwise seen from outside
    std::array<std::uint32_t, 3> neighbours;  // across the edge from vertices[i] to vertices[i + 1]
    Direction plane;
    Integer offset;
    double rounded_offset;  // of plane.rounded
    double distance;        // from the origin, in the pair's unit, off by rounding
    bool alive = true;
    bool final = false;  // nothing lies beyond it
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
