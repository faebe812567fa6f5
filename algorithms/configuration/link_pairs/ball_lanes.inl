// The loops of ball_lanes.h. ball_lanes.cpp includes this file once for each level of vector instructions.

using Lanes = Simd<float>;

// Squares of the distances of the centre from the box or the other centre, in the lanes from `at` on.
TOUCHSTONE_TARGET inline Lanes::Vector squared_gap(const LaneBall& ball, const LaneBox& box,
                                                   std::size_t at) {
  const auto zero = Lanes::broadcast(0);
  Lanes::Vector way[3] = {Lanes::load(ball.x.data() + at) - Lanes::broadcast(box.centre[0]),
                          Lanes::load(ball.y.data() + at) - Lanes::broadcast(box.centre[1]),
                          Lanes::load(ball.z.data() + at) - Lanes::broadcast(box.centre[2])};
  if (!box.is_level) {
    const Lanes::Vector x = way[0], y = way[1], z = way[2];
    for (std::size_t i = 0; i < 3; ++i) {
      way[i] = x * Lanes::broadcast(box.axes[3 * i]) + y * Lanes::broadcast(box.axes[3 * i + 1]) +
               z * Lanes::broadcast(box.axes[3 * i + 2]);
    }
  }
  auto sum = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto gap = Lanes::max(Lanes::abs(way[i]) - Lanes::broadcast(box.half[i]), zero);
    sum = sum + gap * gap;
  }
  return sum;
}

TOUCHSTONE_TARGET inline Lanes::Vector squared_gap(const LaneBall& ball, const LaneBall& other,
                                                   std::size_t at) {
  const auto x = Lanes::load(ball.x.data() + at) - Lanes::load(other.x.data() + at);
  const auto y = Lanes::load(ball.y.data() + at) - Lanes::load(other.y.data() + at);
  const auto z = Lanes::load(ball.z.data() + at) - Lanes::load(other.z.data() + at);
  return x * x + y * y + z * z;
}

TOUCHSTONE_TARGET std::uint32_t scan(std::span<const LaneRow> rows, std::uint32_t first,
                                     std::uint32_t last, std::span<const LaneBall> balls,
                                     std::span<const LaneBox> boxes, float slack,
                                     std::uint32_t lanes, std::vector<LaneHit>& hits,
                                     std::vector<LaneHit>& sure) {
  for (std::uint32_t i = first; i < last && lanes != 0; ++i) {
    const LaneRow& row = rows[i];
    const float widest = row.reach + slack;
    const auto may = Lanes::broadcast(widest * widest);
    Lanes::Vector gaps[pose_lanes / Lanes::width];
    std::uint32_t near = 0;
    for (std::size_t part = 0; part < pose_lanes / Lanes::width; ++part) {
      const std::size_t at = part * Lanes::width;
      gaps[part] = row.is_box ? squared_gap(balls[row.ball], boxes[row.other], at)
                              : squared_gap(balls[row.ball], balls[row.other], at);
      near |= static_cast<std::uint32_t>(Lanes::to_bits(Lanes::less_equal(gaps[part], may))) << at;
    }
    near &= lanes;
    if (near == 0) continue;
    const float narrowest = row.reach - slack;
    if (row.decides && narrowest >= 0) {
      const auto within = Lanes::broadcast(narrowest * narrowest);
      std::uint32_t certain = 0;
      for (std::size_t part = 0; part < pose_lanes / Lanes::width; ++part) {
        certain |= static_cast<std::uint32_t>(Lanes::to_bits(Lanes::less_equal(gaps[part], within)))
                   << part * Lanes::width;
      }
      certain &= lanes;
      if (certain != 0) sure.push_back({i, certain});
      lanes &= ~certain;
      near &= ~certain;
      if (near == 0) continue;
    }
    hits.push_back({i, near});
  }
  return lanes;
}

// One coordinate in the lanes from `at` on; `row` has the numbers of a row of the pose.
TOUCHSTONE_TARGET inline Lanes::Vector along_row(const LaneNumbers* row, Lanes::Vector x,
                                                 Lanes::Vector y, Lanes::Vector z, std::size_t at) {
  return Lanes::load(row[0].data() + at) * x + Lanes::load(row[1].data() + at) * y +
         Lanes::load(row[2].data() + at) * z + Lanes::load(row[3].data() + at);
}

TOUCHSTONE_TARGET void place(const LanePose& link, std::span<const std::array<float, 3>> centres,
                             std::span<LaneBall> balls) {
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto x = Lanes::broadcast(centres[i][0]), y = Lanes::broadcast(centres[i][1]),
               z = Lanes::broadcast(centres[i][2]);
    for (std::size_t at = 0; at < pose_lanes; at += Lanes::width) {
      Lanes::store(balls[i].x.data() + at, along_row(link.rows.data(), x, y, z, at));
      Lanes::store(balls[i].y.data() + at, along_row(link.rows.data() + 4, x, y, z, at));
      Lanes::store(balls[i].z.data() + at, along_row(link.rows.data() + 8, x, y, z, at));
    }
  }
}

// How far the product of two columns is from `expected`, its value in a rotation.
TOUCHSTONE_TARGET inline Simd<double>::Vector column_error(const Simd<double>::Vector* a,
                                                           const Simd<double>::Vector* b,
                                                           double expected) {
  return Simd<double>::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] -
                           Simd<double>::broadcast(expected));
}

TOUCHSTONE_TARGET PoseReach spread(const Pose* poses, std::size_t stride, std::size_t count,
                                   LanePose& lanes) {
  using Wide = Simd<double>;
  // Nine numbers of the rotation, column by column, and three of the translation.
  constexpr std::size_t numbers = 12;
  static_assert(sizeof(Pose) == numbers * sizeof(double));
  auto error = Wide::broadcast(0), furthest = Wide::broadcast(0);
  for (std::size_t at = 0; at < pose_lanes; at += Wide::width) {
    const double* of_lane[Wide::width];
    for (std::size_t lane = 0; lane < Wide::width; ++lane) {
      of_lane[lane] =
          reinterpret_cast<const double*>(poses + std::min(at + lane, count - 1) * stride);
    }
    Wide::Vector m[numbers];
    for (std::size_t first = 0; first < numbers; first += 4) {
      for (std::size_t k = 0; k < 4; ++k) m[first + k] = Wide::concat_at(of_lane + k);
      Wide::transpose(m + first);
      for (auto& pose : of_lane) pose += 4;
    }
    const Wide::Vector *a = m, *b = m + 3, *c = m + 6, *translation = m + 9;
    error = Wide::max(error, Wide::max(column_error(a, a, 1), column_error(a, b, 0)));
    error = Wide::max(error, Wide::max(column_error(b, b, 1), column_error(b, c, 0)));
    error = Wide::max(error, Wide::max(column_error(c, c, 1), column_error(c, a, 0)));
    for (std::size_t i = 0; i < 3; ++i) furthest = Wide::max(furthest, Wide::abs(translation[i]));
    for (std::size_t i = 0; i < numbers; ++i) {
      double one[Wide::width];
      Wide::store(one, m[i]);
      float* const to = lanes.rows[4 * (i % 3) + i / 3].data() + at;
      for (std::size_t lane = 0; lane < Wide::width; ++lane)
        to[lane] = static_cast<float>(one[lane]);
    }
  }
  return {Wide::reduce_max(error), Wide::reduce_max(furthest)};
}
