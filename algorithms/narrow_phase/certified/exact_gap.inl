// Part of certified: whether the cores of two rounded polytopes are exactly as far apart as their
// radii, in integers of `size` limbs. Included by exact_contact.cpp.
//
// The core's difference C is nearest to the origin at a corner, an edge or a triangle of it. The
// squared distance is a quotient of two integers, and so is compared with the squared radius
// without a root. All of C must be behind the plane through that point.
#include <algorithm>
#include <span>

#include "algorithms/narrow_phase/certified/grid_body.h"

namespace touchstone {
namespace {

template <std::size_t size>
class ExactGap {
 public:
  using Body = GridBody<size>;

  // Both bodies have listed what is near their support planes; `radius` is the sum of the two.
  ExactGap(const Body& a, const Body& b, const FixedInteger<size>& radius)
      : a_(a), b_(b), square_(radius * radius) {}

  // `corners`: the points of a and of b that make one to three points of C, on which the point
  // nearest to the origin is supposed to be. Returns unknown if it is not. `is_near` is asked
  // whether the exact direction from the origin (any length) is the one to which the vertices were
  // listed.
  template <class IsNear>
  Answer decide(std::span<const std::array<std::size_t, 2>> corners, const IsNear& is_near) const {
    std::array<FixedVector<size>, 3> points;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      points[k] = a_[corners[k][0]] - b_[corners[k][1]];
    }
    const auto& [p, q, r] = points;
    switch (corners.size()) {
      case 1: {
        const auto height = dot(p, p);
        return verdict((height - square_).sign(), p, height, is_near);
      }
      case 2: {
        const FixedVector<size> edge = q - p;
        const auto length = dot(edge, edge), along = dot(p, edge);
        if (along.sign() > 0 || (along + length).sign() < 0) return Answer::unknown;
        const int sign = (dot(p, p) * length - along * along - square_ * length).sign();
        FixedVector<3 * size> across;
        for (std::size_t i = 0; i < 3; ++i) across[i] = length * p[i] - along * edge[i];
        return verdict(sign, across, dot(across, p), is_near);
      }
      default: {
        FixedVector<2 * size> normal = cross(q - p, r - p);
        const auto is_behind = [&](const FixedVector<size>& u, const FixedVector<size>& v) {
          return dot(normal, cross(u, v)).sign() < 0;
        };
        if (is_behind(p, q) || is_behind(q, r) || is_behind(r, p)) return Answer::unknown;
        auto height = dot(normal, p);
        if (height.sign() == 0) return Answer::unknown;
        if (height.sign() < 0) {
          normal = FixedVector<2 * size>{} - normal;
          height = FixedInteger<3 * size>{} - height;
        }
        const int sign = (height * height - square_ * dot(normal, normal)).sign();
        return verdict(sign, normal, height, is_near);
      }
    }
  }

 private:
  // `sign`: that of the distance less the radius. `direction` is from the origin to the nearest
  // point, whose product with it is `height`.
  template <std::size_t wide, class IsNear>
  Answer verdict(int sign, const FixedVector<wide>& direction,
                 const FixedInteger<wide + size>& height, const IsNear& is_near) const {
    if (sign < 0) return Answer::overlapping;
    if (!is_near(rounded(direction))) return Answer::unknown;
    auto least = dot(direction, a_[a_.near().front()]);
    auto most = dot(direction, b_[b_.near().front()]);
    for (const std::size_t i : a_.near().subspan(1)) {
      const auto value = dot(direction, a_[i]);
      if ((value - least).sign() < 0) least = value;
    }
    for (const std::size_t i : b_.near().subspan(1)) {
      const auto value = dot(direction, b_[i]);
      if ((value - most).sign() > 0) most = value;
    }
    if ((least - most - height).sign() < 0) return Answer::unknown;
    return sign > 0 ? Answer::separated : Answer::touching;
  }

  const Body &a_, &b_;
  FixedInteger<2 * size> square_;
};

}  // namespace
}  // namespace touchstone
