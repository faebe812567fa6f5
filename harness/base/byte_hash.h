// A hash of bytes that come in pieces, such as those of a file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "harness/base/hash.h"

namespace touchstone::base {

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
