// The hash of the project: of numbers, of sets of pairs, and of bytes that come in pieces, such as
// those of a file.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "algorithms/core/pair_sink.h"

namespace touchstone::base {

// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", OOPSLA 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

// The sum modulo 2^64 of mix(a * 2^32 + b). It does not depend on the order of the pairs.
inline std::uint64_t pair_hash(std::span<const IndexPair> pairs) {
  std::uint64_t sum = 0;
  for (const IndexPair& p : pairs) sum += mix((std::uint64_t{p.a} << 32) + p.b);
  return sum;
}

inline std::string to_hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

// Mixes words of eight bytes, in this machine's order, and the length at the end. How the bytes are
// cut into pieces does not matter.
class ByteHash {
 public:
  void add(std::string_view bytes) {
    while (!bytes.empty() && (filled_ > 0 || bytes.size() < word_.size())) {
      word_[filled_++] = bytes.front();
      bytes.remove_prefix(1);
      ++size_;
      if (filled_ == word_.size()) mix_in(word_.data());
    }
    while (bytes.size() >= word_.size()) {
      mix_in(bytes.data());
      bytes.remove_prefix(word_.size());
      size_ += word_.size();
    }
    if (!bytes.empty()) add(bytes);
  }

  std::uint64_t value() const {
    ByteHash last = *this;
    if (last.filled_ > 0) {
      std::memset(last.word_.data() + last.filled_, 0, last.word_.size() - last.filled_);
      last.mix_in(last.word_.data());
    }
    return mix(last.state_ ^ size_);
  }

 private:
  void mix_in(const char* bytes) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    state_ = mix(state_ ^ word);
    filled_ = 0;
  }

  std::uint64_t state_ = 0, size_ = 0;
  std::array<char, sizeof(std::uint64_t)> word_{};  // the bytes behind the last whole word
  std::size_t filled_ = 0;
};

}  // namespace touchstone::base
