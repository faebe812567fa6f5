#include "harness/check/true_case.h"

#include <limits>
#include <utility>

#include "harness/check/margins.h"
#include "harness/check/pair_size.h"

namespace touchstone {

TrueCase::Truth::Truth(const Case& c, Encoding encoding, oracle::Oracle& oracle)
    : pair(c, encoding) {
  if (pair.is_finite()) {
    measure = oracle.measure(pair.a(), pair.b());
  } else {
    measure.lower = -std::numeric_limits<double>::infinity();
    measure.upper = std::numeric_limits<double>::infinity();
  }
}

TrueCase::TrueCase(Case c, std::uint64_t index, oracle::Oracle& oracle)
    : case_(std::move(c)), index_(index), size_(pair_size(case_)), oracle_(&oracle) {}

const TrueCase::Truth& TrueCase::truth(Encoding encoding) {
  auto& slot = truths_[static_cast<std::size_t>(encoding)];
  if (!slot) slot = std::make_unique<Truth>(case_, encoding, *oracle_);
  return *slot;
}

GradedAnswer grade_answer(const CheckRequest& request, const Query& query, TrueCase& c,
                          const Outcome& outcome) {
  const NarrowPhaseEntry& algorithm = *request.narrow[query.entry];
  GradedAnswer answer;
  answer.regime = query.regime;
  answer.entry = query.entry;
  answer.index = c.index();
  answer.kind_a = c.pair().shape_a.kind;
  answer.kind_b = c.pair().shape_b.kind;
  answer.scalar = query.scalar;
  answer.task = query.task;
  answer.encoding = encoding_of(algorithm, answer.kind_a, answer.kind_b, query.task, query.scalar);
  answer.answer = outcome.answer;
  answer.status = outcome.status;
  answer.iterations = outcome.iterations;
  answer.size = c.size();
  const TrueCase::Truth& end = c.truth(Encoding::as_given);
  answer.exact = end.measure.answer;
  answer.lower = end.measure.lower;
  answer.upper = end.measure.upper;
  answer.end_to_end = grade(outcome, query.task, end.measure, end.pair.a(), end.pair.b());
  answer.given = answer.end_to_end;
  if (answer.encoding != Encoding::as_given) {
    const TrueCase::Truth& given = c.truth(answer.encoding);
    answer.given = grade(outcome, query.task, given.measure, given.pair.a(), given.pair.b());
  }
  answer.witnesses = grade_witnesses(outcome, query.task, end.pair.a(), end.pair.b(), c.oracle());
  answer.beyond =
      algorithm.info.origin == Origin::ours &&
      !beyond_margins(algorithm, answer, request.regimes[query.regime]->extreme).empty();
  return answer;
}

}  // namespace touchstone
