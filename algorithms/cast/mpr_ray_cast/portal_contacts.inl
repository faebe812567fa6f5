// Part of mpr-ray-cast-lanes, included by portal_lanes.inl: where paths meet closed portals, and the first try of the
// proof that the bodies are in contact a little later, as linear_cast.cpp and contact_proofs.h have it for one pair.

// The queries of a vector, and their numbers.
struct ContactLanes {
  static constexpr std::size_t width = Simd<double>::width;
  std::size_t count = 0;
  std::size_t query[width]{};
  alignas(64) double places[3][3][width]{}, along[3][width]{}, start[3][width]{},
      velocity[3][width]{}, plane[3][width]{};
  alignas(64) double time[width]{}, tolerance[width]{}, inner[width]{};
};

TOUCHSTONE_TARGET inline void load_contact(const PortalQuery& query, PortalAnswer& answer,
                                           std::size_t lane, ContactLanes& to) {
  // Bodies that touch at time 0 were parted by no plane, and touch along the portal's, up to two tolerances deep.
  if (!(answer.time > 0)) answer.plane = portal_normal(answer.places);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      to.places[corner][k][lane] = answer.places[corner].data()[k];
    to.along[k][lane] = answer.along.data()[k];
    to.start[k][lane] = query.pair->start().data()[k];
    to.velocity[k][lane] = query.pair->velocity().data()[k];
    to.plane[k][lane] = answer.plane.data()[k];
  }
  to.time[lane] = answer.time;
  to.tolerance[lane] = query.tolerance;
  to.inner[lane] = query.pair->inner_radius();
}

TOUCHSTONE_TARGET inline void prove_lanes(const ContactLanes& lanes,
                                          std::span<PortalAnswer> answers) {
  using Lanes = Simd<double>;
  using Vector = typename Lanes::Vector;
  using Mask = typename Lanes::Mask;
  const Vector zero = Lanes::broadcast(0), one = Lanes::broadcast(1);
  const Vector rounding = Lanes::broadcast(MovingPair::rounding);
  const Vector3<double> p[3] = {three_rows(lanes.places[0]), three_rows(lanes.places[1]),
                                three_rows(lanes.places[2])};
  const Vector3<double> along = three_rows(lanes.along), velocity = three_rows(lanes.velocity);
  const Vector time = Lanes::load(lanes.time);

  // Rounding may put the path a little outside of the portal; the weights are those of a point in it.
  Vector weights[3] = {side(p[1], p[2], along), side(p[2], p[0], along), side(p[0], p[1], along)};
  for (Vector& weight : weights) weight = Lanes::max(weight, zero);
  const Vector sum = weights[0] + weights[1] + weights[2];
  const Vector share = one / sum;
  for (Vector& weight : weights) weight = weight * share;
  const Vector3<double> met = moved<double>(
      moved<double>(scaled<double>(weights[0], p[0]), weights[1], p[1]), weights[2], p[2]);
  const Vector distance = length_of(moved<double>(met, -time, velocity));
  Mask proven =
      both(Lanes::less(zero, sum), Lanes::less_equal(distance, Lanes::load(lanes.tolerance)));

  // A little later the path is so deep behind the plane that rounding does not hide it.
  const Vector speed = -dot<double>(three_rows(lanes.plane), velocity);
  proven = both(proven, Lanes::less(zero, speed));
  const Vector deep = distance + Lanes::broadcast(256) * rounding;
  const Vector later = Lanes::min(time + deep / speed, one);
  const Vector3<double> point = moved<double>(met, -later, velocity);
  const Vector3<double> offset = moved<double>(three_rows(lanes.start), later, velocity);
  // The hull of the point and of the ball about -offset holds the origin (is_in_front_of_ball).
  const Vector length = length_of(point), inner = Lanes::load(lanes.inner);
  const Vector3<double> ahead_of = scaled<double>(one / length, point);
  const Vector ahead = dot<double>(ahead_of, offset);
  const Vector aside = length_of(moved<double>(offset, -ahead, ahead_of));
  const Vector doubt = Lanes::broadcast(2) * rounding * (ahead + length) / length + rounding;
  proven = both(proven, both(Lanes::less(zero, ahead),
                             both(Lanes::less(Lanes::broadcast(4) * rounding, length),
                                  Lanes::less(aside + doubt, inner))));

  alignas(64) double out[4][Lanes::width];
  Lanes::store(out[0], later);
  for (std::size_t k = 0; k < 3; ++k) Lanes::store(out[k + 1], weights[k]);
  for (std::size_t lane = 0; lane < lanes.count; ++lane) {
    PortalAnswer& answer = answers[lanes.query[lane]];
    answer.is_proven = (Lanes::to_bits(proven) >> lane & 1) != 0;
    answer.upper = out[0][lane];
    answer.weights = {out[1][lane], out[2][lane], out[3][lane]};
  }
}

TOUCHSTONE_TARGET inline void prove_contacts(std::span<const PortalQuery> queries,
                                             std::span<PortalAnswer> answers) {
  ContactLanes lanes;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (answers[i].end != PortalEnd::closed) continue;
    lanes.query[lanes.count] = i;
    load_contact(queries[i], answers[i], lanes.count, lanes);
    if (++lanes.count < ContactLanes::width) continue;
    prove_lanes(lanes, answers);
    lanes.count = 0;
  }
  if (lanes.count > 0) prove_lanes(lanes, answers);
}
