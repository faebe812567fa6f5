// The loops of hilbert.h. Included by hilbert.cpp once for each level of vector instructions, inside
// that level's namespace, with TOUCHSTONE_TARGET set to its attribute. Integers only, so that the
// codes are the same at every level.
//
// Vectors are changed in place: none is passed by value, for how that is done depends on the level.

// Skilling's transpose of the cell numbers.
template <int axes>
TOUCHSTONE_TARGET inline void to_transpose(Integers (&x)[axes], int bits) {
  const std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (int i = 0; i < axes; ++i) {
      const Integers set = reinterpret_cast<Integers>((x[i] & bit) != 0);
      const Integers exchange = (x[0] ^ x[i]) & below & ~set;
      x[0] ^= exchange ^ (set & below);
      if (i != 0) x[i] ^= exchange;
    }
  }
  for (int i = 1; i < axes; ++i) x[i] ^= x[i - 1];
  Integers turn{};
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    turn ^= reinterpret_cast<Integers>((x[axes - 1] & bit) != 0) & (bit - 1);
  }
  for (int i = 0; i < axes; ++i) x[i] ^= turn;
}

// Puts axes - 1 zeros between the bits.
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

template <int axes>
TOUCHSTONE_TARGET inline void place_on_curve(Integers (&x)[axes], int bits, Integers& code) {
  to_transpose<axes>(x, bits);
  code = Integers{};
  for (int i = 0; i < axes; ++i) {
    spread<axes>(x[i]);
    code |= x[i] << (axes - 1 - i);
  }
}

// Cells become places on the curve.
TOUCHSTONE_TARGET void places(int axes, const Cells& cells, int bits, std::uint32_t* codes) {
  Integers code;
  const auto run = [&]<int count>() TOUCHSTONE_TARGET {
    Integers x[count];
    std::memcpy(x, cells.data(), sizeof x);
    place_on_curve<count>(x, bits, code);
  };
  switch (axes) {
    case 1: run.template operator()<1>(); break;
    case 2: run.template operator()<2>(); break;
    default: run.template operator()<3>(); break;
  }
  std::memcpy(codes, &code, sizeof code);
}
