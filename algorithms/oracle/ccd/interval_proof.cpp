// Part of the oracle: the proof over intervals.
#include "algorithms/oracle/ccd/interval_proof.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace touchstone::oracle::ccd {
namespace {

constexpr int most_halvings = 50, most_nodes = 400;
// Where so many have not shown a hit, an area that is zero or nearly so is in the way, and integers
// are quicker.
constexpr int most_without_hit = 24;
constexpr double narrow_enough = 0x1p-48, wide_enough_to_fail = 0x1p-40;

struct Node {
  double begin, width;
  int halvings;
  std::array<double, 4> volume;
  std::array<std::array<double, 3>, 4> areas;
};

// What is known of the signs of some coefficients.
struct Signs {
  bool all_positive = true, all_negative = true;

  void add(double x, double error) {
    all_positive = all_positive && x > error;
    all_negative = all_negative && x < -error;
  }
};

template <std::size_t size>
double greatest(const std::array<double, size>& numbers) {
  double most = 0;
  for (const double x : numbers) most = std::max(most, std::abs(x));
  return most;
}

// De Casteljau at the middle: `left` gets the first half, `right` the second.
template <std::size_t size>
void halve(const std::array<double, size>& whole, std::size_t count, std::array<double, size>& left,
           std::array<double, size>& right) {
  std::array<double, size> row = whole;
  for (std::size_t done = 0; done < count; ++done) {
    left[done] = row[0];
    right[count - 1 - done] = row[count - 1 - done];
    for (std::size_t i = 0; i + 1 < count - done; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
  }
}

class Search {
 public:
  explicit Search(const RoundedPolynomials& given)
      : given_(given), count_(static_cast<std::size_t>(given.degree) + 1) {
    constexpr double growth = 3 * most_halvings * 0x1p-53;
    volume_error_ = given.volume_error + growth * greatest(given.volume);
    double area = 0;
    for (const auto& one : given.areas) area = std::max(area, greatest(one));
    area_error_ = given.area_error + growth * area;
  }

  IntervalProof run() {
    stack_[0] = {0, 1, 0, given_.volume, given_.areas};
    std::size_t open = 1;
    double contact_by = 2;
    for (int nodes = 0; open > 0; ++nodes) {
      if (nodes == most_nodes) return {Proven::nothing, 0, 0};
      Node& node = stack_[open - 1];
      const State state = look(node);
      if (state == State::free) {
        --open;
        continue;
      }
      if (state == State::hit) contact_by = node.begin + node.width;
      const bool is_narrow = state == State::hit && node.width <= narrow_enough;
      const int most = contact_by > 1 ? most_without_hit : most_halvings;
      if (is_narrow || state == State::stuck || node.halvings >= most) {
        if (contact_by - node.begin > wide_enough_to_fail) return {Proven::nothing, 0, 0};
        return {Proven::hit, node.begin, contact_by};
      }
      Node& second = node;
      Node& first = stack_[open++];
      first.width = 0.5 * node.width;
      first.begin = node.begin;
      first.halvings = node.halvings + 1;
      const std::array<double, 4> volume = node.volume;
      halve(volume, count_, first.volume, second.volume);
      for (std::size_t i = 0; i < 4; ++i) {
        const std::array<double, 3> area = node.areas[i];
        halve(area, 3, first.areas[i], second.areas[i]);
      }
      second.begin += first.width;
      second.width = first.width;
      second.halvings = first.halvings;
    }
    return {Proven::miss, 1, 1};
  }

 private:
  enum class State { free, hit, stuck, open };

  State look(const Node& node) const {
    Signs volume;
    for (std::size_t i = 0; i < count_; ++i) volume.add(node.volume[i], volume_error_);
    if (volume.all_positive || volume.all_negative) return State::free;
    bool some_positive = false, some_negative = false, all_positive = true, all_negative = true;
    for (std::size_t i = 0; i < 4; ++i) {
      if (given_.is_zero[i]) continue;
      Signs area;
      for (const double x : node.areas[i]) area.add(x, area_error_);
      some_positive = some_positive || area.all_positive;
      some_negative = some_negative || area.all_negative;
      all_positive = all_positive && area.all_positive;
      all_negative = all_negative && area.all_negative;
    }
    if (some_positive && some_negative) return State::free;
    const bool is_contact = (all_positive && some_positive) || (all_negative && some_negative);
    if (!is_contact) return State::open;
    const double begin = node.volume[0], end = node.volume[count_ - 1];
    const bool rises = begin < -volume_error_ && end > volume_error_;
    const bool falls = begin > volume_error_ && end < -volume_error_;
    if (rises || falls) return State::hit;
    // Nothing that halving could show.
    return greatest(node.volume) <= volume_error_ ? State::stuck : State::open;
  }

  const RoundedPolynomials& given_;
  std::size_t count_;
  double volume_error_, area_error_;
  std::array<Node, most_halvings + 2> stack_;
};

}  // namespace

IntervalProof prove_over_intervals(const RoundedPolynomials& polynomials) {
  return Search(polynomials).run();
}

}  // namespace touchstone::oracle::ccd
