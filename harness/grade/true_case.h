// A case with its exact answers, one for each encoding.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "algorithms/oracle/oracle.h"
#include "harness/files/cases.h"
#include "harness/grade/encoding.h"

namespace touchstone::grade {

class TrueCase {
 public:
  // The oracle must outlive this object.
  TrueCase(files::Case c, std::uint64_t index, oracle::Oracle& oracle);

  // The exact answer for the pair in an encoding.
  struct Truth {
    EncodedPair pair;
    oracle::Measure measure;  // spans all numbers if the pair is not finite
    Truth(const files::Case& c, Encoding encoding, oracle::Oracle& oracle);
  };
  const Truth& truth(Encoding encoding);  // computed on the first call

  const files::Case& pair() const { return case_; }
  std::uint64_t index() const { return index_; }
  oracle::Oracle& oracle() { return *oracle_; }

 private:
  files::Case case_;
  std::uint64_t index_;
  oracle::Oracle* oracle_;
  std::array<std::unique_ptr<Truth>, all_encodings.size()> truths_;
};

}  // namespace touchstone::grade
