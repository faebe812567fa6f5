// EPA: grow a polytope inside the difference of two bodies, at the face nearest to the origin.
//
// The polytope's vertices are points of the difference, so the origin's distance from its nearest
// face is a lower bound on the depth; a support call along any unit vector gives an upper bound. It
// ends where they meet.
// Paper:   van den Bergen, "Proximity queries and penetration depth computation on 3D game
// objects", GDC 2001. Departs: both bounds are kept, and the upper one is the answer: that
// translation does separate. The horizon is checked to be one closed ring before the polytope is
// changed; a face that cannot be expanded is set aside and holds the lower bound down. A face
// without an area lies in its neighbour's plane. The start is a tetrahedron that may have the
// origin on its surface.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/kernels/simplex.h"

namespace touchstone {

// Where to stop, for the depth of the cores; lengths in the pair's unit.
template <class Scalar>
struct ExpansionGoal {
  Scalar tolerance;  // the bounds are this close
  // The lower bound exceeds `enough`, or the upper bound is no greater: for queries that only ask
  // for a verdict. Negative: go on to the tolerance.
  Scalar enough = -1;
  // The origin may prove to be outside: then a plane between is looked for, and a positive depth is
  // only claimed after all faces were checked.
  bool doubtful = false;
};

enum class ExpansionEnd : std::uint8_t {
  converged,  // the bounds are within the tolerance
  enough,     // they are on one side of goal.enough
  apart,      // a plane separates the origin from the difference: `upper` is negative
  flat,       // the difference has no volume: the depth is zero
  stuck,      // rounding: no face can be expanded
  cap,        // too many iterations
  capacity,   // too many faces
};

template <class Scalar>
struct Expansion {
  ExpansionEnd end = ExpansionEnd::stuck;
  Scalar lower = 0;  // bounds on the depth: the least distance from the origin to the
  Scalar upper = 0;  // difference's surface
  Vec3<Scalar> normal = Vec3<Scalar>::UnitX();  // outward, at the upper bound
  Vec3<Scalar> a = Vec3<Scalar>::Zero();        // the points of the cores with
  Vec3<Scalar> b = Vec3<Scalar>::Zero();        // a - b = depth * normal
  int iterations = 0;
};

template <class Scalar>
class ExpandingPolytope {
 public:
  // `max_iterations` >= 1; memory for that many is taken here, and none in a query.
  explicit ExpandingPolytope(int max_iterations);

  // The simplex has the origin inside or, up to rounding, on it; it may have any size.
  Expansion<Scalar> expand(SupportPair<Scalar>& pair, const Simplex<Scalar>& simplex,
                           const ExpansionGoal<Scalar>& goal);

 private:
  struct Face {
    std::array<int, 3> vertices;    // anticlockwise seen from outside
    std::array<int, 3> neighbours;  // across the edge from vertices[i] to vertices[i + 1]
    Vec3<Scalar> normal;
    Scalar distance;     // of the plane from the origin, which is inside
    bool measured;       // the heap has the distance of the triangle, not only of its plane
    std::uint64_t born;  // which face this was made as; 0: not in use
    std::uint64_t seen;  // the last search for a horizon that came by ...
    bool visible;        // ... and what it found
    bool flat;           // without an area: the plane is that of neighbours[0]
  };
  struct HeapEntry {
    Scalar distance;
    int face;
    std::uint64_t born;
    friend bool operator<(const HeapEntry& x, const HeapEntry& y) {
      return x.distance > y.distance;  // the standard heaps have the greatest on top
    }
  };
  struct HorizonEdge {
    int tail, head;  // as in the visible face
    int face;        // the one beyond, which stays
  };

  bool grow_to_tetrahedron(SupportPair<Scalar>& pair, Simplex<Scalar>& simplex,
                           Expansion<Scalar>& result);
  bool start(Simplex<Scalar> tetrahedron);
  int new_face(int a, int b, int c, int behind);  // -1: no such face
  void push(int face, Scalar distance);
  int pop_nearest(Scalar& distance);  // -1: none
  bool encloses_origin() const;
  bool expand_face(int face, const DifferencePoint<Scalar>& point, Scalar upper);
  bool find_horizon(int face, const Vec3<Scalar>& point);
  void find_witnesses(Expansion<Scalar>& result) const;
  const Vec3<Scalar>& at(int vertex) const { return vertices_[vertex].difference; }

  int max_iterations_;
  std::vector<DifferencePoint<Scalar>> vertices_;
  std::vector<Face> faces_;
  int first_fresh_ = 0;      // this face and those behind it were never used
  std::vector<int> unused_;  // faces before it
  std::vector<HeapEntry> heap_;
  std::vector<HorizonEdge> horizon_;
  std::vector<int> visible_, made_;        // faces, of this iteration
  std::vector<std::pair<int, int>> path_;  // faces entered, and the edges still to be crossed
  std::vector<std::uint64_t> ring_;  // of each vertex: the last search that had it on its horizon
  std::uint64_t visit_ = 0;          // the search
  std::uint64_t births_ = 0;
  int best_face_ = -1;  // the last to lower the upper bound, and its corners
  std::array<int, 3> best_vertices_{};
  bool full_ = false;
};

}  // namespace touchstone
