// The memory that an algorithm's parts have reserved, in bytes. Used by all our broad phases.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchstone {

template <class Item>
std::size_t held_bytes(const std::vector<Item>& items) {
  return items.capacity() * sizeof(Item);
}

// The memory of a kernel that reports its own.
template <class Kernel>
requires requires(const Kernel& kernel) { kernel.held_bytes(); }
std::size_t held_bytes(const Kernel& kernel) { return kernel.held_bytes(); }

// The sum over all parts, for BroadPhaseWork.
template <class... Parts>
std::int64_t sum_held_bytes(const Parts&... parts) {
  return static_cast<std::int64_t>((std::size_t{0} + ... + held_bytes(parts)));
}

}  // namespace touchstone
