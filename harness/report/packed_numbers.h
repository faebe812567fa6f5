// Numbers as text for the page.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::report {

static_assert(std::endian::native == std::endian::little);  // the page reads such numbers

// Returns base64 of bytes, with padding.
std::string base64(std::string_view bytes);

// Returns base64 of the numbers.
template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

// Frames of as many floats each, one after the other. What does not change becomes zeros, which
// compress well: from the second frame on, the bits of each number are those of an exclusive or
// with the frame before.
inline std::string packed_frames(const std::vector<float>& numbers, std::size_t in_a_frame) {
  std::vector<std::uint32_t> bits(numbers.size());
  std::memcpy(bits.data(), numbers.data(), numbers.size() * sizeof(float));
  for (std::size_t i = bits.size(); i-- > in_a_frame;) bits[i] ^= bits[i - in_a_frame];
  return packed(bits);
}

}  // namespace touchstone::report
