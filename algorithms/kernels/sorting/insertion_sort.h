// Insertion sort for items that are almost in order, as boxes are from one frame to the next. Used
// by sweep-one-axis and sweep-three-axes.
// Paper: Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992.
#pragma once

#include <cstddef>
#include <span>

namespace touchstone {

// Sorts in ascending order. Gives up and returns false as soon as the first i items have needed
// more than `moves_each` * (i + 64) moves; the items are then a permutation of the input.
template <class Item>
bool insertion_sort(std::span<Item> items, std::size_t moves_each) {
  std::size_t moves = 0;
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Item item = items[i];
    const std::size_t left = moves_each * (i + 64) - moves;
    const std::size_t lowest = i > left ? i - left : 0;
    std::size_t at = i;
    for (; at > lowest && item < items[at - 1]; --at) items[at] = items[at - 1];
    items[at] = item;
    if (at == lowest && at > 0 && item < items[at - 1]) return false;
    moves += i - at;
  }
  return true;
}

}  // namespace touchstone
