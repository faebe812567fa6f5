// The exact problem that an algorithm is given: a case in one of the encodings.
#pragma once

#include "algorithms/encoding.h"
#include "algorithms/oracle/solid.h"
#include "harness/files/cases.h"

namespace touchstone::grade {

// The pair's signed distance is that of what an algorithm of this encoding is given; its place in
// the world is the case's but for the relative ones, which have the first body's centre at the
// origin.
class EncodedPair {
 public:
  EncodedPair(const files::Case& c, Encoding encoding);
  EncodedPair(const EncodedPair&) = delete;  // the bodies know the place of their solids
  EncodedPair& operator=(const EncodedPair&) = delete;

  const oracle::Body& a() const { return a_; }
  const oracle::Body& b() const { return b_; }
  // False where a number has left the range of floats: then there is no such problem.
  bool is_finite() const { return finite_; }

 private:
  struct Parts;
  explicit EncodedPair(const Parts& parts);

  oracle::Solid solid_a_, solid_b_;
  oracle::Body a_, b_;
  bool finite_;
};

}  // namespace touchstone::grade
