// Part of dynamic-bvh: an array that grows by pages and never moves what it holds, so that no frame
// has to copy it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace touchstone {

template <class Item>
class PagedArray {
 public:
  static constexpr std::size_t page = 16384;  // items

  // The number of items that there is room for. New ones are undefined.
  std::size_t size() const { return pages_.size() * page; }
  void grow(std::size_t count) {
    while (size() < count) pages_.push_back(std::make_unique_for_overwrite<Item[]>(page));
  }
  Item& operator[](std::size_t i) { return pages_[i / page][i % page]; }
  const Item& operator[](std::size_t i) const { return pages_[i / page][i % page]; }

  // Writes the items from place `at` on.
  void copy(std::span<const Item> items, std::size_t at) {
    while (!items.empty()) {
      const std::size_t count = std::min(items.size(), page - at % page);
      std::ranges::copy(items.first(count), &(*this)[at]);
      items = items.subspan(count);
      at += count;
    }
  }
  std::size_t held_bytes() const {
    return size() * sizeof(Item) + pages_.capacity() * sizeof(pages_[0]);
  }

 private:
  std::vector<std::unique_ptr<Item[]>> pages_;
};

}  // namespace touchstone
