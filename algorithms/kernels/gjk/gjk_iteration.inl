// The iteration of gjk_iteration.h, on vectors of four numbers of which three are used.
// gjk_iteration_levels.inl includes this file once for each level of vector instructions, inside
// that level's namespace. Results are equal at every level.

template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Quad<Scalar> quad(const Vec3<Scalar>& v) {
  return Quad<Scalar>{v.x(), v.y(), v.z(), 0};
}
template <class Scalar>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vec3<Scalar> vec(const Quad<Scalar>& q) {
  return {q[0], q[1], q[2]};
}
template <class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE auto dot(const Vector& a, const Vector& b) {
  const Vector products = a * b;
  return products[0] + products[1] + products[2];
}
template <class Vector>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector cross(const Vector& a, const Vector& b) {
  const auto turn = [](const Vector& v)
                        TOUCHSTONE_TARGET { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  return turn(a * turn(b) - turn(a) * b);
}

// The support map of a PosedShape, with its own code for boxes and for hulls that are scanned.
// Other cores use the PosedShape.
template <class Scalar>
class QuadShape {
 public:
  using Vector = Quad<Scalar>;

  TOUCHSTONE_TARGET explicit QuadShape(PosedShape<Scalar>& turned) : turned_(turned) {
    const Mat3<Scalar>& m = turned.matrix();
    for (int i = 0; i < 3; ++i) {
      columns_[i] = Vector{m(0, i), m(1, i), m(2, i), 0};
      rows_[i] = Vector{m(i, 0), m(i, 1), m(i, 2), 0};
    }
  }

  // Sets `corner` to the corner's index, if the core has corners.
  template <class Which>
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector support(const Vector& direction,
                                                     std::uint32_t& corner) {
    using Core = typename SupportShape<Scalar>::Core;
    const SupportShape<Scalar>& shape = turned_.shape();
    const Core core = Which::of(shape);
    const Vector d = rows_[0] * direction[0] + rows_[1] * direction[1] + rows_[2] * direction[2];
    if (core == Core::hull && shape.cells.empty()) {
      corner = furthest_index<Scalar>(shape.scanned_hull(), d[0], d[1], d[2]);
      const Vec3<Scalar> v = shape.scanned_vertex(corner);
      return turn(v.x(), v.y(), v.z());
    }
    if (core == Core::box) {
      const Vec3<Scalar>& e = shape.extents;
      corner = negative(d[0]) | negative(d[1]) << 1 | negative(d[2]) << 2;
      return turn(std::copysign(e.x(), d[0]), std::copysign(e.y(), d[1]),
                  std::copysign(e.z(), d[2]));
    }
    const Vector point = quad(turned_.template support<Which>(vec<Scalar>(direction)));
    switch (core) {
      case Core::point: corner = 0; break;
      case Core::segment: corner = negative(d[2]) << 2; break;
      case Core::hull: corner = turned_.last_corner(); break;
      default: corner = no_corner;
    }
    return point;
  }

 private:
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE static std::uint32_t negative(Scalar x) {
    return std::signbit(x) ? 1 : 0;
  }
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector turn(Scalar x, Scalar y, Scalar z) const {
    return columns_[0] * x + columns_[1] * y + columns_[2] * z;
  }

  PosedShape<Scalar>& turned_;
  Vector columns_[3], rows_[3];
};

// A vector from the origin towards a feature's nearest point, of any length, and the corners of the
// feature as bits.
template <class Scalar>
struct SearchDirection {
  Quad<Scalar> vector;
  unsigned corners;
};

// The features that contain the newest corner w[0]; a step cannot end on others.
template <class Scalar>
class QuickSimplex {
 public:
  using Vector = Quad<Scalar>;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE static SearchDirection<Scalar> segment(const Vector& a,
                                                                             const Vector& b) {
    const Vector edge = b - a;
    const Scalar along = -dot(a, edge);
    if (!(along > 0)) return {a, 1};
    return on_edge(a, edge, along, 1);
  }

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE static SearchDirection<Scalar> triangle(const Vector& a,
                                                                              const Vector& b,
                                                                              const Vector& c) {
    const Vector ab = b - a, ac = c - a;
    return on_triangle(a, ab, ac, cross(ab, ac), 1, 2);
  }

  // Returns all corners if the origin is inside.
  TOUCHSTONE_TARGET static SearchDirection<Scalar> tetrahedron(const Vector& a, const Vector& b,
                                                               const Vector& c, const Vector& d) {
    const Vector ab = b - a, ac = c - a, ad = d - a;
    const Vector abc = cross(ab, ac), acd = cross(ac, ad), adb = cross(ad, ab);
    const Scalar volume = dot(ad, abc);
    const auto beyond = [&](const Vector& normal) TOUCHSTONE_TARGET {
      const Scalar side = dot(a, normal);
      return volume > 0 ? side > 0 : side < 0;
    };
    const unsigned faces =
        unsigned{beyond(abc)} | unsigned{beyond(acd)} << 1 | unsigned{beyond(adb)} << 2;
    if (faces == 0) return {Vector{}, all_corners};
    SearchDirection<Scalar> best{a, 1};
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (unsigned face = 0; face < 3; ++face) {
      if ((faces >> face & 1) == 0) continue;
      const SearchDirection<Scalar> search = face == 0   ? on_triangle(a, ab, ac, abc, 1, 2)
                                             : face == 1 ? on_triangle(a, ac, ad, acd, 2, 3)
                                                         : on_triangle(a, ad, ab, adb, 3, 1);
      if (faces == 1u << face) return search;
      const Scalar reach = dot(search.vector, a);  // constant over the feature
      const Scalar squared = reach * reach / dot(search.vector, search.vector);
      if (!(squared < least)) continue;
      least = squared;
      best = search;
    }
    return best;
  }

 private:
  // `along` is the origin's coordinate along the edge from the newest corner, times its length.
  TOUCHSTONE_TARGET TOUCHSTONE_INLINE static SearchDirection<Scalar> on_edge(const Vector& a,
                                                                             const Vector& edge,
                                                                             Scalar along, int b) {
    return {dot(edge, edge) * a + along * edge, 1u | 1u << b};
  }

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE static SearchDirection<Scalar> on_triangle(
      const Vector& a, const Vector& ab, const Vector& ac, const Vector& normal, int b, int c) {
    const bool beyond_ab = dot(cross(ab, normal), a) < 0;
    const bool beyond_ac = dot(cross(normal, ac), a) < 0;
    if (!beyond_ab && !beyond_ac) {
      return {dot(normal, a) < 0 ? -normal : normal, 1u | 1u << b | 1u << c};
    }
    // If the origin is beyond both edges, it projects on at most one of them.
    const Scalar along_ab = -dot(ab, a), along_ac = -dot(ac, a);
    if (beyond_ab && along_ab > 0) return on_edge(a, ab, along_ab, b);
    if (beyond_ac && along_ac > 0) return on_edge(a, ac, along_ac, c);
    return {a, 1};
  }
};

// Points of the difference and of the two cores; the newest is last. `numbered`: with the indices
// of their corners.
template <class Scalar, bool numbered>
struct QuadSimplex {
  using Vector = Quad<Scalar>;
  struct Point {
    Vector difference, a, b;
  };
  Point points[4];
  CornerPair corners[numbered ? 4 : 1];
  int size = 0;

  TOUCHSTONE_TARGET TOUCHSTONE_INLINE bool holds(const Vector& w) const {
    bool held = false;
    for (int i = 0; i < size; ++i) {
      const Vector& own = points[i].difference;
      held |= (own[0] == w[0]) & (own[1] == w[1]) & (own[2] == w[2]);
    }
    return held;
  }

  // Returns the vector to the nearest point and keeps only its feature's corners. The function is
  // not inlined, because the iteration's registers would not suffice; so all cores for which an
  // iteration is compiled share this code.
  __attribute__((noinline)) TOUCHSTONE_TARGET Vector reduce() {
    const int newest = size - 1;
    const auto w = [&](int i)
                       TOUCHSTONE_TARGET -> const Vector& { return points[newest - i].difference; };
    SearchDirection<Scalar> search;
    switch (size) {
      case 1: return w(0);
      case 2: search = QuickSimplex<Scalar>::segment(w(0), w(1)); break;
      case 3: search = QuickSimplex<Scalar>::triangle(w(0), w(1), w(2)); break;
      default: search = QuickSimplex<Scalar>::tetrahedron(w(0), w(1), w(2), w(3));
    }
    int kept = 0;
    for (int i = 0; i <= newest; ++i) {
      if ((search.corners >> (newest - i) & 1) == 0) continue;
      if (kept != i) {
        points[kept] = points[i];
        if constexpr (numbered) corners[kept] = corners[i];
      }
      ++kept;
    }
    size = kept;
    return search.vector;
  }

  TOUCHSTONE_TARGET void read(const Simplex<Scalar>& simplex) {
    size = simplex.size;
    for (int i = 0; i < size; ++i) {
      const DifferencePoint<Scalar>& point = simplex.points[i];
      points[i] = {quad(point.difference), quad(point.a), quad(point.b)};
      if constexpr (numbered) corners[i] = simplex.corners[i];
    }
  }

  TOUCHSTONE_TARGET void write(Simplex<Scalar>& simplex) const {
    simplex.size = size;
    for (int i = 0; i < size; ++i) {
      if constexpr (numbered) simplex.corners[i] = corners[i];
      simplex.points[i] = {vec<Scalar>(points[i].difference), vec<Scalar>(points[i].a),
                           vec<Scalar>(points[i].b)};
    }
  }
};

// `found` is passed in because GCC 12, if it sets its corners in wide registers here, leaves them
// in a state that slows all later code.
template <bool numbered, class CoreOfA, class CoreOfB, class Scalar>
TOUCHSTONE_TARGET void fast_gjk_at(SupportPair<Scalar>& pair, const FastGjkGoal& goal,
                                   Scalar tolerance, const FastGjkStart<Scalar>& start,
                                   FastGjkResult<Scalar>& found) {
  using Vector = Quad<Scalar>;
  // The square of the least length; shorter vectors have lost their digits, or nearly so.
  constexpr Scalar shortest = sizeof(Scalar) == 8 ? static_cast<Scalar>(1e-200) : Scalar{1e-24f};
  // A point that is already in the simplex is as far along the direction as the others, up to
  // rounding.
  constexpr Scalar as_far = 1024 * std::numeric_limits<Scalar>::epsilon();
  const Scalar apart = pair.radius() + SupportPair<Scalar>::rounding;
  const Scalar far = goal.only_apart ? apart : apart + static_cast<Scalar>(goal.margin);
  QuadShape<Scalar> a(pair.a()), b(pair.b());
  const Vector centre_b = quad(pair.centre_b());
  QuadSimplex<Scalar, numbered> simplex;
  simplex.read(start.simplex);
  Vector search = quad(start.direction);
  Scalar squared = dot(search, search);
  if (!(squared > shortest)) {
    search = Vector{1, 0, 0, 0};
    squared = 1;
  }
  Scalar length = std::sqrt(squared);
  Scalar nearest = simplex.size > 0 ? length : std::numeric_limits<Scalar>::infinity();
  while (found.iterations < goal.most_iterations) {
    ++found.iterations;
    pair.count_support();
    CornerPair corners;
    const Vector on_a = a.template support<CoreOfA>(-search, corners.a);
    const Vector on_b = b.template support<CoreOfB>(search, corners.b) + centre_b;
    const Vector point = on_a - on_b;
    found.lower = dot(search, point) / length;
    if (found.lower > apart && (found.lower > far || nearest - found.lower <= tolerance)) {
      found.end = found.lower > far ? FastGjkEnd::apart : FastGjkEnd::near;
      found.direction = vec<Scalar>(search);
      break;
    }
    if (nearest - found.lower <= as_far && simplex.holds(point)) break;
    if constexpr (numbered) simplex.corners[simplex.size] = corners;
    simplex.points[simplex.size++] = {point, on_a, on_b};
    found.moved = true;
    if (goal.ends_at_plane && simplex.size == 1 && found.lower <= SupportPair<Scalar>::rounding &&
        (goal.ends_behind || found.lower >= -SupportPair<Scalar>::rounding)) {
      found.end = FastGjkEnd::at_plane;
      break;
    }
    const Vector before = search;
    search = simplex.reduce();
    if (simplex.size == 4) {
      simplex.write(found.simplex);
      if (!is_surely_inside(found.simplex)) {
        // The origin is too near the face that the search came through. A corner behind it decides;
        // it has no index.
        if (numbered || found.iterations == goal.most_iterations) return;
        ++found.iterations;
        const auto behind = pair.template support<CoreOfA, CoreOfB>(vec<Scalar>(before));
        // No tetrahedron is around an origin that is this near to a support plane.
        const Scalar height = dot(before, quad(behind.difference));
        if (!(height > corner_rounding<Scalar> * std::sqrt(dot(before, before)))) return;
        if (!find_enclosing_tetrahedron(found.simplex, behind)) return;
      }
      found.end = FastGjkEnd::inside;
      return;
    }
    squared = dot(search, search);
    length = std::sqrt(squared);
    const Scalar last = nearest;
    nearest = dot(search, simplex.points[0].difference) / length;
    // This form of the comparisons ends the iteration for NaN.
    if (!(squared > shortest) || !(nearest < last)) break;
  }
  simplex.write(found.simplex);
}
