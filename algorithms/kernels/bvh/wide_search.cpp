// The search of one tree, and the choice of the instruction level.
//
// The slack is that of the simultaneous descent (wide_descent.cpp), with the sum of all lengths in
// place of the greatest coordinate; 17 parts of 2^24 of it are for an inverse that is off. A root of a sum of three squares is off by less than 8 parts of
// 2^24, which the factor `certain` takes away. Squares above 3e38 are infinite: what is further than
// 1e19 then is dropped only if the radius is less.
#include "algorithms/kernels/bvh/wide_search.h"

#include <bit>
#include <cmath>
#include <limits>

#include "algorithms/core/mesh/skew.h"
#include "algorithms/kernels/simd/vector.h"

// A node has eight lanes, which is what the second level has.
#if !defined(TOUCHSTONE_TWO_LEVELS)
#define TOUCHSTONE_TWO_LEVELS
#define TOUCHSTONE_SEARCH_HAS_TWO_LEVELS
#endif

namespace touchstone {
namespace {

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/wide_search.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

double norm(const Mat3d& m) { return m.cwiseAbs().rowwise().sum().maxCoeff(); }

// The greatest magnitude of a finite coordinate.
double magnitude(const Vec3d& low, const Vec3d& high) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double greatest = 0;
  for (int k = 0; k < 3; ++k) {
    for (const double x : {std::abs(low[k]), std::abs(high[k])}) {
      greatest = x > greatest && x < infinite ? x : greatest;
    }
  }
  return greatest;
}

// The centre of a boundless side is 0, and its half extent infinite. Written in place, since a copy waits for the
// stores.
void set(SearchBox::Extent& made, const Vec3d& centre, const Vec3d& half, double slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<int>(k);
    const bool bounded = std::isfinite(centre[axis]) && std::isfinite(half[axis]);
    made.centre[k] = bounded ? static_cast<float>(centre[axis]) : 0;
    // Above what it rounds to by a part of 2^24 at least.
    made.half[k] = bounded ? static_cast<float>((half[axis] + slack) * (1 + 0x1p-23))
                           : std::numeric_limits<float>::infinity();
  }
}

// About the inverse of a matrix, what its product with the matrix is off from one, how many times as long it makes a
// vector, at most, and bounds on the norms of the matrix and of the inverse.
struct Inverse {
  Mat3d matrix;
  double skew, stretch, norm, norm_back;
};
constexpr double greatest_skew = 1e-6;  // for which greatest_row_of_turn holds

Inverse inverse_of(const Mat3d& m) {
  const double skew = skew_of(m);
  // The squares of lengths grow by as much as the product is off.
  if (skew <= greatest_skew)
    return {m.transpose(), skew, 1 + greatest_skew, greatest_row_of_turn, greatest_row_of_turn};
  // The norm bounds the root of the greatest eigenvalue.
  const Mat3d inverse = m.inverse();
  return {inverse, norm(inverse * m - Mat3d::Identity()),
          std::sqrt(norm(inverse.transpose() * inverse)), norm(m), norm(inverse)};
}

}  // namespace

SearchBox search_box(const Vec3d& low, const Vec3d& high, double radius, const Pose& map,
                     double error, double reach) {
  const Mat3d& turn = map.rotation;
  const Inverse inverse = inverse_of(turn);
  const bool has_inverse = inverse.skew <= greatest_skew;
  const double all = (1 + inverse.norm) * (1 + (has_inverse ? inverse.norm_back : 0)) *
                     (reach + magnitude(low, high) + map.translation.cwiseAbs().sum());
  const double slack = 288 * 0x1p-24 * all + 8 * error + std::numeric_limits<float>::min();
  SearchBox box;
  const Vec3d centre = low / 2 + high / 2, half = high / 2 - low / 2;
  set(box.own, centre, half, slack);
  if (has_inverse) {
    set(box.seen, inverse.matrix * (centre - map.translation), inverse.matrix.cwiseAbs() * half,
        slack);
  } else {
    const Vec3d unknown = Vec3d::Constant(std::numeric_limits<double>::infinity());
    set(box.seen, unknown, unknown, slack);
  }
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      box.view.turn[row][k] = static_cast<float>(turn(row, k));
      box.view.spread[row][k] = std::abs(box.view.turn[row][k]);
    }
    box.view.offset[row] = static_cast<float>(map.translation[row]);
  }
  box.view.slack = 0;  // the box has it
  box.radius = round_up(radius);
  box.seen_radius = has_inverse ? round_up(radius * inverse.stretch * (1 + 1e-6)) : 0;
  return box;
}

bool WideSearch::run(const WideBvh& tree, const SearchBox& box, Visit visit, void* context) {
  if (tree.nodes.empty()) return true;
  const auto near = isa() == Isa::baseline ? baseline::near_boxes : avx2::near_boxes;
  open_.assign(1, 0);
  while (!open_.empty()) {
    const WideNode& node = tree.nodes[open_.back()];
    open_.pop_back();
    for (unsigned bits = near(node, box); bits != 0; bits &= bits - 1) {
      const std::int32_t child = node.child[static_cast<std::size_t>(std::countr_zero(bits))];
      if (!WideNode::is_leaf(child)) {
        open_.push_back(static_cast<std::uint32_t>(child));
      } else if (!visit(context, WideNode::leaf(child))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace touchstone

#if defined(TOUCHSTONE_SEARCH_HAS_TWO_LEVELS)
#undef TOUCHSTONE_TWO_LEVELS
#undef TOUCHSTONE_SEARCH_HAS_TWO_LEVELS
#endif
