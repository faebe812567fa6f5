// Part of dynamic-bvh: the loop of pair_cache.h. pair_cache.cpp includes it once for each level of
// vector instructions, inside that level's namespace.

// Copies the pairs whose bits are set, 64 a word, and returns their end. It writes up to eight
// more.
TOUCHSTONE_TARGET IndexPair* copy_pairs(const IndexPair* pairs, const std::uint64_t* words,
                                        std::size_t count, IndexPair* to) {
  for (std::size_t word = 0; word < count; ++word, pairs += 64) {
    if (words[word] == ~std::uint64_t{0}) {
      std::memcpy(to, pairs, 64 * sizeof(IndexPair));
      to += 64;
      continue;
    }
    for (std::size_t part = 0; part < 64; part += 8) {
      const auto bits = static_cast<unsigned>(words[word] >> part & 0xff);
      if (bits == 0) continue;
      // A pair is two lanes.
      unsigned lanes = (bits | bits << 4) & 0x0f0f;
      lanes = (lanes | lanes << 2) & 0x3333;
      lanes = 3 * ((lanes | lanes << 1) & 0x5555);
      to += Simd<float>::compress(lanes, &pairs[part].a, &to->a) / 2;
    }
  }
  return to;
}
