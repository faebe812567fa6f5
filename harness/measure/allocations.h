// Calls of the heap, and the bytes that they ask for.
#pragma once

#include <cstdint>

namespace touchstone::measure {

// -1: not counted.
struct Allocations {
  std::int64_t calls = -1, bytes = -1;
};

// Counts from where it is made to where it is destroyed; one at a time. The program's malloc,
// calloc, realloc, aligned_alloc, posix_memalign and memalign are put before the C library's, so
// what `operator new` and the peers' C code ask for is counted too, of all threads. A realloc is a
// call for its new size; nothing is taken off when memory is given back. A library's allocator that
// maps memory by itself is not seen.
//
// Only where can_count_allocations(): with the GNU C library, and not under a sanitizer, which has
// an allocator of its own. It is for untimed passes: outside of one, an allocation costs a load and
// a branch more.
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
