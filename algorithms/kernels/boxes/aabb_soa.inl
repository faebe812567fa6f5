// The loop of AabbSoA::set for many boxes. aabb_soa.cpp includes it once for each level of vector
// instructions, inside that level's namespace.

TOUCHSTONE_TARGET void set_boxes(const MutableColumns& to, std::size_t first,
                                 std::span<const Aabb> boxes, std::span<const std::uint32_t> ids) {
  // The boxes are scattered in memory, so they are prefetched.
  constexpr std::size_t ahead = 32;
  const std::size_t whole = ids.size() / Lanes::width * Lanes::width;
  for (std::size_t i = 0; i < whole; i += Lanes::width) {
    if (i + ahead + Lanes::width <= ids.size()) {
      for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
        __builtin_prefetch(&boxes[ids[i + ahead + lane]]);
      }
    }
    BoxLanes lanes;
    load_boxes([&](std::size_t lane) { return &boxes[ids[i + lane]]; }, lanes);
    for (int axis = 0; axis < 3; ++axis) {
      Lanes::store(to.min[axis] + first + i, lanes.min[axis]);
      Lanes::store(to.max[axis] + first + i, lanes.max[axis]);
    }
  }
  for (std::size_t i = whole; i < ids.size(); ++i) {
    const Aabb& box = boxes[ids[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      to.min[axis][first + i] = box.min[axis];
      to.max[axis][first + i] = box.max[axis];
    }
  }
  std::copy(ids.begin(), ids.end(), to.ids + first);
}
