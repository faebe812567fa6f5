#include "algorithms/kernels/bvh/hilbert.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

// A point box whose doubled centre is this.
Aabb point(float x, float y, float z) { return {{x / 2, y / 2, z / 2}, {x / 2, y / 2, z / 2}}; }

std::vector<std::uint32_t> codes_of(const HilbertGrid& grid, const std::vector<Aabb>& boxes) {
  std::vector<std::uint32_t> codes(boxes.size());
  grid.codes(boxes, codes.data());
  return codes;
}

// The centres of the cells of a grid of so many cells along each axis, a metre each.
std::vector<Aabb> cell_centres(const std::array<int, 3>& cells) {
  std::vector<Aabb> boxes;
  for (int x = 0; x < cells[0]; ++x) {
    for (int y = 0; y < cells[1]; ++y) {
      for (int z = 0; z < cells[2]; ++z) {
        boxes.push_back(point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                              static_cast<float>(z) + 0.5f));
      }
    }
  }
  return boxes;
}

// Every cell has a place of its own, and neighbours on the curve are neighbours in space.
void expect_curve(const std::array<int, 3>& cells, int code_bits) {
  const HilbertGrid grid(
      {0, 0, 0},
      {static_cast<float>(cells[0]), static_cast<float>(cells[1]), static_cast<float>(cells[2])},
      code_bits);
  const std::vector<Aabb> boxes = cell_centres(cells);
  ASSERT_EQ(boxes.size(), std::size_t{1} << grid.code_bits());
  const std::vector<std::uint32_t> codes = codes_of(grid, boxes);
  std::vector<const Aabb*> at(boxes.size(), nullptr);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ASSERT_LT(codes[i], boxes.size());
    ASSERT_EQ(at[codes[i]], nullptr);
    at[codes[i]] = &boxes[i];
  }
  for (std::size_t i = 1; i < at.size(); ++i) {
    float steps = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      steps += std::abs(at[i]->min[axis] - at[i - 1]->min[axis]);
    }
    ASSERT_EQ(steps, 0.5f) << i;
  }
}

TEST(Hilbert, IsACurveThroughAllCells) {
  expect_curve({8, 8, 8}, 9);
  expect_curve({16, 16, 16}, 12);
  expect_curve({1, 16, 16}, 8);  // flat in x: its bits go to the others
  expect_curve({32, 1, 32}, 10);
  expect_curve({64, 1, 1}, 6);
}

TEST(Hilbert, IsTheSameAtEveryLevelOfVectorInstructions) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1003; ++i) {
    const auto x = static_cast<float>(i);
    boxes.push_back(
        point(std::fmod(x * 7.3f, 10.0f), std::fmod(x * 3.7f, 10.0f), std::fmod(x * 1.9f, 10.0f)));
  }
  for (const int bits : {3, 15, 30}) {
    for (const std::array<float, 3>& high :
         {std::array{10.0f, 10.0f, 10.0f}, std::array{10.0f, 0.0f, 10.0f},
          std::array{0.0f, 10.0f, 0.0f}}) {
      const HilbertGrid grid({0, 0, 0}, high, bits);
      limit_isa(Isa::baseline);
      const std::vector<std::uint32_t> baseline = codes_of(grid, boxes);
      for (const Isa level : {Isa::avx2, Isa::avx512}) {
        limit_isa(level);
        EXPECT_EQ(codes_of(grid, boxes), baseline);
      }
      limit_isa(isa_of_machine());
    }
  }
}

TEST(Hilbert, PutsWhatIsOutsideIntoTheCellsAtTheEdge) {
  const HilbertGrid grid({0, 0, 0}, {16, 16, 16}, 12);
  const std::vector<std::uint32_t> codes =
      codes_of(grid, {point(-1e30f, 0.5f, 0.5f), point(0.5f, 0.5f, 0.5f),
                      point(1e30f, 15.5f, 15.5f), point(15.5f, 15.5f, 15.5f)});
  EXPECT_EQ(codes[0], codes[1]);
  EXPECT_EQ(codes[2], codes[3]);
}

TEST(Hilbert, BearsRegionsWithoutExtentAndBeyondFloats) {
  constexpr float most = std::numeric_limits<float>::max();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const std::vector<Aabb> boxes{
      point(0, 0, 0), point(most, -most, most), {{most, most, most}, {most, most, most}}};
  for (const HilbertGrid& grid :
       {HilbertGrid({1, 1, 1}, {1, 1, 1}, 12), HilbertGrid({-inf, 0, 0}, {inf, 1, 1}, 12),
        HilbertGrid({-most, -most, -most}, {most, most, most}, 30)}) {
    for (const std::uint32_t code : codes_of(grid, boxes)) {
      EXPECT_LT(code, std::uint32_t{1} << grid.code_bits());
    }
  }
}

}  // namespace
}  // namespace touchstone
