// Counts of the calls of the heap, and of the bytes that they ask for.
#pragma once

#include <cstdint>

namespace touchstone::measure {

// -1: not counted.
struct Allocations {
  std::int64_t calls = -1, bytes = -1;
};

// Counts from its construction to its destruction; at most one exists at a time. The program's
// malloc, calloc, realloc, aligned_alloc, posix_memalign and memalign precede the C library's, so
// requests of `operator new` and of the peers' C code count too, in all threads. A realloc is a
// call for its new size; a free subtracts nothing. An allocator of a library that maps memory by
// itself is not seen.
//
// It works only where can_count_allocations(): with the GNU C library, and not under a sanitizer,
// which has an allocator of its own. It is for untimed passes; outside of one, each allocation
// costs one more load and branch.
bool can_count_allocations();

class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  Allocations so_far() const;
};

}  // namespace touchstone::measure
