// Part of clipped-faces: the contact polygon, which is the intersection of two features projected
// along the normal, restricted to where the bodies overlap.
// Paper: Sutherland, Hodgman, "Reentrant polygon clipping", Communications of the ACM 17(1), 1974.
// Departs: the projection is along the normal, to which neither face need be perpendicular. Corners
//          carry their heights along it, so each lies in both faces and has a depth; one more cut
//          removes what is outside the other face. Corners within rounding of a cut count as on it,
//          so faces of the same outline are not cut.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/manifold/clipped_faces/contact_feature.h"

namespace touchstone {

// A corner of the contact polygon: its coordinates across the normal and the heights of both
// bodies' surfaces there, along the normal.
template <class Scalar>
struct PolygonCorner {
  Scalar x, y;
  Scalar on_a, on_b, depth;        // depth = on_a - on_b
  std::uint16_t from = 0, to = 0;  // numbers of the edges of a and b that meet here
};

template <class Scalar>
class ContactPolygon {
 public:
  // Intersects two features, each a polygon or a segment; `normal` is unit and points from a to b.
  // Lengths below `rounding` count as zero. The corners form a convex loop, anticlockwise seen
  // along the normal; two corners are a segment. There are none if the features do not meet, or if
  // they are two segments that are not parallel.
  void find(const ContactFeature<Scalar>& a, const ContactFeature<Scalar>& b,
            const Vec3<Scalar>& normal, Scalar rounding);
  // Intersects a feature with a plane perpendicular to the normal, at `height` along it.
  void find_on_plane(const ContactFeature<Scalar>& a, Scalar height, const Vec3<Scalar>& normal,
                     Scalar rounding);

  const std::vector<PolygonCorner<Scalar>>& corners() const { return corners_; }
  // The surface points at a corner, in the frame of the features.
  Vec3<Scalar> on_a(const PolygonCorner<Scalar>& corner) const {
    return frame_.point(corner.x, corner.y, corner.on_a);
  }
  Vec3<Scalar> on_b(const PolygonCorner<Scalar>& corner) const {
    return frame_.point(corner.x, corner.y, corner.on_b);
  }

 private:
  struct Seen {
    Scalar x, y;         // coordinates across the normal
    Scalar height;       // coordinate along the normal, on the subject
    std::uint16_t edge;  // number of the edge that begins here
  };
  // The function a x + b y + c: the distance inside a line, or the height of a plane.
  struct Line {
    Scalar a, b, c;
    Scalar at(const Seen& s) const { return a * s.x + b * s.y + c; }
  };
  struct Frame {
    Vec3<Scalar> u, v, normal;

    Frame() = default;
    explicit Frame(const Vec3<Scalar>& n) : u(n.unitOrthogonal()), v(n.cross(u)), normal(n) {}
    Seen see(const Vec3<Scalar>& p) const { return {u.dot(p), v.dot(p), normal.dot(p), 0}; }
    Vec3<Scalar> point(Scalar x, Scalar y, Scalar height) const {
      return x * u + y * v + height * normal;
    }
  };

  // Projects a feature; `first` is the number of its first edge.
  void see(const ContactFeature<Scalar>& feature, std::uint16_t first,
           std::vector<Seen>& seen) const;
  Line height_of(const ContactFeature<Scalar>& feature, const std::vector<Seen>& seen) const;
  // Clips the subject by the outline of the other feature.
  void cut_by_polygon(Scalar rounding);
  void cut_by_segment(Scalar rounding);
  // Keeps the part with value(seen) >= 0; `value` is a length, affine on the subject.
  template <class Value>
  void cut(const Value& value, std::uint16_t edge, Scalar rounding);
  // Keeps the part in which the bodies overlap: not above, or not below, the other feature.
  void cut_where_apart(const Line& height, bool subject_is_a, Scalar rounding);
  // Writes the corners from the clipped subject and the other feature's height at each place.
  void finish(const Line& height, bool subject_is_a, Scalar rounding);
  static void merge_neighbours(std::vector<Seen>& loop, Scalar distance);

  Frame frame_;
  std::vector<Seen> subject_, cut_, outline_;
  std::vector<PolygonCorner<Scalar>> corners_;
};

extern template class ContactPolygon<float>;
extern template class ContactPolygon<double>;

}  // namespace touchstone
