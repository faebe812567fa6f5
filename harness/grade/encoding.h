// The exact problem that an algorithm is given: a case in one of the encodings.
#pragma once

#include "algorithms/encoding.h"
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

}  // namespace touchstone::grade
