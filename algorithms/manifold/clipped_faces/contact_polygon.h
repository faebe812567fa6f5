// Where two features touch: their common part as seen along the normal, as far as the bodies
// overlap there.
// Paper: Sutherland, Hodgman, "Reentrant polygon clipping", Communications of the ACM 17(1), 1974.
// Departs: seen along the normal neither face need be across it, and heights along it are carried
// along, so that each point of the part lies in both faces and has a depth; one more cut leaves
// what is not below the other face. Corners within rounding of a cut are on it, so that faces of
// the same outline are not cut.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/manifold/clipped_faces/contact_feature.h"

namespace touchstone {

// A corner of the region, as seen along the normal: its place across it and, along it, how high
// the two bodies are there.
template <class Scalar>
struct PolygonCorner {
  Scalar x, y;
  Scalar on_a, on_b, depth;        // depth = on_a - on_b
  std::uint16_t from = 0, to = 0;  // numbers of the edges of a and b that meet here
};

template <class Scalar>
class ContactPolygon {
 public:
  // Of polygons and segments; the normal (unit) leads from a to b. Lengths below `rounding` are
  // nothing. The corners are a convex loop, as seen along the normal anticlockwise; two are a
  // segment. None where the features do not meet. Of two segments that are not parallel it knows
  // nothing, and has none.
  void find(const ContactFeature<Scalar>& a, const ContactFeature<Scalar>& b,
            const Vec3<Scalar>& normal, Scalar rounding);
  // Over a plane across the normal, at this height along it.
  void find_on_plane(const ContactFeature<Scalar>& a, Scalar height, const Vec3<Scalar>& normal,
                     Scalar rounding);

  const std::vector<PolygonCorner<Scalar>>& corners() const { return corners_; }
  // Of a corner, in the frame of the features.
  Vec3<Scalar> on_a(const PolygonCorner<Scalar>& corner) const {
    return frame_.point(corner.x, corner.y, corner.on_a);
  }
  Vec3<Scalar> on_b(const PolygonCorner<Scalar>& corner) const {
    return frame_.point(corner.x, corner.y, corner.on_b);
  }

 private:
  struct Seen {
    Scalar x, y;         // across the normal
    Scalar height;       // along it, on the subject
    std::uint16_t edge;  // number of the edge that begins here
  };
  // a x + b y + c: how far within a line, or the height of a plane.
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

  // `first` is the number of its first edge.
  void see(const ContactFeature<Scalar>& feature, std::uint16_t first,
           std::vector<Seen>& seen) const;
  Line height_of(const ContactFeature<Scalar>& feature, const std::vector<Seen>& seen) const;
  // Cuts the subject by the outline of the other feature.
  void cut_by_polygon(Scalar rounding);
  void cut_by_segment(Scalar rounding);
  // Leaves what has value(seen) >= 0, a length that is affine on the subject.
  template <class Value>
  void cut(const Value& value, std::uint16_t edge, Scalar rounding);
  // Leaves what is not above, or below, the other feature.
  void cut_where_apart(const Line& height, bool subject_is_a, Scalar rounding);
  // The corners, from what is left of the subject and the other feature's height above each place.
  void finish(const Line& height, bool subject_is_a, Scalar rounding);
  static void merge_neighbours(std::vector<Seen>& loop, Scalar distance);

  Frame frame_;
  std::vector<Seen> subject_, cut_, outline_;
  std::vector<PolygonCorner<Scalar>> corners_;
};

extern template class ContactPolygon<float>;
extern template class ContactPolygon<double>;

}  // namespace touchstone
