// The output of a broad phase: the pairs that it finds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace touchstone {

// Two boxes by their indices, a < b.
struct IndexPair {
  std::uint32_t a, b;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 for a pointer
  friend constexpr auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

// A growing array of pairs that a vector kernel can write into: call `reserve`, write through
// `end`, then `advance` by the number written. clear() keeps the memory.
class PairBuffer {
 public:
  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  std::span<const IndexPair> pairs() const { return {data_.get(), size_}; }
  void clear() { size_ = 0; }

  // Makes room for `more` pairs behind the last one.
  void reserve(std::size_t more) {
    if (capacity_ - size_ < more) grow(more);
  }
  IndexPair* end() { return data_.get() + size_; }
  void advance(std::size_t written) { size_ += written; }

  // Appends a pair, the smaller index first.
  void push(std::uint32_t i, std::uint32_t j) {
    reserve(1);
    data_[size_++] = i < j ? IndexPair{i, j} : IndexPair{j, i};
  }

 private:
  void grow(std::size_t more) {
    const std::size_t capacity = std::max({size_ + more, capacity_ * 2, std::size_t{256}});
    auto data = std::make_unique_for_overwrite<IndexPair[]>(capacity);
    std::copy_n(data_.get(), size_, data.get());
    data_ = std::move(data);
    capacity_ = capacity;
  }

  std::unique_ptr<IndexPair[]> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

// The pairs of one frame, in chunks, so that the tasks of a broad phase can write concurrently. The
// pairs are in the order of the chunks: if the work is cut by its size, that order is the same at
// every width.
class PairSink {
 public:
  // Makes `count` empty chunks, which keep the memory of earlier frames.
  void start(std::size_t count) {
    if (chunks_.size() < count) chunks_.resize(count);
    used_ = count;
    for (std::size_t i = 0; i < count; ++i) chunks_[i].clear();
  }
  PairBuffer& chunk(std::size_t index) { return chunks_[index]; }
  std::span<const PairBuffer> chunks() const { return {chunks_.data(), used_}; }

  std::size_t size() const {
    std::size_t total = 0;
    for (const PairBuffer& chunk : chunks()) total += chunk.size();
    return total;
  }
  std::size_t held_bytes() const {
    std::size_t bytes = 0;
    for (const PairBuffer& chunk : chunks_) bytes += chunk.capacity() * sizeof(IndexPair);
    return bytes;
  }
  // Returns all pairs in one array, in order.
  std::vector<IndexPair> gather() const {
    std::vector<IndexPair> all;
    all.reserve(size());
    for (const PairBuffer& chunk : chunks()) {
      all.insert(all.end(), chunk.pairs().begin(), chunk.pairs().end());
    }
    return all;
  }

 private:
  std::vector<PairBuffer> chunks_;
  std::size_t used_ = 0;
};

}  // namespace touchstone
