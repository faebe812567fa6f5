// A case with its exact answers, and the grade of one outcome about it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "algorithms/oracle/oracle.h"
#include "harness/check/check_request.h"
#include "harness/files/cases.h"
#include "harness/grade/encoding.h"

namespace touchstone {

class TrueCase {
 public:
  // The oracle stays alive.
  TrueCase(Case c, std::uint64_t index, oracle::Oracle& oracle);

  // What is true of the pair in an encoding.
  struct Truth {
    EncodedPair pair;
    oracle::Measure measure;  // of anything between the infinities where the pair is not finite
    Truth(const Case& c, Encoding encoding, oracle::Oracle& oracle);
  };
  const Truth& truth(Encoding encoding);  // found when it is first asked for

  const Case& pair() const { return case_; }
  std::uint64_t index() const { return index_; }
  oracle::Oracle& oracle() { return *oracle_; }

 private:
  Case case_;
  std::uint64_t index_;
  oracle::Oracle* oracle_;
  std::array<std::unique_ptr<Truth>, all_encodings.size()> truths_;
};

// Which query an answer is to.
struct Query {
  std::uint32_t regime, entry;  // places in the request
  Precision scalar;
  Task task;
};

GradedAnswer grade_answer(const CheckRequest& request, const Query& query, TrueCase& c,
                          const Outcome& outcome);

}  // namespace touchstone
