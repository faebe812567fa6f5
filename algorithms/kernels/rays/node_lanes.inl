// The lanes of nodes and leaves, and the order of a node's children, at one level of vector instructions. A
// node and a leaf have eight lanes, so the widest level uses half of its lanes.

#if defined(__x86_64__)
using Lanes = std::conditional_t<(Simd<float>::width > 8), simd::avx2::Simd<float>, Simd<float>>;
#else
using Lanes = Simd<float>;
#endif
using Vector = Lanes::Vector;

// Lanes [part, part + width) of the eight.
constexpr std::size_t width = Lanes::width;

TOUCHSTONE_TARGET TOUCHSTONE_INLINE Vector all(float x) { return Lanes::broadcast(x); }

// Writes the keys of the children that are met, from far to near, and returns the nearest. `to` has room
// for eight.
template <class Near>
TOUCHSTONE_TARGET TOUCHSTONE_INLINE std::int32_t push(unsigned bits, const WideNode& node,
                                                      const Near* begin, std::uint64_t* to) {
#if defined(__x86_64__)
  if constexpr (Simd<float>::width > 8 && sizeof(Near) == 32) {
    return child_of(push_sorted(bits, node.child.data(), begin[0], to));
  }
#endif
  alignas(32) std::array<float, 8> near;
  for (std::size_t part = 0; part < 8; part += width) {
    Lanes::store(&near[part], begin[part / width]);
  }
  std::size_t count = 0;
  for (; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    const std::uint64_t key = key_of(node.child[lane], near[lane]);
    std::size_t at = count++;
    for (; at > 0 && to[at - 1] < key; --at) to[at] = to[at - 1];
    to[at] = key;
  }
  return child_of(to[count - 1]);
}
