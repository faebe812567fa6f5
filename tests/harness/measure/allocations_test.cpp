// Tests of the counts of heap calls.
#include "harness/measure/allocations.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace touchstone {
namespace {

class Counted : public testing::Test {
 protected:
  void SetUp() override {
    if (!measure::can_count_allocations()) GTEST_SKIP() << "not counted in this build";
  }
};

// A global that keeps the compiler from removing allocations.
void* volatile kept = nullptr;

TEST_F(Counted, WhatIsAskedFor) {
  const measure::AllocationCount count;
  const auto expect = [&](std::int64_t calls, std::int64_t bytes) {
    EXPECT_EQ(count.so_far().calls, calls);
    EXPECT_EQ(count.so_far().bytes, bytes);
  };
  expect(0, 0);
  kept = std::malloc(100);
  expect(1, 100);
  kept = std::realloc(kept, 1000);
  expect(2, 1100);
  std::free(kept);
  expect(2, 1100);
  kept = std::calloc(3, 10);
  expect(3, 1130);
  EXPECT_EQ(*static_cast<char*>(kept), 0);
  std::free(kept);
  kept = std::aligned_alloc(64, 128);
  expect(4, 1258);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(kept) % 64, 0u);
  std::free(kept);
  void* aligned = nullptr;
  ASSERT_EQ(posix_memalign(&aligned, 256, 10), 0);
  expect(5, 1268);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(aligned) % 256, 0u);
  std::free(aligned);
  EXPECT_NE(posix_memalign(&aligned, 3, 10), 0);
  expect(5, 1268);
}

TEST_F(Counted, WhatOperatorNewAndTheCLibraryAskFor) {
  const measure::AllocationCount count;
  kept = operator new(40);
  operator delete(kept);
  EXPECT_EQ(count.so_far().calls, 1);
  EXPECT_EQ(count.so_far().bytes, 40);
  constexpr std::align_val_t line{64};
  kept = operator new[](192, line);
  operator delete[](kept, line);
  EXPECT_EQ(count.so_far().calls, 2);
  EXPECT_EQ(count.so_far().bytes, 232);
  char* const copy = strdup("seven..");  // a call inside a library
  kept = copy;
  std::free(copy);
  EXPECT_EQ(count.so_far().calls, 3);
  EXPECT_EQ(count.so_far().bytes, 240);
}

TEST_F(Counted, OtherThreadsToo) {
  const measure::AllocationCount count;
  std::thread([] {
    for (int i = 0; i < 1000; ++i) {
      kept = std::malloc(1 << 10);
      std::free(kept);
    }
  }).join();
  EXPECT_GE(count.so_far().calls, 1000);
  EXPECT_LT(count.so_far().calls, 1020);  // the thread's own calls are among them
  EXPECT_GE(count.so_far().bytes, 1000 << 10);
}

TEST_F(Counted, OnlyWhileItIsAskedTo) {
  { const measure::AllocationCount count; }
  kept = std::malloc(1);
  std::free(kept);
  const measure::AllocationCount count;
  EXPECT_EQ(count.so_far().calls, 0);
}

TEST(Allocations, AreUnknownWhereNothingCounts) {
  const measure::AllocationCount count;
  EXPECT_EQ(count.so_far().calls >= 0, measure::can_count_allocations());
}

}  // namespace
}  // namespace touchstone
