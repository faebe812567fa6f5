// The lengths and coordinates of a case, for changes of single numbers.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "harness/files/cases.h"

namespace touchstone::grade {

// Returns all lengths and coordinates of a case, in an order that depends only on its shapes.
std::vector<double> numbers_of(files::Case c);

// Replaces each number x by change(place, x); places are those of numbers_of. Returns whether a
// number changed.
using NumberChange = std::function<double(std::size_t place, double x)>;
bool change_numbers(files::Case& c, const NumberChange& change);

// Rounds x to this number of significant decimal digits.
double rounded(double x, int digits);

// Returns the number of digits of the shortest decimal number that reads back as x; 0 for zero.
int digits_of(double x);

}  // namespace touchstone::grade
