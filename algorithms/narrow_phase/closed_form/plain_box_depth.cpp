// The least depth along the fifteen axes of Gottschalk, Lin and Manocha (OBBTree, SIGGRAPH 1996), in the
// axes of box a.
//
// With r_j the axes of box b, the product of edges e_i and r_j has the components -r_j[k] and r_j[i'] on
// the other two axes of a; all that it is multiplied with are determinants of two by two of these, so
// that the depth keeps its digits if the edges are nearly parallel. Rounding of r_j and of the offset
// moves a body by as much, and a depth by no more.
#include "algorithms/narrow_phase/closed_form/plain_box_depth.h"

#include <array>
#include <limits>

#include "algorithms/narrow_phase/closed_form/plain_core.h"

namespace touchstone {
namespace {

using namespace plain;

// Box b in the axes of box a, from its centre; and what a depth may be off by.
struct Boxes {
  Three half_a, half_b;
  Three offset;               // the centre of b
  std::array<Three, 3> axes;  // of b
  double error;
};

double inner(const Three& p, const Three& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

// The boxes with their roles swapped, in the axes of b.
Boxes swapped(const Boxes& boxes) {
  Boxes other{boxes.half_b, boxes.half_a, {}, {}, boxes.error};
  for (int j = 0; j < 3; ++j) {
    other.offset[j] = -inner(boxes.axes[j], boxes.offset);
    for (int i = 0; i < 3; ++i) other.axes[i][j] = boxes.axes[j][i];
  }
  return other;
}

struct LeastDepth {
  double depth = std::numeric_limits<double>::infinity();
  int of_a = -1, of_b = -1;  // the number of an edge of each box, or of a face of one of them
  double length = 1;         // of the product of the edges
};

// Along the faces of box a, which are axes of its own.
void try_faces(const Boxes& boxes, int LeastDepth::*number, LeastDepth& least) {
  for (int i = 0; i < 3; ++i) {
    const double reach = std::abs(boxes.axes[0][i]) * boxes.half_b[0] +
                         std::abs(boxes.axes[1][i]) * boxes.half_b[1] +
                         std::abs(boxes.axes[2][i]) * boxes.half_b[2];
    const double depth = boxes.half_a[i] + reach - std::abs(boxes.offset[i]);
    if (!(depth < least.depth)) continue;
    least = {};
    least.depth = depth;
    least.*number = i;
  }
}

// Along products of edges. A face is preferred up to the error, since it has better points.
void try_edges(const Boxes& boxes, LeastDepth& least) {
  for (int j = 0; j < 3; ++j) {
    const Three &own = boxes.axes[j], &next = boxes.axes[(j + 1) % 3],
                &last = boxes.axes[(j + 2) % 3];
    const double half_next = boxes.half_b[(j + 1) % 3], half_last = boxes.half_b[(j + 2) % 3];
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3, l = (i + 2) % 3;
      const double square = own[k] * own[k] + own[l] * own[l];
      const auto along = [&](const Three& v) { return std::abs(own[k] * v[l] - own[l] * v[k]); };
      const double depth = boxes.half_a[k] * std::abs(own[l]) + boxes.half_a[l] * std::abs(own[k]) +
                           half_next * along(next) + half_last * along(last) - along(boxes.offset);
      // Both sides are positive, or the boxes are apart.
      const double limit = least.depth - boxes.error;
      if (!(square > least_square) || !(depth < 0 || depth * depth < limit * limit * square))
        continue;
      const double length = std::sqrt(square);
      least = {depth / length, i, j, length};
    }
  }
}

struct Contact {
  Three normal;  // from a to b
  Three on_a;    // the point on b is a depth back along the normal
};

bool is_in_a(const Boxes& boxes, const Three& point) {
  bool in = true;
  for (int k = 0; k < 3; ++k) in &= std::abs(point[k]) <= boxes.half_a[k] + boxes.error;
  return in;
}

// The contact of face i of box a: the deepest feature of b. If that is parallel to the face, which of its
// points are over the face is found by projecting on either in turn.
bool face_contact(const Boxes& boxes, int i, double depth, Contact& contact) {
  constexpr int rounds = 8;
  const double side = boxes.offset[i] < 0 ? -1 : 1;
  contact.normal = {};
  contact.normal[i] = side;
  Three at{}, low{}, high{};  // places along the axes of b
  for (int j = 0; j < 3; ++j) {
    const double reach = side * boxes.axes[j][i] * boxes.half_b[j], half = boxes.half_b[j];
    low[j] = reach < -boxes.error ? half : -half;
    high[j] = reach > boxes.error ? -half : half;
    at[j] =
        low[j] == high[j] ? low[j] : clamp(-inner(boxes.axes[j], boxes.offset), low[j], high[j]);
  }
  for (int round = 0; round < rounds; ++round) {
    Three point = boxes.offset;
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) point[k] += at[j] * boxes.axes[j][k];
    }
    point[i] += depth * side;
    contact.on_a = point;
    if (is_in_a(boxes, point)) return true;
    Three inside;
    for (int k = 0; k < 3; ++k)
      inside[k] = clamp(point[k], -boxes.half_a[k], boxes.half_a[k]) - boxes.offset[k];
    inside[i] = point[i] - boxes.offset[i] - depth * side;
    for (int j = 0; j < 3; ++j) at[j] = clamp(inner(inside, boxes.axes[j]), low[j], high[j]);
  }
  return false;
}

// The contact of two edges: the points of their lines that are next to each other.
bool edge_contact(const Boxes& boxes, const LeastDepth& least, Contact& contact) {
  const int i = least.of_a, j = least.of_b, k = (i + 1) % 3, l = (i + 2) % 3;
  const Three& own = boxes.axes[j];
  const double side = own[k] * boxes.offset[l] - own[l] * boxes.offset[k] < 0 ? -1 / least.length
                                                                              : 1 / least.length;
  contact.normal[i] = 0;
  contact.normal[k] = -side * own[l];
  contact.normal[l] = side * own[k];
  // The middles of the edges.
  Three on_a{}, on_b = boxes.offset;
  for (const int axis : {k, l})
    on_a[axis] = contact.normal[axis] < 0 ? -boxes.half_a[axis] : boxes.half_a[axis];
  for (const int other : {(j + 1) % 3, (j + 2) % 3}) {
    const Three& axis = boxes.axes[other];
    const double half = boxes.half_b[other];
    const double reach = inner(contact.normal, axis) < 0 ? half : -half;
    for (int c = 0; c < 3; ++c) on_b[c] += reach * axis[c];
  }
  const double along = -((on_b[k] - on_a[k]) * own[k] + (on_b[l] - on_a[l]) * own[l]) /
                       (least.length * least.length);
  if (!(std::abs(along) <= boxes.half_b[j])) return false;
  for (int c = 0; c < 3; ++c) contact.on_a[c] = on_b[c] + along * own[c];
  for (int c = 0; c < 3; ++c) contact.on_a[c] += least.depth * contact.normal[c];
  return is_in_a(boxes, contact.on_a);
}

Vec times(const std::array<Vec, 3>& axes, const Three& v) {
  return v[0] * axes[0] + v[1] * axes[1] + v[2] * axes[2];
}

}  // namespace

bool solve_plain_box_depth(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                           Outcome& outcome) {
  const std::array<Vec, 3> axes_a = {column(pose_a.rotation, 0), column(pose_a.rotation, 1),
                                     column(pose_a.rotation, 2)};
  const std::array<Vec, 3> axes_b = {column(pose_b.rotation, 0), column(pose_b.rotation, 1),
                                     column(pose_b.rotation, 2)};
  const Vec offset = read(pose_b.translation) - read(pose_a.translation);
  const double size = length(offset) + a.half_extents.sum() + b.half_extents.sum();
  const double error = (rounding + 16 * greatest_skew) * size;
  if (!(size > 1e-120 && size < 1e120)) return false;
  if (!is_rotation(axes_a[0], axes_a[1], axes_a[2]) ||
      !is_rotation(axes_b[0], axes_b[1], axes_b[2]))
    return false;
  const auto in_a = [&](const Vec& v) {
    return Three{dot(axes_a[0], v), dot(axes_a[1], v), dot(axes_a[2], v)};
  };
  const Boxes boxes{three(read(a.half_extents)),
                    three(read(b.half_extents)),
                    in_a(offset),
                    {in_a(axes_b[0]), in_a(axes_b[1]), in_a(axes_b[2])},
                    error};
  const Boxes from_b = swapped(boxes);
  LeastDepth least;
  try_faces(boxes, &LeastDepth::of_a, least);
  try_faces(from_b, &LeastDepth::of_b, least);
  try_edges(boxes, least);
  if (!(least.depth > error)) return false;
  Contact contact;
  const bool face_of_b = least.of_a < 0;
  if (face_of_b        ? !face_contact(from_b, least.of_b, least.depth, contact)
      : least.of_b < 0 ? !face_contact(boxes, least.of_a, least.depth, contact)
                       : !edge_contact(boxes, least, contact)) {
    return false;
  }
  write(Answer::overlapping, outcome);
  const Vec normal = times(face_of_b ? axes_b : axes_a, contact.normal);
  const Vec point = times(face_of_b ? axes_b : axes_a, contact.on_a);
  outcome.distance = -least.depth;
  outcome.lower = outcome.distance - error;
  outcome.upper = outcome.distance + error;
  if (face_of_b) {
    const Vec on_b = read(pose_b.translation) + point;
    outcome.normal = written(-1 * normal);
    outcome.witness_b = written(on_b);
    outcome.witness_a = written(on_b - least.depth * normal);
  } else {
    const Vec on_a = read(pose_a.translation) + point;
    outcome.normal = written(normal);
    outcome.witness_a = written(on_a);
    outcome.witness_b = written(on_a - least.depth * normal);
  }
  return true;
}

}  // namespace touchstone
