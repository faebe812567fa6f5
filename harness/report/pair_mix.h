// What pairs of bodies do in a scene: how far apart they are, and how they move against each other.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "harness/scene/scene.h"

namespace touchstone::report {

// Pairs of convex bodies whose boxes overlap, over some frames. A pair is in contact if its gap is at most a hundredth of
// the smaller body's longest edge. It rests if, from this frame to the next, the two bodies move by less than a
// thousandth of that edge against each other where they touch; else it slides.
struct PairMix {
  std::size_t frames = 0;  // that were looked at
  std::size_t resting = 0, sliding = 0, apart = 0;
  std::size_t unknown = 0;     // without a distance
  std::size_t not_convex = 0;  // pairs that are left out, with a body that is not convex
  // Signed gaps as parts of the smaller body's longest edge, in the ranges of `gap_ranges`.
  std::array<std::size_t, 7> gaps = {};
  // Pairs of boxes in frames but the first, and those that were there in the frame before.
  std::size_t again = 0, after_first = 0;

  std::size_t known() const { return resting + sliding + apart; }
};
inline constexpr std::array<std::string_view, 7> gap_ranges = {
    "deeper than 10 %", "1 to 10 % deep",  "0.1 to 1 % deep", "within 0.1 %",
    "0.1 to 1 % apart", "1 to 10 % apart", "farther apart"};

// Looks at up to 24 frames, evenly spread, and in each at up to 20,000 pairs, evenly spread in their order. The scene
// has bodies.
PairMix pair_mix(const scene::Scene& scene);

}  // namespace touchstone::report
