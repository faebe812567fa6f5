#include "algorithms/kernels/expanding_polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

template <class Scalar>
Vec3<Scalar> some_normal(const Vec3<Scalar>& v) {
  Eigen::Index axis = 0;
  v.cwiseAbs().minCoeff(&axis);
  return v.cross(Vec3<Scalar>::Unit(axis)).normalized();
}

}  // namespace

template <class Scalar>
ExpandingPolytope<Scalar>::ExpandingPolytope(int max_iterations) : max_iterations_(max_iterations) {
  // A closed surface of v vertices has 2 v - 4 triangles; an iteration makes its own before it
  // gives back those that they replace.
  const auto vertices = static_cast<std::size_t>(max_iterations) + 4;
  const std::size_t faces = 3 * vertices;
  vertices_.reserve(vertices);
  ring_.resize(vertices);
  faces_.resize(faces);
  unused_.reserve(faces);
  heap_.reserve(2 * faces);
  horizon_.reserve(faces);
  visible_.reserve(faces);
  made_.reserve(faces);
  path_.reserve(faces);
}

template <class Scalar>
Expansion<Scalar> ExpandingPolytope<Scalar>::expand(SupportPair<Scalar>& pair,
                                                    const Simplex<Scalar>& simplex,
                                                    const ExpansionGoal<Scalar>& goal) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  Expansion<Scalar> result;
  result.upper = infinity;
  Simplex<Scalar> tetrahedron = simplex;
  if (simplex.size < 4 && !grow_to_tetrahedron(pair, tetrahedron, result)) return result;
  if (!start(tetrahedron)) return result;

  Scalar held = infinity;  // the nearest of the faces that cannot be expanded
  result.end = ExpansionEnd::cap;
  for (int iteration = 1; iteration <= max_iterations_; ++iteration) {
    Scalar distance = result.upper;
    const int nearest = pop_nearest(distance);
    result.lower = std::max(result.lower, std::min({distance, held, result.upper}));
    if (nearest < 0 || distance > result.upper + goal.tolerance) {
      const bool bounded = result.upper - result.lower <= goal.tolerance;
      result.end = bounded ? ExpansionEnd::converged : ExpansionEnd::stuck;
      break;
    }
    if (goal.enough >= 0 && result.lower > goal.enough) {
      result.end = ExpansionEnd::enough;
      break;
    }
    result.iterations = iteration;
    const Vec3<Scalar> normal = faces_[nearest].normal;
    const DifferencePoint<Scalar> point = pair.support(normal);
    const Scalar height = normal.dot(point.difference);
    // So written that NaN ends the loop.
    const bool met = !(height - std::min(distance, faces_[nearest].distance) > goal.tolerance);
    if (met || height < result.upper) {
      result.upper = height;
      result.normal = normal;
      best_face_ = nearest;
      best_vertices_ = faces_[nearest].vertices;
    }
    if (height < -SupportPair<Scalar>::rounding) {
      result.end = ExpansionEnd::apart;
      break;
    }
    if (met) {
      const bool bounded = height - std::min(distance, held) <= goal.tolerance;
      result.end = bounded ? ExpansionEnd::converged : ExpansionEnd::stuck;
      break;
    }
    if (goal.enough >= 0 && result.upper <= goal.enough) {
      result.end = ExpansionEnd::enough;
      break;
    }
    if (!expand_face(nearest, point, result.upper)) {
      if (full_) {
        result.end = ExpansionEnd::capacity;
        break;
      }
      held = std::min(held, distance);
    }
  }
  if (goal.doubtful && !encloses_origin()) {
    result.lower = 0;
    if (result.end != ExpansionEnd::apart) result.end = ExpansionEnd::stuck;
  }
  find_witnesses(result);
  return result;
}

// Adds support points that are off the simplex until it is a tetrahedron. The origin, which is on
// the simplex, is then on its surface. False where the difference has no volume.
template <class Scalar>
bool ExpandingPolytope<Scalar>::grow_to_tetrahedron(SupportPair<Scalar>& pair,
                                                    Simplex<Scalar>& simplex,
                                                    Expansion<Scalar>& result) {
  constexpr Scalar flat = 4 * SupportPair<Scalar>::rounding;
  for (int i = 0; i < simplex.size; ++i) {
    result.a += simplex.weights[i] * simplex.points[i].a;
    result.b += simplex.weights[i] * simplex.points[i].b;
  }
  while (simplex.size < 4) {
    const Vec3<Scalar>& base = simplex.points[0].difference;
    // Directions that leave the simplex.
    std::array<Vec3<Scalar>, 6> directions;
    int count = 0;
    Vec3<Scalar> edge = Vec3<Scalar>::Zero();
    const auto both_ways = [&](const Vec3<Scalar>& direction) {
      directions[count++] = direction;
      directions[count++] = -direction;
    };
    if (simplex.size == 1) {
      for (int axis = 0; axis < 3; ++axis) both_ways(Vec3<Scalar>::Unit(axis));
    } else if (simplex.size == 2) {
      edge = (simplex.points[1].difference - base).normalized();
      const Vec3<Scalar> across = some_normal(edge);
      both_ways(across);
      both_ways(edge.cross(across));
    } else {
      const TrianglePlane<Scalar> plane = triangle_plane<Scalar>(
          {base, simplex.points[1].difference, simplex.points[2].difference});
      if (plane.flat) return false;
      both_ways(plane.normal.normalized());
    }

    Scalar furthest = 0;
    DifferencePoint<Scalar> best = simplex.points[0];
    for (int i = 0; i < count; ++i) {
      const DifferencePoint<Scalar> point = pair.support(directions[i]);
      const Scalar height = directions[i].dot(point.difference);
      if (height < result.upper) {
        result.upper = height;
        result.normal = directions[i];
      }
      const Vec3<Scalar> off = point.difference - base;
      const Scalar distance = simplex.size == 1   ? off.norm()
                              : simplex.size == 2 ? off.cross(edge).norm()
                                                  : std::abs(directions[i].dot(off));
      if (distance > furthest) {
        furthest = distance;
        best = point;
      }
    }
    if (!(furthest > flat)) {
      result.end = ExpansionEnd::flat;
      return false;
    }
    simplex.points[simplex.size++] = best;
    result.upper = std::numeric_limits<Scalar>::infinity();
  }
  return true;
}

template <class Scalar>
bool ExpandingPolytope<Scalar>::start(Simplex<Scalar> tetrahedron) {
  heap_.clear();
  unused_.clear();
  first_fresh_ = 0;
  full_ = false;
  best_face_ = -1;

  auto& p = tetrahedron.points;
  const TrianglePlane<Scalar> base =
      triangle_plane<Scalar>({p[0].difference, p[1].difference, p[2].difference});
  const Vec3<Scalar> side = p[3].difference - p[base.base].difference;
  if (base.normal.dot(side) > 0) std::swap(p[1], p[2]);
  vertices_.assign(p.begin(), p.end());
  static constexpr std::array<std::array<int, 3>, 4> corners = {
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  static constexpr std::array<std::array<int, 3>, 4> beside = {
      {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}}};
  for (int f = 0; f < 4; ++f) {
    if (new_face(corners[f][0], corners[f][1], corners[f][2], -1) != f) return false;
    faces_[f].neighbours = beside[f];
    push(f, faces_[f].distance);
  }
  return true;
}

// Makes an outward face; `behind` is across its first edge. No such face: it would have the
// origin outside, or neither it nor the one behind has a plane.
template <class Scalar>
int ExpandingPolytope<Scalar>::new_face(int a, int b, int c, int behind) {
  const std::array<Vec3<Scalar>, 3> corners = {at(a), at(b), at(c)};
  const TrianglePlane<Scalar> plane = triangle_plane(corners);
  const int index = unused_.empty() ? first_fresh_ : unused_.back();
  Face& face = faces_[index];
  face.flat = plane.flat;
  if (!plane.flat) {
    face.normal = plane.normal.normalized();
    face.distance = face.normal.dot(corners[plane.base]);
  } else if (behind >= 0) {
    face.normal = faces_[behind].normal;
    face.distance = faces_[behind].distance;
  } else {
    return -1;
  }
  if (!(face.distance >= -2 * SupportPair<Scalar>::rounding)) return -1;
  if (unused_.empty()) {
    ++first_fresh_;
  } else {
    unused_.pop_back();
  }
  face.vertices = {a, b, c};
  face.neighbours = {behind, -1, -1};
  face.born = ++births_;
  face.measured = false;
  face.seen = 0;
  face.visible = false;
  return index;
}

template <class Scalar>
void ExpandingPolytope<Scalar>::push(int face, Scalar distance) {
  if (heap_.size() == heap_.capacity()) {
    std::erase_if(heap_, [&](const HeapEntry& e) { return faces_[e.face].born != e.born; });
    std::make_heap(heap_.begin(), heap_.end());
  }
  heap_.push_back({distance, face, faces_[face].born});
  std::push_heap(heap_.begin(), heap_.end());
}

// Planes are never further than their triangles, so they serve until one comes up.
template <class Scalar>
int ExpandingPolytope<Scalar>::pop_nearest(Scalar& distance) {
  while (!heap_.empty()) {
    const HeapEntry top = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
    Face& face = faces_[top.face];
    if (face.born != top.born) continue;
    if (!face.measured) {
      face.measured = true;
      Simplex<Scalar> triangle;
      triangle.size = 3;
      for (int i = 0; i < 3; ++i) triangle.points[i].difference = at(face.vertices[i]);
      const Scalar measured = reduce_to_nearest(triangle).distance;
      if (measured > top.distance && !heap_.empty() && measured > heap_.front().distance) {
        push(top.face, measured);
        continue;
      }
      distance = measured;
      return top.face;
    }
    distance = top.distance;
    return top.face;
  }
  return -1;
}

// True where the origin is on the inner side of every face, beyond doubt.
template <class Scalar>
bool ExpandingPolytope<Scalar>::encloses_origin() const {
  for (int f = 0; f < first_fresh_; ++f) {
    const Face& face = faces_[f];
    if (face.born == 0 || face.flat) continue;
    const std::array<Vec3<Scalar>, 3> corners = {at(face.vertices[0]), at(face.vertices[1]),
                                                 at(face.vertices[2])};
    const Scalar doubt = lever(project_origin(triangle_plane(corners), corners));
    if (!(face.distance > doubt * SupportPair<Scalar>::rounding)) return false;
  }
  return true;
}

// Puts the cone from the point over the horizon in the place of the faces that the point sees.
// False, and nothing changed, where rounding leaves no proper horizon or cone.
template <class Scalar>
bool ExpandingPolytope<Scalar>::expand_face(int face, const DifferencePoint<Scalar>& point,
                                            Scalar upper) {
  if (!find_horizon(face, point.difference)) return false;
  if (unused_.size() + faces_.size() - first_fresh_ < horizon_.size()) {
    full_ = true;
    return false;
  }
  const int vertex = static_cast<int>(vertices_.size());
  vertices_.push_back(point);
  made_.clear();
  for (const HorizonEdge& edge : horizon_) {
    const int made = new_face(edge.tail, edge.head, vertex, edge.face);
    if (made < 0) {
      for (const int undo : made_) {
        faces_[undo].born = 0;
        unused_.push_back(undo);
      }
      vertices_.pop_back();
      return false;
    }
    made_.push_back(made);
  }
  const std::size_t count = made_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Face& next_to_it = faces_[horizon_[i].face];
    for (int k = 0; k < 3; ++k) {
      if (next_to_it.vertices[k] == horizon_[i].head) next_to_it.neighbours[k] = made_[i];
    }
    faces_[made_[i]].neighbours[1] = made_[(i + 1) % count];
    faces_[made_[i]].neighbours[2] = made_[(i + count - 1) % count];
    const Scalar distance = faces_[made_[i]].distance;
    if (!(distance > upper + SupportPair<Scalar>::rounding)) push(made_[i], distance);
  }
  for (const int gone : visible_) {
    faces_[gone].born = 0;
    unused_.push_back(gone);
  }
  return true;
}

// Walks over the faces that the point sees, anticlockwise, so that the edges where it sees no
// further come out in order. True where they form one ring, which meets no vertex twice.
template <class Scalar>
bool ExpandingPolytope<Scalar>::find_horizon(int face, const Vec3<Scalar>& point) {
  ++visit_;
  constexpr Scalar seen_above = SupportPair<Scalar>::rounding / 4;
  horizon_.clear();
  visible_.clear();
  path_.clear();
  const auto enter = [&](int visible, int edges) {
    faces_[visible].seen = visit_;
    faces_[visible].visible = true;
    visible_.push_back(visible);
    path_.emplace_back(visible, edges);
  };
  // An entry's number counts the edges still to cross: edge 3 - n of the three, or of the two that
  // follow the one that was crossed to come in; that one is kept in the upper bits.
  enter(face, 3);
  while (!path_.empty()) {
    auto& [at_face, state] = path_.back();
    const int left = state & 3;
    if (left == 0) {
      path_.pop_back();
      continue;
    }
    --state;
    const int edge = ((state >> 2) + 3 - left) % 3;
    const Face& here = faces_[at_face];
    const int tail = here.vertices[edge];
    const int head = here.vertices[(edge + 1) % 3];
    const int other = here.neighbours[edge];
    Face& beyond = faces_[other];
    if (beyond.seen != visit_) {
      beyond.seen = visit_;
      beyond.visible = beyond.normal.dot(point) - beyond.distance > seen_above;
      if (beyond.visible) {
        int entry = 0;
        while (entry < 2 && beyond.vertices[entry] != head) ++entry;
        enter(other, entry << 2 | 2);
        continue;
      }
    }
    if (!beyond.visible) horizon_.push_back({tail, head, other});
  }
  if (horizon_.size() < 3) return false;
  for (std::size_t i = 0; i < horizon_.size(); ++i) {
    const HorizonEdge& edge = horizon_[i];
    if (edge.head != horizon_[(i + 1) % horizon_.size()].tail) return false;
    if (ring_[edge.tail] == visit_ || at(edge.tail) == point) return false;
    ring_[edge.tail] = visit_;
  }
  return true;
}

// The origin's projection on the face of the upper bound; of several faces in that plane, the one
// that it falls on.
template <class Scalar>
void ExpandingPolytope<Scalar>::find_witnesses(Expansion<Scalar>& result) const {
  if (best_face_ < 0) return;
  std::array<Scalar, 3> weights = {1, 1, 1};
  std::array<int, 3> vertices = best_vertices_;
  Scalar least = -std::numeric_limits<Scalar>::infinity();
  const auto consider = [&](const std::array<int, 3>& candidate) {
    const std::array<Vec3<Scalar>, 3> corners = {at(candidate[0]), at(candidate[1]),
                                                 at(candidate[2])};
    const TrianglePlane<Scalar> plane = triangle_plane(corners);
    if (plane.flat) return;
    const std::array<Scalar, 3> w = project_origin(plane, corners);
    const Scalar smallest = std::min({w[0], w[1], w[2]});
    if (!(smallest > least)) return;
    least = smallest;
    weights = w;
    vertices = candidate;
  };
  consider(best_vertices_);
  if (least < 0) {
    const Vec3<Scalar> normal = result.normal;
    const Scalar height = normal.dot(at(best_vertices_[0]));
    for (int f = 0; f < first_fresh_; ++f) {
      const Face& face = faces_[f];
      if (face.born == 0 || face.flat) continue;
      const auto in_plane = [&](int vertex) {
        return std::abs(normal.dot(at(vertex)) - height) <= SupportPair<Scalar>::rounding;
      };
      if (std::all_of(face.vertices.begin(), face.vertices.end(), in_plane)) {
        consider(face.vertices);
      }
    }
  }
  Scalar sum = 0;
  for (Scalar& weight : weights) sum += weight = std::max(weight, Scalar{0});
  result.a.setZero();
  result.b.setZero();
  for (int i = 0; i < 3; ++i) {
    result.a += weights[i] / sum * vertices_[vertices[i]].a;
    result.b += weights[i] / sum * vertices_[vertices[i]].b;
  }
}

template class ExpandingPolytope<float>;
template class ExpandingPolytope<double>;

}  // namespace touchstone
