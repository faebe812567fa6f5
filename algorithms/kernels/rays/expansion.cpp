// Arithmetic of expansions. Each step below is one of Shewchuk's, with his name for it.
#include "algorithms/kernels/rays/expansion.h"

#include <cmath>

#include "algorithms/core/double_double.h"

namespace touchstone {

FloatExpansion FloatExpansion::difference(double a, double b) {
  const DoubleDouble d = DoubleDouble::sum(a, -b);  // two-diff
  FloatExpansion e;
  if (d.low != 0) e.terms_.push_back(d.low);
  if (d.high != 0) e.terms_.push_back(d.high);
  return e;
}

double FloatExpansion::value() const {
  double sum = 0;
  for (const double term : terms_) sum += term;
  return sum;
}

FloatExpansion FloatExpansion::operator-() const {
  FloatExpansion e = *this;
  for (double& term : e.terms_) term = -term;
  return e;
}

// grow-expansion
void FloatExpansion::add(double x) {
  std::size_t kept = 0;
  for (const double term : terms_) {
    const DoubleDouble s = DoubleDouble::sum(x, term);
    x = s.high;
    if (s.low != 0) terms_[kept++] = s.low;
  }
  terms_.resize(kept);
  if (x != 0) terms_.push_back(x);
}

// compress
void FloatExpansion::compress() {
  if (terms_.size() < 2) return;
  double sum = terms_.back();
  std::size_t bottom = terms_.size();
  for (std::size_t i = terms_.size() - 1; i-- > 0;) {
    const DoubleDouble s = DoubleDouble::sum(sum, terms_[i]);
    if (s.low != 0) {
      terms_[--bottom] = s.high;
      sum = s.low;
    } else {
      sum = s.high;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = bottom; i < terms_.size(); ++i) {
    const DoubleDouble s = DoubleDouble::sum(terms_[i], sum);
    sum = s.high;
    if (s.low != 0) terms_[kept++] = s.low;
  }
  terms_.resize(kept);
  if (sum != 0) terms_.push_back(sum);
}

// expansion-sum
FloatExpansion operator+(const FloatExpansion& a, const FloatExpansion& b) {
  FloatExpansion sum = a;
  for (const double term : b.terms_) sum.add(term);
  sum.compress();
  return sum;
}

// The sum of scale-expansion's for each term of b.
FloatExpansion operator*(const FloatExpansion& a, const FloatExpansion& b) {
  FloatExpansion sum;
  for (const double factor : b.terms_) {
    for (const double term : a.terms_) {
      const DoubleDouble product = DoubleDouble::product(term, factor);
      if (product.low != 0) sum.add(product.low);
      sum.add(product.high);
    }
  }
  sum.compress();
  return sum;
}

}  // namespace touchstone
