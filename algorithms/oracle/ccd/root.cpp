// Part of the oracle: roots of polynomials.
#include "algorithms/oracle/ccd/root.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/oracle/numbers/dyadic.h"

namespace touchstone::oracle::ccd {
namespace {

template <int most>
void add_roots(const Polynomial<most>& p, const Cell& cell, std::vector<Root<most>>& roots) {
  const int changes = restricted(p, cell).changes();
  if (changes == 0) return;
  if (changes == 1) {
    roots.emplace_back(p, cell);
    return;
  }
  add_roots(p, first_half(cell), roots);
  if (sign_at(p, middle(cell)) == 0) roots.emplace_back(middle(cell));
  add_roots(p, second_half(cell), roots);
}

// The numerator of the end of a cell.
Integer end_of(const Cell& cell) {
  Integer end = cell.numerator;
  if (!cell.is_point) ++end;
  return end;
}

// The ends of both cells as integers over the greater of the two powers.
struct Ends {
  Integer begin, end;
};
Ends ends_of(const Cell& cell, int power) {
  const int shift = power - cell.power;
  return {cell.numerator << shift, end_of(cell) << shift};
}

}  // namespace

template <int most>
std::vector<Root<most>> roots_of(const Polynomial<most>& p) {
  std::vector<Root<most>> roots;
  // Multiple roots outside of the interval do no harm, and one change of sign is a simple root.
  const bool is_simple = restricted(p, Cell{}).changes() <= 1;
  const Polynomial<most> simple = is_simple ? p : square_free(p);
  const Cell zero{0, 0, true}, one{1, 0, true};
  if (sign_at(simple, zero) == 0) roots.emplace_back(zero);
  add_roots(simple, Cell{}, roots);
  if (sign_at(simple, one) == 0) roots.emplace_back(one);
  return roots;
}

// Quadratic interval refinement (Abbott, "Quadratic Interval Refinement for Real Roots", 2006): the
// chord says which of many small cells has the root, and signs at its ends prove it. Where they do
// not, the cell is halved.
template <int most>
void Root<most>::refine() {
  if (cell_.is_point) return;
  const Cell next{end_of(cell_), cell_.power, true};
  const Integer begin = value_at(polynomial_, cell_), end = value_at(polynomial_, next);
  if (jump_ > 1 && begin.sign() * end.sign() < 0) {
    const Scaled part = scaled(begin), whole = scaled(begin - end);
    const double fraction = std::ldexp(part.mantissa / whole.mantissa,
                                       static_cast<int>(part.exponent - whole.exponent));
    const double cells = std::ldexp(1, jump_);
    const double place = std::min(std::floor(fraction * cells), cells - 1);
    Cell low{(cell_.numerator << jump_) + static_cast<std::int64_t>(place), cell_.power + jump_,
             true};
    const int low_sign = sign_at(polynomial_, low);
    Cell high = low;
    ++high.numerator;
    const int high_sign = sign_at(polynomial_, high);
    if (low_sign == 0 || high_sign == 0) {
      cell_ = low_sign == 0 ? low : high;
      return;
    }
    if (low_sign != high_sign) {
      low.is_point = false;
      cell_ = low;
      jump_ = std::min(2 * jump_, 48);
      return;
    }
    jump_ /= 2;
  } else {
    jump_ = 2;
  }
  const Cell half = middle(cell_);
  if (sign_at(polynomial_, half) == 0) {
    cell_ = half;
  } else if (restricted(polynomial_, first_half(cell_)).changes() == 1) {
    // One change of sign stays one or becomes none where the interval shrinks.
    cell_ = first_half(cell_);
  } else {
    cell_ = second_half(cell_);
  }
}

template <int most>
bool Root<most>::is_root_of(const Polynomial<most>& p) const {
  if (cell_.is_point) return sign_at(p, cell_) == 0;
  // The divisor has no other root in the cell than this one, and if it has this one, once: the number
  // of changes is even or odd with the number of roots.
  const Polynomial<most> shared = common_divisor(polynomial_, p);
  return shared.degree >= 1 && restricted(shared, cell_).changes() % 2 == 1;
}

template <int most>
int Root<most>::sign_of(const Polynomial<most>& p) {
  if (p.is_zero()) return 0;
  // The divisor costs as much as some refinements.
  constexpr int refined_enough = 40;
  bool is_known_to_differ = false;
  for (;;) {
    if (cell_.is_point) return sign_at(p, cell_);
    if (const int sign = restricted(p, cell_).sign(); sign != 0) return sign;
    if (!is_known_to_differ && cell_.power >= refined_enough) {
      if (is_root_of(p)) return 0;
      is_known_to_differ = true;
    }
    refine();
  }
}

template <int most>
TimeBounds Root<most>::bounds() {
  for (;;) {
    const TimeBounds bounds = {round_down(cell_.numerator, -cell_.power),
                               round_up(end_of(cell_), -cell_.power)};
    const bool is_narrow =
        std::nextafter(bounds.low, std::numeric_limits<double>::infinity()) >= bounds.high;
    if (cell_.is_point || is_narrow || cell_.power > 1060) return bounds;
    refine();
  }
}

template <int most>
std::strong_ordering compare(Root<most>& x, Root<most>& y) {
  bool is_known_to_differ = false;
  for (;;) {
    const int power = std::max(x.cell_.power, y.cell_.power);
    const Ends a = ends_of(x.cell_, power), b = ends_of(y.cell_, power);
    if (x.cell_.is_point && y.cell_.is_point) return a.begin.compare(b.begin) <=> 0;
    // Open cells may share an end, and a point may be the end of one.
    if (a.end <= b.begin) return std::strong_ordering::less;
    if (b.end <= a.begin) return std::strong_ordering::greater;
    // Of two cells that meet, one is in the other.
    if (!is_known_to_differ) {
      const bool x_is_inner =
          x.cell_.is_point || (!y.cell_.is_point && x.cell_.power > y.cell_.power);
      Root<most>& inner = x_is_inner ? x : y;
      const Root<most>& outer = x_is_inner ? y : x;
      if (inner.is_root_of(outer.polynomial_)) return std::strong_ordering::equal;
      is_known_to_differ = true;
    }
    x.refine();
    y.refine();
  }
}

template class Root<3>;
template class Root<6>;
template std::strong_ordering compare(Root<3>&, Root<3>&);
template std::strong_ordering compare(Root<6>&, Root<6>&);
template std::vector<Root<3>> roots_of(const Cubic&);
template std::vector<Root<6>> roots_of(const Sextic&);

}  // namespace touchstone::oracle::ccd
