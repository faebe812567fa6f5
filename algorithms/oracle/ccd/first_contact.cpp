// Part of the oracle: the first contact by algebraic numbers.
#include "algorithms/oracle/ccd/first_contact.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <vector>

namespace touchstone::oracle::ccd {
namespace {

// The polynomials of contact_polynomials.h, made when they are asked for.
class Conditions {
 public:
  Conditions(const MovingFeatures& features, const IntegerPolynomials& given)
      : features_(features), given_(given), volume_(polynomial_of(given.volume)) {}

  const Cubic& volume() const { return volume_; }

  // An area with the sign of its vertex's side.
  Cubic area(std::size_t vertex, std::size_t axis) const {
    std::array<Integer, 3> area;
    for (std::size_t c = 0; c < 3; ++c) {
      area[c] = features_.side(vertex) * given_.areas[vertex][c][axis];
    }
    return polynomial_of(area);
  }

  // The differences of coordinates: a vertex of the first feature less one of the second.
  std::vector<Cubic> differences(std::size_t axis) const {
    const MovingEdges<Integer> edges = integer_edges(features_, grid_of(features_));
    const auto place = [&](std::size_t time, std::size_t vertex) {
      return vertex == 0 ? Integer(0) : edges.at[time][vertex - 1][axis];
    };
    std::vector<Cubic> list;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (features_.side(i) < 0 || features_.side(j) > 0) continue;
        list.push_back(polynomial_of(
            std::array<Integer, 2>{place(0, i) - place(0, j), place(1, i) - place(1, j)}));
      }
    }
    return list;
  }

  // The axes, first that along which the areas are greatest in the middle of the time: their signs
  // need the fewest digits.
  std::array<std::size_t, 3> axes() const {
    std::array<Integer, 3> size;
    for (const auto& area : given_.areas) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        size[axis] += abs(Integer(area[0][axis] + area[1][axis] + area[2][axis]));
      }
    }
    std::array<std::size_t, 3> order = {0, 1, 2};
    std::ranges::sort(order, [&](std::size_t i, std::size_t k) { return size[i] > size[k]; });
    return order;
  }

  // The volume is zero at this time.
  bool share_a_point(ContactTime& time) const {
    for (const std::size_t axis : axes()) {
      int seen = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const int sign = time.sign_of(area(i, axis));
        if (seen * sign < 0) return false;
        if (sign != 0) seen = sign;
      }
      if (seen != 0) return true;
    }
    // All on one line.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      int seen = 0;
      bool meet = false;
      for (const Cubic& difference : differences(axis)) {
        const int sign = time.sign_of(difference);
        meet = meet || sign == 0 || seen * sign < 0;
        seen = sign;
      }
      if (!meet) return false;
    }
    return true;
  }

 private:
  const MovingFeatures& features_;
  const IntegerPolynomials& given_;
  Cubic volume_;
};

// The times at which a contact can begin. If the volume is not always zero, its roots. Otherwise
// contact depends on the signs of the other polynomials, which change at their roots alone; as the
// times of contact are a closed set, the first is 0 or such a root.
std::vector<ContactTime> candidates(const Conditions& conditions) {
  if (!conditions.volume().is_zero()) return roots_of(conditions.volume());
  std::vector<ContactTime> times = {ContactTime(Cell{0, 0, true})};
  const auto add = [&](const Cubic& p) {
    if (p.is_zero()) return;
    for (const ContactTime& root : roots_of(p)) times.push_back(root);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 4; ++i) add(conditions.area(i, axis));
    std::ranges::for_each(conditions.differences(axis), add);
  }
  sort_by_time(times, [](ContactTime& time) -> ContactTime& { return time; });
  return times;
}

}  // namespace

std::optional<ContactTime> first_contact(const MovingFeatures& features,
                                         const IntegerPolynomials& given) {
  const Conditions conditions(features, given);
  for (ContactTime& time : candidates(conditions)) {
    if (conditions.share_a_point(time)) return time;
  }
  return {};
}

std::optional<ContactTime> first_contact(const MovingFeatures& features) {
  return first_contact(features, contact_polynomials(integer_edges(features, grid_of(features))));
}

}  // namespace touchstone::oracle::ccd
