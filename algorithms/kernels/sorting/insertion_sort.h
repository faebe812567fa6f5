// Insertion sort for what is almost in order, as boxes are from one frame to the next.
// Paper: Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992.
#pragma once

#include <cstddef>
#include <span>

namespace touchstone {

// Sorts ascending, or gives up and returns false as soon as the items seen so far (and 64 more)
// need more than `moves_each` moves each; the items are then in some other order.
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
