// Part of the oracle: times that are roots of polynomials, exactly. Included by the files of this
// folder, and by tests.
#pragma once

#include <compare>
#include <cstddef>
#include <utility>
#include <vector>

#include "algorithms/oracle/ccd/polynomial.h"

namespace touchstone::oracle::ccd {

// Bounds of a time in doubles: neighbours, or the same double twice, unless it is below 2^-1000.
struct TimeBounds {
  double low, high;
};

// A real algebraic number in [0, 1]: the only root of a polynomial in a cell, and a simple one.
// Questions make the cell smaller; the number stays the same. Instantiated for cubics and sextics.
template <int most>
class Root {
 public:
  // The time where a cell that is a point lies.
  explicit Root(const Cell& point) : cell_(point) {}
  // The cell is open, and the coefficients of the polynomial on it have one change of sign.
  Root(Polynomial<most> polynomial, Cell cell)
      : polynomial_(std::move(polynomial)), cell_(std::move(cell)) {}

  // The sign of a polynomial there: by refinement, and where that would not end by the divisor that
  // both polynomials share.
  int sign_of(const Polynomial<most>& p);

  TimeBounds bounds();

  template <int degree>
  friend std::strong_ordering compare(Root<degree>& x, Root<degree>& y);

 private:
  bool is_root_of(const Polynomial<most>& p) const;
  void refine();

  Polynomial<most> polynomial_;
  Cell cell_;
  int jump_ = 1;  // the next refinement tries a cell 2^-jump_ of this
};

template <int most>
std::strong_ordering compare(Root<most>& x, Root<most>& y);

// Sorts by the times that `time_of` gives. Comparing makes their cells smaller, so it sorts by hand.
template <class Item, class TimeOf>
void sort_by_time(std::vector<Item>& items, const TimeOf& time_of) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    for (std::size_t k = i; k > 0; --k) {
      if (!std::is_lt(compare(time_of(items[k]), time_of(items[k - 1])))) break;
      std::swap(items[k], items[k - 1]);
    }
  }
}

// The roots in [0, 1], each once, in order. The polynomial is not zero.
template <int most>
std::vector<Root<most>> roots_of(const Polynomial<most>& p);

}  // namespace touchstone::oracle::ccd
