// Part of the oracle: times that are roots of polynomials, exactly. Included by the files of this
// folder, and by tests.
#pragma once

#include <compare>
#include <utility>
#include <vector>

#include "algorithms/oracle/ccd/polynomial.h"

namespace touchstone::oracle::ccd {

// A real algebraic number in [0, 1]: the only root of a polynomial in a cell, and a simple one.
// Questions make the cell smaller; the number stays the same.
class Root {
 public:
  // The time where a cell that is a point lies.
  explicit Root(const Cell& point) : cell_(point) {}
  // The cell is open, and the coefficients of the polynomial on it have one change of sign.
  Root(Polynomial polynomial, Cell cell)
      : polynomial_(std::move(polynomial)), cell_(std::move(cell)) {}

  // The sign of a polynomial there: by refinement, and where that would not end by the divisor that
  // both polynomials share.
  int sign_of(const Polynomial& p);

  // Bounds in doubles: neighbours, or the same double twice, unless the number is below 2^-1000.
  struct Bounds {
    double low, high;
  };
  Bounds bounds();

  friend std::strong_ordering compare(Root& x, Root& y);

 private:
  bool is_root_of(const Polynomial& p) const;
  void refine();

  Polynomial polynomial_;
  Cell cell_;
  int jump_ = 1;  // the next refinement tries a cell 2^-jump_ of this
};

std::strong_ordering compare(Root& x, Root& y);

// The roots in [0, 1], each once, in order. The polynomial is not zero.
std::vector<Root> roots_of(const Polynomial& p);

}  // namespace touchstone::oracle::ccd
