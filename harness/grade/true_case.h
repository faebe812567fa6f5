// A case in the encodings that algorithms are given, with its exact answers, one for each encoding.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "algorithms/encoding.h"
#include "algorithms/oracle/oracle.h"
#include "algorithms/oracle/solid.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

// The two bodies that an algorithm of this encoding is given. Their place in the world is that of
// the case, except with the relative encodings, which put the first body's centre at the origin.
class EncodedPair {
 public:
  EncodedPair(const files::Case& c, Encoding encoding);
  EncodedPair(const EncodedPair&) = delete;  // the bodies point to their solids
  EncodedPair& operator=(const EncodedPair&) = delete;

  const oracle::Body& a() const { return a_; }
  const oracle::Body& b() const { return b_; }
  // Returns false if a number is beyond the range of floats: then the problem does not exist.
  bool is_finite() const { return finite_; }

 private:
  struct Parts;
  explicit EncodedPair(const Parts& parts);

  oracle::Solid solid_a_, solid_b_;
  oracle::Body a_, b_;
  bool finite_;
};

// The case with each number rounded to float, as by Encoding::float32; a number beyond the range of floats is
// infinite. Hulls have their vertices alone.
files::Case rounded_to_floats(files::Case c);

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
