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

TOUCHSTONE_TARGET std::uint32_t scan(std::span<const LaneRow> rows, std::span<const LaneBall> balls,
                                     std::span<const LaneBox> boxes, std::uint32_t alive,
                                     std::vector<LaneHit>& hits) {
  for (std::uint32_t i = 0; i < rows.size() && alive != 0; ++i) {
    const LaneRow& row = rows[i];
    const auto may = Lanes::broadcast(row.may * row.may);
    const auto sure = Lanes::broadcast(row.sure >= 0 ? row.sure * row.sure : -1);
    std::uint32_t near = 0, within = 0;
    for (std::size_t at = 0; at < pose_lanes; at += Lanes::width) {
      const auto gap = row.is_box ? squared_gap(balls[row.ball], boxes[row.other], at)
                                  : squared_gap(balls[row.ball], balls[row.other], at);
      near |= static_cast<std::uint32_t>(Lanes::to_bits(Lanes::less_equal(gap, may))) << at;
      within |= static_cast<std::uint32_t>(Lanes::to_bits(Lanes::less_equal(gap, sure))) << at;
    }
    near &= alive;
    if (near == 0) continue;
    within &= alive;
    hits.push_back({i, near, within});
    alive &= ~within;
  }
  return alive;
}
