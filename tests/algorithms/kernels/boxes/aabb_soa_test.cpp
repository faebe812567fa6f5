#include "algorithms/kernels/boxes/aabb_soa.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

TEST(AabbSoA, IsFilledWithTheBoxesOfManyIds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-10, 10);
  std::vector<Aabb> boxes(300);
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = place(random);
    }
  }
  for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    limit_isa(level);
    for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 100u, 1000u}) {
      constexpr std::size_t first = 5;
      std::vector<std::uint32_t> ids(count);
      for (std::uint32_t& id : ids) id = static_cast<std::uint32_t>(random() % boxes.size());
      AabbSoA arrays;
      arrays.resize(first + count + 3);
      const Aabb other{{1, 2, 3}, {4, 5, 6}};
      for (std::size_t i = 0; i < arrays.size(); ++i) arrays.set(i, other, 7);
      arrays.set(first, boxes, ids);
      for (std::size_t i = 0; i < arrays.size(); ++i) {
        const bool is_set = i >= first && i < first + count;
        const std::uint32_t id = is_set ? ids[i - first] : 7;
        const Aabb& box = is_set ? boxes[id] : other;
        ASSERT_EQ(arrays.ids()[i], id);
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_EQ(arrays.min(axis)[i], box.min[static_cast<std::size_t>(axis)]);
          ASSERT_EQ(arrays.max(axis)[i], box.max[static_cast<std::size_t>(axis)]);
        }
      }
    }
  }
  limit_isa(isa_of_machine());
}

}  // namespace
}  // namespace touchstone
