// Finds exact answers for a case when they are first asked for.
#include "harness/grade/true_case.h"

#include <limits>
#include <utility>

namespace touchstone::grade {

TrueCase::Truth::Truth(const files::Case& c, Encoding encoding, oracle::Oracle& oracle)
    : pair(c, encoding) {
  if (pair.is_finite()) {
    measure = oracle.measure(pair.a(), pair.b());
  } else {
    measure.lower = -std::numeric_limits<double>::infinity();
    measure.upper = std::numeric_limits<double>::infinity();
  }
}

TrueCase::TrueCase(files::Case c, std::uint64_t index, oracle::Oracle& oracle)
    : case_(std::move(c)), index_(index), oracle_(&oracle) {}

const TrueCase::Truth& TrueCase::truth(Encoding encoding) {
  auto& slot = truths_[static_cast<std::size_t>(encoding)];
  if (!slot) slot = std::make_unique<Truth>(case_, encoding, *oracle_);
  return *slot;
}

}  // namespace touchstone::grade
