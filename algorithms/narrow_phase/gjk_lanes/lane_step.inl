// Part of gjk-lanes, included by lane_gjk.inl: one step of GJK in lanes. It takes a simplex and a
// new corner to the feature nearest to the origin, for simplices of all sizes together.
#include "algorithms/kernels/batch/pair_lanes.inl"
#include "algorithms/kernels/epa/triangle_lanes.inl"

template <class Scalar>
struct Corner {
  Vector3<Scalar> point;  // of the difference
  Vector3<Scalar> on_a;   // on the core of a; only if points are requested
};

// A simplex of up to three corners; corners that a lane does not have are arbitrary numbers.
template <class Scalar>
struct LaneSimplex {
  Corner<Scalar> b, c, d;
  typename Simd<Scalar>::Mask has_b, has_c, has_d;
};

template <class Scalar>
struct LaneStep {
  Vector3<Scalar> search;  // from the origin through the nearest point, of any length
  // Lanes as bits: with a search direction; with the origin surely inside; with the origin
  // apparently inside, but too near a face.
  unsigned found, inside, unsure;
};

template <class Scalar>
struct Tetrahedron {
  Corner<Scalar> a, b, c, d;
};

template <class Scalar, bool points>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE void put_where(typename Simd<Scalar>::Mask mask,
                                                   const Corner<Scalar>& from, Corner<Scalar>& to) {
  to.point = select<Scalar>(mask, from.point, to.point);
  if constexpr (points) to.on_a = select<Scalar>(mask, from.on_a, to.on_a);
}

// Returns those of the `asked` lanes in which a tetrahedron contains the origin whatever rounding
// did to its corners: the determinants of the corners by threes, each with the origin, keep their
// signs. `sides` are the determinants of the faces at a. Corners that are off by r change the
// determinant of p, q and s by at most r (|q x s| + |p x s| + |p x q|) + r^2 (|p| + |q| + |s|) +
// r^3; its own rounding is less than 20 u times the squares of the lengths and the greatest length.
// Because |q||s| + |p||s| + |p||q| <= p^2 + q^2 + s^2, a quick test suffices for most; if the
// origin is near a face, only the products themselves decide.
template <class Scalar>
TOUCHSTONE_TARGET unsigned surely_inside(const Vector3<Scalar>& a, const Vector3<Scalar>& b,
                                         const Vector3<Scalar>& c, const Vector3<Scalar>& d,
                                         const typename Simd<Scalar>::Vector sides[3],
                                         Scalar corner_error, unsigned asked) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  const Vector opposite =
      dot<Scalar>(b, cross<Scalar>(difference<Scalar>(d, b), difference<Scalar>(c, b)));
  const Vector all[4] = {sides[0], sides[1], sides[2], opposite};
  const auto keep_signs = [&](const Vector errors[4]) TOUCHSTONE_TARGET {
    Vector least = all[0] - errors[0], most = all[0] + errors[0];
    for (int k = 1; k < 4; ++k) {
      least = Lanes::min(least, all[k] - errors[k]);
      most = Lanes::max(most, all[k] + errors[k]);
    }
    const Vector zero = Lanes::broadcast(0);
    return asked & Lanes::to_bits(either(Lanes::less(zero, least), Lanes::less(most, zero)));
  };
  const Vector aa = dot<Scalar>(a, a), bb = dot<Scalar>(b, b);
  const Vector cc = dot<Scalar>(c, c), dd = dot<Scalar>(d, d);
  const Vector squares[4] = {aa + bb + cc, aa + cc + dd, aa + dd + bb, bb + cc + dd};
  const Vector greatest = Lanes::max(Lanes::max(aa, bb), Lanes::max(cc, dd));
  const Vector longest = Lanes::sqrt(greatest);
  const Vector rounding = 20 * unit_roundoff<Scalar> * longest;
  const Vector error = Lanes::broadcast(Scalar(1.5) * corner_error) + rounding;
  Vector errors[4];
  for (int k = 0; k < 4; ++k) errors[k] = error * squares[k];
  const unsigned quickly = keep_signs(errors);
  if (quickly == asked) return quickly;
  const auto area = [](const Vector3<Scalar>& p, const Vector3<Scalar>& q) TOUCHSTONE_TARGET {
    const Vector3<Scalar> product = cross<Scalar>(p, q);
    return Lanes::sqrt(dot<Scalar>(product, product));
  };
  const Vector ab = area(a, b), ac = area(a, c), ad = area(a, d);
  const Vector bc = area(b, c), cd = area(c, d), db = area(d, b);
  // The areas' own rounding is at most 16 u of the greatest square; relative errors are at most 1 /
  // 64.
  const Vector areas[4] = {ab + bc + ac, ac + cd + ad, ad + db + ab, bc + cd + db};
  const Scalar r = corner_error * (Scalar(1) + Scalar(1) / 64);
  const Vector rest =
      (16 * unit_roundoff<Scalar> * greatest + 3 * r * longest) + Lanes::broadcast(r * r);
  for (int k = 0; k < 4; ++k) errors[k] = r * (areas[k] + rest) + rounding * squares[k];
  return quickly | keep_signs(errors);
}

// Like surely_inside, for a double pyramid: a tetrahedron, and a corner e on the other side of the
// face b, c, d. If the origin is too near that face for either half, it is well inside one of the
// three tetrahedra around the axis a e.
template <class Scalar>
TOUCHSTONE_TARGET unsigned surely_between(const Tetrahedron<Scalar>& half, const Vector3<Scalar>& e,
                                          Scalar corner_error, unsigned asked) {
  using Vector = typename Simd<Scalar>::Vector;
  const Vector3<Scalar>& a = half.a.point;
  const Vector3<Scalar>* const ring[4] = {&half.b.point, &half.c.point, &half.d.point,
                                          &half.b.point};
  const Vector3<Scalar> ae = difference<Scalar>(e, a);
  unsigned inside = 0;
  for (int k = 0; k < 3 && inside != asked; ++k) {
    const Vector3<Scalar>&p = *ring[k], &q = *ring[k + 1];
    const Vector3<Scalar> ap = difference<Scalar>(p, a), aq = difference<Scalar>(q, a);
    const Vector sides[3] = {dot<Scalar>(a, cross<Scalar>(ae, ap)),
                             dot<Scalar>(a, cross<Scalar>(ap, aq)),
                             dot<Scalar>(a, cross<Scalar>(aq, ae))};
    inside |= surely_inside<Scalar>(a, e, p, q, sides, corner_error, asked);
  }
  return inside;
}

// Reduces the simplex in the lanes `on` to the nearest feature, which contains the new corner.
// `solid`: some lane has d. Regions follow from dot products of edges: bc is that of the edges from
// the new corner a to b and to c. If rounding lets regions overlap, the first is taken in the order
// corner, edges ad, ac, ab, faces adb, acd, abc. `around` becomes the tetrahedron if the origin is
// inside but not surely; with `points` also if it is surely inside.
template <class Scalar, bool points, bool solid>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE LaneStep<Scalar> take_step(LaneSimplex<Scalar>& simplex,
                                                               const Corner<Scalar>& corner,
                                                               typename Simd<Scalar>::Mask on,
                                                               Scalar corner_error,
                                                               Tetrahedron<Scalar>& around) {
  using Lanes = Simd<Scalar>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  const Vector zero = Lanes::broadcast(0);
  const Corner<Scalar> b = simplex.b, c = simplex.c, d = simplex.d;
  const Mask has_b = both(on, simplex.has_b), has_c = both(on, simplex.has_c);
  const Mask no_c = without(on, has_c), none = without(on, on);
  const Vector3<Scalar>& a = corner.point;

  const Vector3<Scalar> ab = difference<Scalar>(b.point, a), ac = difference<Scalar>(c.point, a);
  const Vector along_b = -dot<Scalar>(ab, a), along_c = -dot<Scalar>(ac, a);
  const Vector bb = dot<Scalar>(ab, ab), cc = dot<Scalar>(ac, ac), bc = dot<Scalar>(ab, ac);
  const Mask past_b = both(has_b, Lanes::less(zero, along_b));
  const Mask past_c = both(has_c, Lanes::less(zero, along_c));
  // Masks of projections beyond an edge, as seen from the third corner of a face.
  const Mask b_from_c = Lanes::less(bb * along_c - bc * along_b, zero);
  const Mask c_from_b = Lanes::less(cc * along_b - bc * along_c, zero);
  Vector3<Scalar> normal = cross<Scalar>(ab, ac);
  Vector side = dot<Scalar>(a, normal);
  Mask past = either(past_b, past_c);
  Mask edge_b = both(past_b, either(b_from_c, no_c)), edge_c = both(past_c, c_from_b);
  Mask face_b = without(without(has_c, b_from_c), c_from_b);
  Mask edge_d = none, face_c = none, face_d = none;
  LaneStep<Scalar> step;
  step.inside = step.unsure = 0;
  Vector3<Scalar> edge = select<Scalar>(edge_c, ac, ab);
  Vector square = Lanes::select(edge_c, cc, bb), along = Lanes::select(edge_c, along_c, along_b);
  if constexpr (solid) {
    const Mask has_d = both(on, simplex.has_d), no_d = without(on, has_d);
    const Vector3<Scalar> ad = difference<Scalar>(d.point, a);
    const Vector along_d = -dot<Scalar>(ad, a);
    const Vector dd = dot<Scalar>(ad, ad), cd = dot<Scalar>(ac, ad), db = dot<Scalar>(ad, ab);
    const Mask past_d = both(has_d, Lanes::less(zero, along_d));
    const Mask c_from_d = Lanes::less(cc * along_d - cd * along_c, zero);
    const Mask d_from_c = Lanes::less(dd * along_c - cd * along_d, zero);
    const Mask d_from_b = Lanes::less(dd * along_b - db * along_d, zero);
    const Mask b_from_d = Lanes::less(bb * along_d - db * along_b, zero);
    const Vector3<Scalar> acd = cross<Scalar>(ac, ad), adb = cross<Scalar>(ad, ab);
    const Vector volume = dot<Scalar>(ad, normal);
    const Vector sides[3] = {side, dot<Scalar>(a, acd), dot<Scalar>(a, adb)};
    const Mask out_b = Lanes::less(zero, sides[0] * volume);
    const Mask out_c = Lanes::less(zero, sides[1] * volume);
    const Mask out_d = Lanes::less(zero, sides[2] * volume);
    past = either(past, past_d);
    edge_b = both(edge_b, either(b_from_d, no_d));
    edge_c = both(edge_c, either(c_from_d, no_d));
    edge_d = both(both(past_d, d_from_b), d_from_c);
    face_b = both(face_b, either(out_b, no_d));
    face_c = without(without(both(has_d, out_c), c_from_d), d_from_c);
    face_d = without(without(both(has_d, out_d), d_from_b), b_from_d);
    edge = select<Scalar>(edge_d, ad, select<Scalar>(edge_c, ac, ab));
    square = Lanes::select(edge_d, dd, Lanes::select(edge_c, cc, bb));
    along = Lanes::select(edge_d, along_d, Lanes::select(edge_c, along_c, along_b));
    normal = select<Scalar>(face_d, adb, select<Scalar>(face_c, acd, normal));
    side = Lanes::select(face_d, sides[2], Lanes::select(face_c, sides[1], side));
    step.inside = Lanes::to_bits(without(has_d, either(either(out_b, out_c), out_d)));
    if (step.inside != 0) {
      const unsigned all = step.inside;
      step.inside = surely_inside<Scalar>(a, b.point, c.point, d.point, sides, corner_error, all);
      step.unsure = all & ~step.inside;
      if (points || step.unsure != 0) around = {corner, b, c, d};
    }
  }

  const Mask on_corner = without(on, past);
  const Mask on_edge = without(either(either(edge_b, edge_c), edge_d), on_corner);
  const Mask on_face = without(without(either(either(face_b, face_c), face_d), on_corner), on_edge);
  const Vector one = Lanes::broadcast(1), inverse = one / square;
  Vector3<Scalar> search = moved<Scalar>(a, along * inverse, edge);
  // The remaining component along the edge is rounding, and would tilt the support plane.
  search = moved<Scalar>(search, -dot<Scalar>(search, edge) * inverse, edge);
  const Vector3<Scalar> outward =
      scaled<Scalar>(Lanes::select(Lanes::less(side, zero), -one, one), normal);
  step.search = select<Scalar>(on_corner, a, select<Scalar>(on_edge, search, outward));
  step.found = Lanes::to_bits(either(either(on_edge, on_face), on_corner)) & ~step.unsure;

  // Corners kept beside a: for ab and abc first b, for ad and adb first d, and c for the others.
  const Mask by_b = without(without(face_b, face_c), face_d);
  const Mask first_b = either(without(without(edge_b, edge_c), edge_d), both(by_b, on_face));
  put_where<Scalar, points>(by_b, c, simplex.d);
  if constexpr (solid) put_where<Scalar, points>(face_d, b, simplex.d);
  put_where<Scalar, points>(first_b, b, simplex.c);
  if constexpr (solid) {
    put_where<Scalar, points>(either(edge_d, both(face_d, on_face)), d, simplex.c);
  }
  put_where<Scalar, points>(on, corner, simplex.b);
  simplex.has_b = either(simplex.has_b, on);
  simplex.has_c = either(without(simplex.has_c, on), either(on_edge, on_face));
  simplex.has_d = either(without(simplex.has_d, on), on_face);
  return step;
}
