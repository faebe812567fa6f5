// The text of an error budget.
#include "harness/trade/advice/error_budget.h"

#include <fmt/format.h>

namespace touchstone::trade {

bool meets(const ErrorBudget& budget, ErrorMeasure measure, const Evaluation& evaluation,
           const RepresentationSpread& representation) {
  if (!evaluation.ok()) return false;
  const PointErrors& errors = evaluation.errors;
  if (budget.no_false_negatives) {
    if (errors.false_negatives > 0) return false;
    for (std::size_t bin = 0; bin < errors.bins.size(); ++bin) {
      const bool contact = !(gap_range(bin).high > 0);
      if (contact && errors.bins[bin].failed > 0) return false;
    }
  }
  return error_of(errors, representation, measure) <= budget.most;
}

std::string to_string(const ErrorBudget& budget, ErrorMeasure measure) {
  return fmt::format("{} at most {}{}", to_string(measure), budget.most,
                     budget.no_false_negatives ? ", no contact missed" : "");
}

}  // namespace touchstone::trade
