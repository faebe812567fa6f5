// The loops of size_classes.h. size_classes.cpp includes them once for each level of vector
// instructions, inside that level's namespace.

constexpr std::size_t lanes = Lanes::width;
using Integers = std::int32_t __attribute__((vector_size(4 * lanes)));

// Loads a vector of the boxes at first, first + stride... below `last`, and empty ones beyond it.
TOUCHSTONE_TARGET inline void load_some(std::span<const Aabb> boxes, std::size_t first,
                                        std::size_t stride, std::size_t last, BoxLanes& some) {
  load_boxes(
      [&](std::size_t lane) {
        const std::size_t at = first + lane * stride;
        return at < last ? &boxes[at] : &empty_box;
      },
      some);
}

// Computes the bits of the boxes' longest sides; an empty box has those of `no_side`. Such bits are
// in the order of the sides.
TOUCHSTONE_TARGET inline void longest_sides(const BoxLanes& box, Integers& bits) {
  const Lanes::Mask is_body = Lanes::less_equal(box.min[0], box.max[0]);
  Lanes::Vector side = box.max[0] - box.min[0];
  for (int axis = 1; axis < 3; ++axis) side = Lanes::max(side, box.max[axis] - box.min[axis]);
  side = Lanes::select(is_body, Lanes::abs(side), Lanes::broadcast(std::bit_cast<float>(no_side)));
  std::memcpy(&bits, &side, sizeof bits);
}

// Bounds every stride-th box's centre, and counts the boxes by the upper bits of their sides.
TOUCHSTONE_TARGET void sample(std::span<const Aabb> boxes, std::size_t stride, CentreRegion& region,
                              std::array<std::uint32_t, SizeSample::magnitudes>& members) {
  Lanes::Vector low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = Lanes::broadcast(CentreRegion::inf);
    high[axis] = Lanes::broadcast(-CentreRegion::inf);
  }
  for (std::size_t i = 0; i < boxes.size(); i += stride * lanes) {
    BoxLanes box;
    load_some(boxes, i, stride, boxes.size(), box);
    const Lanes::Mask is_body = Lanes::less_equal(box.min[0], box.max[0]);
    for (int axis = 0; axis < 3; ++axis) {
      const Lanes::Vector centre = box.min[axis] + box.max[axis];
      low[axis] = Lanes::select(is_body, Lanes::min(low[axis], centre), low[axis]);
      high[axis] = Lanes::select(is_body, Lanes::max(high[axis], centre), high[axis]);
    }
    Integers bits;
    longest_sides(box, bits);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      ++members[static_cast<std::size_t>(bits[lane] >> magnitude_shift)];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, lanes> least, greatest;
    Lanes::store(least.data(), low[axis]);
    Lanes::store(greatest.data(), high[axis]);
    region.low[axis] = *std::ranges::min_element(least);
    region.high[axis] = *std::ranges::max_element(greatest);
  }
}

// Writes how many of the classes' begins are at most the bits of each box's longest side.
TOUCHSTONE_TARGET void classify(std::span<const Aabb> boxes, std::span<const std::int32_t> begins,
                                std::uint32_t* classes) {
  for (std::size_t i = 0; i < boxes.size(); i += lanes) {
    BoxLanes box;
    load_some(boxes, i, 1, boxes.size(), box);
    Integers bits, above{};
    longest_sides(box, bits);
    for (const std::int32_t begin : begins) above -= bits >= begin;
    const std::size_t count = std::min(lanes, boxes.size() - i);
    if (count == lanes) {
      std::memcpy(classes + i, &above, sizeof above);
    } else {
      std::memcpy(classes + i, &above, 4 * count);
    }
  }
}
