// Counts the calls of the heap.
#include "harness/measure/allocations.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TOUCHSTONE_COUNTS_ALLOCATIONS 1
#else
#define TOUCHSTONE_COUNTS_ALLOCATIONS 0
#endif

namespace touchstone::measure {
namespace {

std::atomic<bool> counting = false;
std::atomic<std::int64_t> calls = 0;
std::atomic<std::int64_t> asked_bytes = 0;

#if TOUCHSTONE_COUNTS_ALLOCATIONS
void count(std::size_t size) {
  if (!counting.load(std::memory_order_relaxed)) return;
  calls.fetch_add(1, std::memory_order_relaxed);
  asked_bytes.fetch_add(static_cast<std::int64_t>(size), std::memory_order_relaxed);
}
#endif

}  // namespace

bool can_count_allocations() { return TOUCHSTONE_COUNTS_ALLOCATIONS != 0; }

AllocationCount::AllocationCount() {
  calls = 0;
  asked_bytes = 0;
  counting = true;
}

AllocationCount::~AllocationCount() { counting = false; }

Allocations AllocationCount::so_far() const {
  if (!can_count_allocations()) return {};
  return {.calls = calls, .bytes = asked_bytes};
}

}  // namespace touchstone::measure

#if TOUCHSTONE_COUNTS_ALLOCATIONS
// These are the C library's own functions under the names that it keeps for this purpose (The GNU C
// Library Reference Manual, "Replacing malloc"). free stays the library's, which owns the memory.
extern "C" {
void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t items, std::size_t size) noexcept;
void* __libc_realloc(void* memory, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;

void* malloc(std::size_t size) noexcept {
  touchstone::measure::count(size);
  return __libc_malloc(size);
}

void* calloc(std::size_t items, std::size_t size) noexcept {
  touchstone::measure::count(items * size);
  return __libc_calloc(items, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  touchstone::measure::count(size);
  return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  touchstone::measure::count(size);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  touchstone::measure::count(size);
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  const bool power = alignment != 0 && (alignment & (alignment - 1)) == 0;
  if (!power || alignment % sizeof(void*) != 0) return EINVAL;
  touchstone::measure::count(size);
  void* const got = __libc_memalign(alignment, size);
  if (got == nullptr) return ENOMEM;
  *memory = got;
  return 0;
}
}
#endif
