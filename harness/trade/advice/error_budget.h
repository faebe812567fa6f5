// The error that a configuration may have.
#pragma once

#include <string>

#include "harness/trade/evaluation.h"
#include "harness/trade/front.h"

namespace touchstone::trade {

struct ErrorBudget {
  double most = 1e-3;  // a value of the request's measure
  // if true, every contact is found and every contact has an answer
  bool no_false_negatives = false;
};

bool meets(const ErrorBudget& budget, ErrorMeasure measure, const Evaluation& evaluation,
           const RepresentationSpread& representation);

// A text such as "verdicts at most 0.001, no contact missed".
std::string to_string(const ErrorBudget& budget, ErrorMeasure measure);

}  // namespace touchstone::trade
