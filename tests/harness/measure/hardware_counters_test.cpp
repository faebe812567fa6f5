// Tests of the processor's counters.
#include "harness/measure/hardware_counters.h"

#include <gtest/gtest.h>
#include <linux/perf_event.h>
#include <sys/mman.h>
#include <unistd.h>

#include <thread>

namespace touchstone {
namespace {

// Writes to this number of new pages.
void touch_pages(std::size_t pages) {
  const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, pages * size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  madvise(memory, pages * size, MADV_NOHUGEPAGE);
  for (std::size_t page = 0; page < pages; ++page) {
    static_cast<volatile char*>(memory)[page * size] = 1;
  }
  munmap(memory, pages * size);
}

double spin() {
  volatile double sum = 0;
  for (int i = 0; i < 1'000'000; ++i) sum = sum + 1.0 / (i + 1);
  return sum;
}

TEST(HardwareCounters, CountOrSayThatTheyDoNot) {
  measure::HardwareCounters counters;
  counters.start();
  EXPECT_GT(spin(), 1);
  const measure::HardwareCounts counts = counters.counts();
  for (const std::int64_t count : {counts.cycles, counts.instructions}) {
    EXPECT_TRUE(count == -1 || count > 1'000'000) << count;
  }
  for (const std::int64_t count : {counts.branch_misses, counts.cache_misses}) {
    EXPECT_GE(count, -1);
  }
}

TEST(HardwareCounters, AnUnknownEventIsEmpty) {
  measure::EventCounter event(PERF_TYPE_HARDWARE, 0xffff);
  EXPECT_FALSE(event.is_open());
  event.start();
  EXPECT_EQ(event.count(), -1);
}

// The test uses an event that the kernel counts itself, if the kernel permits it.
TEST(HardwareCounters, TakeInTheThreadsThatComeLater) {
  measure::EventCounter event(PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS);
  if (!event.is_open()) GTEST_SKIP() << "the kernel allows no counters";
  event.start();
  touch_pages(100);
  const std::int64_t own = event.count();
  EXPECT_GE(own, 100);
  EXPECT_LT(own, 200);
  std::thread([] { touch_pages(1000); }).join();
  EXPECT_GE(event.count(), own + 1000);
  EXPECT_LT(event.count(), own + 1200);
  event.start();
  EXPECT_LT(event.count(), 20) << "it starts afresh";
}

}  // namespace
}  // namespace touchstone
