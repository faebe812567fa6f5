// Part of clipped-faces: the supporting feature of each kind of shape.
#include "algorithms/manifold/clipped_faces/contact_feature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "algorithms/core/cofactors.h"
#include "algorithms/kernels/sat/planar_hull.h"

namespace touchstone {
namespace {

constexpr int rim_corners = 16;

// A body with its feature under construction; `matrix` maps body coordinates to the frame.
template <class Scalar>
struct Placed {
  const FeatureShape<Scalar>& shape;
  const Mat3<Scalar>& matrix;
  const Mat3<Scalar>& turn;  // `matrix` without the body's scale, whose square could underflow
  const Vec3<Scalar>& centre;
  const Vec3<Scalar>& direction;
  Scalar radius;
  Vec3<Scalar> local;  // `direction` in body coordinates: the same points are furthest
  ContactFeature<Scalar>& feature;

  void add(const Vec3<Scalar>& point) {
    feature.points.push_back(matrix * point + (centre + radius * direction));
  }
  // True if `outward`, the image of a face's outward normal, is nearly parallel to the direction.
  bool is_across(const Vec3<Scalar>& outward) const {
    constexpr Scalar least = 1 - greatest_tilt<Scalar> * greatest_tilt<Scalar>;
    const Scalar along = outward.dot(direction);
    return along > 0 && along * along >= least * outward.squaredNorm();
  }
  // True if the image of an edge is nearly perpendicular to the direction.
  bool is_level(const Vec3<Scalar>& edge) const {
    const Scalar along = local.dot(edge);
    return along * along <=
           greatest_tilt<Scalar> * greatest_tilt<Scalar> * (turn * edge).squaredNorm();
  }
};

// The image of an outward normal under any matrix, reflections included; not of unit length.
template <class Scalar>
Vec3<Scalar> turned_normal(const Mat3<Scalar>& m, const Vec3<Scalar>& normal) {
  const Mat3<Scalar> cofactors = cofactor_matrix(m);
  const Vec3<Scalar> image = cofactors * normal;
  return m.col(0).dot(cofactors.col(0)) < 0 ? Vec3<Scalar>(-image) : image;
}

template <class Scalar>
void find_on_box(Placed<Scalar>& body) {
  const Vec3<Scalar>& half = body.shape.support.extents;
  const Mat3<Scalar>&m = body.matrix, &t = body.turn;
  const std::array<Vec3<Scalar>, 3> normals = {t.col(1).cross(t.col(2)), t.col(2).cross(t.col(0)),
                                               t.col(0).cross(t.col(1))};
  const std::array<Scalar, 3> along = {normals[0].dot(body.direction),
                                       normals[1].dot(body.direction),
                                       normals[2].dot(body.direction)};
  const std::array<Scalar, 3> square = {normals[0].squaredNorm(), normals[1].squaredNorm(),
                                        normals[2].squaredNorm()};
  const auto cosine_squared = [&](std::size_t k) { return along[k] * along[k] / square[k]; };
  std::size_t best = cosine_squared(1) > cosine_squared(0) ? 1 : 0;
  if (cosine_squared(2) > cosine_squared(best)) best = 2;
  const auto face = static_cast<int>(best);
  const Vec3<Scalar> outward = along[best] < 0 ? Vec3<Scalar>(-normals[best]) : normals[best];
  if (body.is_across(outward)) {
    const int i = (face + 1) % 3, j = (face + 2) % 3;
    const Scalar side = std::copysign(half[face], body.local[face]);
    const Vec3<Scalar> middle = body.centre + side * m.col(face);
    const Vec3<Scalar> to_i = half[i] * m.col(i), to_j = half[j] * m.col(j);
    // The order of the corners, and so their numbers, does not depend on the direction.
    const Vec3<Scalar> high = middle + to_i, low = middle - to_i;
    std::vector<Vec3<Scalar>>& points = body.feature.points;
    points.resize(4);
    points[0] = high + to_j;
    points[1] = low + to_j;
    points[2] = low - to_j;
    points[3] = high - to_j;
    body.feature.normal = outward / std::sqrt(square[best]);
    body.feature.numbered = true;
    body.feature.number = static_cast<std::uint16_t>(2 * face + (side > 0 ? 1 : 0));
    return;
  }
  Vec3<Scalar> corner;
  for (int k = 0; k < 3; ++k) corner[k] = std::copysign(half[k], body.local[k]);
  int edge = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(body.local[k]) < std::abs(body.local[edge])) edge = k;
  }
  if (!body.is_level(Vec3<Scalar>::Unit(edge))) return;
  body.add(corner);
  corner[edge] = -corner[edge];
  body.add(corner);
}

template <class Scalar>
std::uint32_t furthest_vertex(const Placed<Scalar>& body) {
  const SupportShape<Scalar>& hull = body.shape.support;
  const std::uint32_t vertex = hull.furthest(body.local);
  if (!body.shape.complete || !body.shape.faces.around(vertex).empty()) return vertex;
  // The vertex is a repeated one or lies inside a face: search those of the faces.
  const auto loops = body.shape.faces.all_loops();
  return *std::max_element(loops.begin(), loops.end(), [&](std::uint32_t p, std::uint32_t q) {
    return body.local.dot(hull.vertex(p)) < body.local.dot(hull.vertex(q));
  });
}

template <class Scalar>
void find_on_hull(Placed<Scalar>& body) {
  const SupportShape<Scalar>& hull = body.shape.support;
  const HullFaces<Scalar>& faces = body.shape.faces;
  const std::uint32_t vertex = furthest_vertex(body);
  if (faces.around(vertex).empty()) return;
  std::uint32_t best_face = 0, best_end = vertex;
  Vec3<Scalar> best_normal = Vec3<Scalar>::Zero();
  Scalar greatest = 0, least = greatest_tilt<Scalar> * greatest_tilt<Scalar>;
  for (const std::uint32_t face : faces.around(vertex)) {
    const Vec3<Scalar> outward = turned_normal(body.turn, faces.normal(face));
    const Scalar along = outward.dot(body.direction), length = outward.norm();
    if (along > greatest * length) {
      greatest = along / length;
      best_face = face;
      best_normal = outward;
    }
    // Each edge at the vertex leaves it in exactly one of the faces.
    const std::span<const std::uint32_t> loop = faces.loop(face);
    const auto at = std::find(loop.begin(), loop.end(), vertex);
    const std::uint32_t end = at + 1 == loop.end() ? loop.front() : *(at + 1);
    const Vec3<Scalar> edge = hull.vertex(end) - hull.vertex(vertex);
    const Scalar climb = body.local.dot(edge), square = (body.turn * edge).squaredNorm();
    if (square > 0 && climb * climb < least * square) {
      least = climb * climb / square;
      best_end = end;
    }
  }
  if (greatest > 0 && body.is_across(best_normal)) {
    for (const std::uint32_t k : faces.loop(best_face)) body.add(hull.vertex(k));
    body.feature.normal = best_normal.normalized();
    body.feature.numbered = true;
    body.feature.number = static_cast<std::uint16_t>(best_face);
    return;
  }
  if (best_end == vertex) return;
  body.add(hull.vertex(vertex));
  body.add(hull.vertex(best_end));
}

// The direction from a cylinder's or cone's axis to the furthest point of a rim; body coordinates.
template <class Scalar>
Vec3<Scalar> rim_direction(const Vec3<Scalar>& local) {
  const Scalar length = std::hypot(local.x(), local.y());
  if (!(length > 0)) return {1, 0, 0};
  return {local.x() / length, local.y() / length, 0};
}

template <class Scalar>
void find_on_turned(Placed<Scalar>& body, bool cone) {
  const Scalar radius = body.shape.support.extents.x(), half = body.shape.support.extents.z();
  const Scalar side = std::copysign(Scalar{1}, body.local.z());
  const Vec3<Scalar> to_rim = radius * rim_direction(body.local);
  const Vec3<Scalar> outward = turned_normal<Scalar>(body.turn, {0, 0, side});
  if (!(cone && side > 0) && body.is_across(outward)) {
    for (int k = 0; k < rim_corners; ++k) {
      const Scalar angle = 2 * std::numbers::pi_v<Scalar> * static_cast<Scalar>(k) / rim_corners;
      const Scalar c = std::cos(angle), s = std::sin(angle);
      body.add({c * to_rim.x() - s * to_rim.y(), s * to_rim.x() + c * to_rim.y(), side * half});
    }
    body.feature.normal = outward.normalized();
    return;
  }
  const Vec3<Scalar> low{to_rim.x(), to_rim.y(), -half};
  const Vec3<Scalar> high = cone ? Vec3<Scalar>(0, 0, half) : Vec3<Scalar>(low.x(), low.y(), half);
  if (!body.is_level(high - low)) return;
  body.add(low);
  body.add(high);
}

template <class Scalar>
void find_on_segment(Placed<Scalar>& body) {
  const Vec3<Scalar> end{0, 0, body.shape.support.extents.z()};
  if (!(end.z() > 0) || !body.is_level(end)) return;
  body.add(end);
  body.add(-end);
}

}  // namespace

template <class Scalar>
void HullFaces<Scalar>::add(const std::vector<std::uint32_t>& loop, const Vec3d& normal) {
  loops_.insert(loops_.end(), loop.begin(), loop.end());
  loop_begin_.push_back(static_cast<std::uint32_t>(loops_.size()));
  normals_.push_back(normal.cast<Scalar>());
}

template <class Scalar>
HullFaces<Scalar>::HullFaces(const Hull& hull) {
  for (const Hull::Face& face : hull.faces) add(face.loop, face.normal);
  if (hull.dimension < 3) {
    std::vector<Vec3<long double>> points;
    for (const Vec3d& vertex : hull.vertices) points.push_back(vertex.cast<long double>());
    const PlanarHull outline = planar_hull(points);
    const Vec3d normal = outline.normal.cast<double>();
    add(outline.loop, normal);
    if (!normal.isZero(0)) add({outline.loop.rbegin(), outline.loop.rend()}, -normal);
  }
  around_begin_.assign(hull.vertices.size() + 1, 0);
  for (const std::uint32_t vertex : loops_) ++around_begin_[vertex + 1];
  for (std::size_t k = 1; k < around_begin_.size(); ++k) around_begin_[k] += around_begin_[k - 1];
  around_.resize(loops_.size());
  std::vector<std::uint32_t> next(around_begin_.begin(), around_begin_.end() - 1);
  for (std::uint32_t face = 0; face < size(); ++face) {
    for (const std::uint32_t vertex : loop(face)) around_[next[vertex]++] = face;
  }
}

template <class Scalar>
void find_feature(const FeatureShape<Scalar>& shape, const Mat3<Scalar>& rotation,
                  const PosedShape<Scalar>& turned, const Vec3<Scalar>& centre,
                  const Vec3<Scalar>& direction, ContactFeature<Scalar>& feature) {
  using Core = typename SupportShape<Scalar>::Core;
  feature.points.clear();
  feature.normal.setZero();
  feature.numbered = false;
  Placed<Scalar> body{shape,
                      turned.matrix(),
                      rotation,
                      centre,
                      direction,
                      turned.radius(),
                      rotation.transpose() * direction,
                      feature};
  switch (shape.support.core) {
    case Core::segment: return find_on_segment(body);
    case Core::box: return find_on_box(body);
    case Core::cylinder: return find_on_turned(body, false);
    case Core::cone: return find_on_turned(body, true);
    case Core::hull: return find_on_hull(body);
    default: return;
  }
}

template class HullFaces<float>;
template class HullFaces<double>;
template void find_feature(const FeatureShape<float>&, const Mat3<float>&, const PosedShape<float>&,
                           const Vec3<float>&, const Vec3<float>&, ContactFeature<float>&);
template void find_feature(const FeatureShape<double>&, const Mat3<double>&,
                           const PosedShape<double>&, const Vec3<double>&, const Vec3<double>&,
                           ContactFeature<double>&);

}  // namespace touchstone
