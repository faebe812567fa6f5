// Casts between vectors, and four lanes in the compiler's own vector types. vector.h includes this file once for each
// level of vector instructions, inside that level's namespace.

// clang wants the level's attribute on what takes or returns wide vectors. g++ does not, and with it would inline less or
// more elsewhere.
#if defined(__clang__)
#define TOUCHSTONE_QUAD TOUCHSTONE_TARGET TOUCHSTONE_INLINE
template <class To, class From>
TOUCHSTONE_QUAD To bit_cast(const From& from) {
  return __builtin_bit_cast(To, from);
}
#else
#define TOUCHSTONE_QUAD TOUCHSTONE_INLINE
using std::bit_cast;
#endif

template <class Scalar>
struct QuadLanes {
  static constexpr std::size_t width = 4;
  using Vector = Quad<Scalar>;
  using Integer = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  using Mask =
      std::conditional_t<sizeof(Scalar) == 4, std::int32_t __attribute__((vector_size(16))),
                         std::int64_t __attribute__((vector_size(32)))>;

  static TOUCHSTONE_QUAD Vector load(const Scalar* from) {
    Vector x;
    std::memcpy(&x, from, sizeof x);
    return x;
  }
  static TOUCHSTONE_QUAD void store(Scalar* to, Vector x) { std::memcpy(to, &x, sizeof x); }
  static TOUCHSTONE_QUAD Vector broadcast(Scalar x) { return Vector{x, x, x, x}; }
  static TOUCHSTONE_QUAD Mask less(Vector a, Vector b) { return a < b; }
  static TOUCHSTONE_QUAD Mask less_equal(Vector a, Vector b) { return a <= b; }
  static TOUCHSTONE_QUAD Mask less_equal(Mask within, Vector a, Vector b) {
    return within & (a <= b);
  }
  static TOUCHSTONE_QUAD Vector select(Mask mask, Vector a, Vector b) { return mask ? a : b; }
  static TOUCHSTONE_QUAD Vector abs(Vector x) {
    const Mask bits = bit_cast<Mask>(x) & ~(Mask{} + std::numeric_limits<Integer>::min());
    return bit_cast<Vector>(bits);
  }
  static TOUCHSTONE_QUAD Vector max(Vector a, Vector b) { return a > b ? a : b; }
  static TOUCHSTONE_QUAD Vector min(Vector a, Vector b) { return a < b ? a : b; }
  static TOUCHSTONE_QUAD Vector max_abs(Vector a, Vector b) { return max(abs(a), abs(b)); }
  static TOUCHSTONE_QUAD Scalar reduce_max(Vector x) {
    const Scalar even = x[0] > x[2] ? x[0] : x[2], odd = x[1] > x[3] ? x[1] : x[3];
    return even > odd ? even : odd;
  }
  static TOUCHSTONE_QUAD Vector sqrt(Vector x) {
    return Vector{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
  }
  static TOUCHSTONE_QUAD unsigned to_bits(Mask m) {
#if defined(__x86_64__)
    if constexpr (sizeof(Scalar) == 4) {
      return static_cast<unsigned>(_mm_movemask_ps(bit_cast<__m128>(m)));
    }
#endif
    return static_cast<unsigned>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
  }
  static TOUCHSTONE_QUAD Mask from_bits(unsigned bits) {
    const auto set = [bits](unsigned lane) { return -static_cast<Integer>(bits >> lane & 1); };
    return Mask{set(0), set(1), set(2), set(3)};
  }
  static TOUCHSTONE_QUAD Vector concat(const Quad<Scalar>* quads) { return quads[0]; }
  static TOUCHSTONE_QUAD Vector concat_at(const Scalar* const* at) { return load(at[0]); }
  static TOUCHSTONE_QUAD void transpose(Vector r[4]) {
    const Vector a = r[0], b = r[1], c = r[2], d = r[3];
    for (int k = 0; k < 4; ++k) r[k] = Vector{a[k], b[k], c[k], d[k]};
  }
  static TOUCHSTONE_QUAD Mask meet(Vector a, Vector b, Vector c, Vector d) {
    return (c <= b) & (a <= d);
  }
  static TOUCHSTONE_QUAD Mask meet(Mask within, Vector a, Vector b, Vector c, Vector d) {
    return within & (c <= b) & (a <= d);
  }

  static Scalar reduce_min16(const Scalar* from) {
    Vector x = load(from);
    for (std::size_t part = width; part < 16; part += width) x = min(load(from + part), x);
    return reduce_min4(x);
  }
  static Scalar reduce_max16(const Scalar* from) {
    Vector x = load(from);
    for (std::size_t part = width; part < 16; part += width) x = max(load(from + part), x);
    return reduce_max4(x);
  }
  template <class Value>
  static std::size_t compress(unsigned bits, const Value* from, Value* to) {
    std::size_t count = 0;
    for (; bits != 0; bits &= bits - 1) to[count++] = from[std::countr_zero(bits)];
    return count;
  }
  static std::size_t compress_indices(unsigned bits, std::uint32_t first, std::uint32_t* to) {
    std::size_t count = 0;
    for (; bits != 0; bits &= bits - 1) {
      to[count++] = first + static_cast<std::uint32_t>(std::countr_zero(bits));
    }
    return count;
  }
  static void fill(std::uint32_t x, std::uint32_t* to) { std::fill_n(to, 16, x); }
  static unsigned test(const std::uint32_t* marks, std::uint32_t want) {
    unsigned bits = 0;
    for (unsigned lane = 0; lane < width; ++lane) {
      bits |= static_cast<unsigned>((marks[lane] & want) == want) << lane;
    }
    return bits;
  }
};
#undef TOUCHSTONE_QUAD
