// The loops of hilbert.h. hilbert.cpp includes them once for each level of vector instructions,
// inside that level's namespace. No sums of products occur, so every level gives the same codes.
//
// Vectors are changed in place and never passed by value, because the calling convention for that
// depends on the level.

constexpr std::size_t lanes = Lanes::width;
using Integers = std::uint32_t __attribute__((vector_size(4 * lanes)));
using Signed = std::int32_t __attribute__((vector_size(4 * lanes)));
using Floats = float __attribute__((vector_size(4 * lanes)));

// Some vectors are computed at a time, so that none waits for its own last result.
constexpr std::size_t parts = 4;

// Skilling's transpose of the cell numbers.
template <int axes>
TOUCHSTONE_TARGET inline void to_transpose(Integers (&x)[axes][parts], int bits) {
  const std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const Integers below = Integers{} + (bit - 1);
    for (int i = 0; i < axes; ++i) {
      for (std::size_t k = 0; k < parts; ++k) {
        const auto set = (x[i][k] & bit) != 0;
        const Integers exchange = (x[0][k] ^ x[i][k]) & below;
        if (i != 0) x[i][k] ^= set ? Integers{} : exchange;
        x[0][k] ^= set ? below : exchange;
      }
    }
  }
  for (std::size_t k = 0; k < parts; ++k) {
    for (int i = 1; i < axes; ++i) x[i][k] ^= x[i - 1][k];
    Integers turn{};
    for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
      turn ^= (x[axes - 1][k] & bit) != 0 ? Integers{} + (bit - 1) : Integers{};
    }
    for (int i = 0; i < axes; ++i) x[i][k] ^= turn;
  }
}

// Inserts axes - 1 zeros between the bits.
template <int axes>
TOUCHSTONE_TARGET inline void spread(Integers& x) {
  if constexpr (axes == 3) {  // 10 bits
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    x = (x | x << 2) & 0x09249249;
  } else if constexpr (axes == 2) {  // 15 bits
    x = (x | x << 8) & 0x00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f;
    x = (x | x << 2) & 0x33333333;
    x = (x | x << 1) & 0x55555555;
  }
}

// Computes the numbers of the cells that contain the centres.
TOUCHSTONE_TARGET inline void cell(const Numbering& numbering, std::size_t axis,
                                   const Floats& centre, Integers& x) {
  const auto last = static_cast<float>((1u << numbering.bits) - 1);
  Floats place = (centre - numbering.low[axis]) * numbering.scale[axis];
  // A sum that overflows is at the end of the curve; one that is NaN, at its beginning.
  place = place > 0.0f ? place : Floats{};
  place = place < last ? place : Floats{} + last;
  x = reinterpret_cast<Integers>(__builtin_convertvector(place, Signed));
}

template <int axes>
TOUCHSTONE_TARGET inline void places_on(const Numbering& numbering, const Aabb* boxes,
                                        std::uint32_t* codes) {
  for (std::size_t first = 0; first < boxes_at_once; first += parts * lanes) {
    Integers x[axes][parts];
    for (std::size_t k = 0; k < parts; ++k) {
      BoxLanes box;
      load_boxes([&](std::size_t lane) { return boxes + first + k * lanes + lane; }, box);
      Floats centres[3];
      for (int axis = 0; axis < 3; ++axis) centres[axis] = box.min[axis] + box.max[axis];
      for (int i = 0; i < axes; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        cell(numbering, axis, centres[numbering.axis[axis]], x[i][k]);
      }
    }
    to_transpose<axes>(x, numbering.bits);
    for (std::size_t k = 0; k < parts; ++k) {
      Integers code{};
      for (int i = 0; i < axes; ++i) {
        spread<axes>(x[i][k]);
        code |= x[i][k] << (axes - 1 - i);
      }
      std::memcpy(codes + first + k * lanes, &code, sizeof code);
    }
  }
}

// Computes the places on the curve of the centres of `boxes_at_once` boxes.
TOUCHSTONE_TARGET void places(const Numbering& numbering, const Aabb* boxes, std::uint32_t* codes) {
  switch (numbering.axes) {
    case 1: return places_on<1>(numbering, boxes, codes);
    case 2: return places_on<2>(numbering, boxes, codes);
    default: return places_on<3>(numbering, boxes, codes);
  }
}
