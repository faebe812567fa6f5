// Compares the memory that each of our broad phases states with what it has taken from the heap, so
// that no container is forgotten in the sum.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"

// A sanitizer has operators of its own, which must not be mixed with these.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

std::atomic<std::int64_t> heap_bytes = 0;  // reserved by operator new and not yet freed

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  heap_bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
  return memory;
}

void release(void* memory) {
  heap_bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

// The other forms of the operators call these.
void* operator new(std::size_t size) { return counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace touchstone {
namespace {

// Bodies that all move, and of which some jump, go and come back.
class ComingAndGoing {
 public:
  explicit ComingAndGoing(std::size_t bodies)
      : side_(std::cbrt(1.0f / static_cast<float>(bodies))),
        boxes_(uniform_boxes(random_, bodies, side_)) {}

  std::span<const Aabb> boxes() const { return boxes_; }

  FrameChange next(int frame) {
    moved_.clear(), inserted_.clear(), removed_.clear();
    const bool come_and_go = frame % 4 == 3;
    for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
      Aabb& box = boxes_[id];
      const bool jumps = uniform(random_, 0, 1) < 0.01f;
      if (box.is_empty()) {
        if (!come_and_go) continue;
        box = uniform_boxes(random_, 1, side_)[0];
        inserted_.push_back(id);
      } else if (come_and_go && jumps) {
        box = Aabb::empty();
        removed_.push_back(id);
      } else {
        const float reach = (jumps ? 2.0f : 0.01f) * side_;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float step = uniform(random_, -reach, reach);
          box.min[axis] += step;
          box.max[axis] += step;
        }
        moved_.push_back(id);
      }
    }
    return {boxes_, moved_, inserted_, removed_};
  }

 private:
  Random random_{23};
  float side_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

struct Memory {
  std::int64_t stated, reserved;  // bytes
};

Memory memory_of(const BroadPhaseEntry& entry, std::size_t bodies) {
  Executor executor(1);
  ComingAndGoing frames(bodies);
  frames.next(0);  // reserves the lists
  const std::int64_t before = heap_bytes;
  const auto algorithm = entry.make(executor);
  algorithm->build(frames.boxes());
  std::int64_t others = 0;  // bytes that the frames reserve
  for (int frame = 1; frame <= 16; ++frame) {
    PairSink sink;
    EXPECT_EQ(algorithm->find_pairs(sink), Status::ok);
    const std::int64_t start = heap_bytes;
    const FrameChange change = frames.next(frame);
    others += heap_bytes - start;
    algorithm->update(change);
  }
  return {algorithm->work().bytes, heap_bytes - before - others};
}

// The scratch of threads is not stated. It hardly grows with the number of bodies, so the test
// notices a container of two bytes a body that is not stated either.
TEST(Memory, IsStatedWhole) {
  constexpr std::int64_t few = 8'000, many = 32'000;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin != Origin::ours) continue;
    SCOPED_TRACE(entry.info.name);
    const Memory of_few = memory_of(entry, few), of_many = memory_of(entry, many);
    const std::int64_t scratch = of_few.reserved - of_few.stated;
    EXPECT_GE(scratch, 0);
    EXPECT_LE(scratch, 192 << 10);
    EXPECT_LE(of_many.reserved - of_many.stated - scratch, (many - few) * 3 / 2);
    EXPECT_GE(of_many.stated, many * 8);
  }
}

}  // namespace
}  // namespace touchstone

#endif
