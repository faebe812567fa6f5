// Part of the oracle: what proves an answer about two bodies of many parts. harness/files reads and writes it.
//
// The parts of each body are in a tree (part_tree.h), so that one plane can part many of them from many others.
// The cover is a walk over pairs of nodes, from both roots on: each step says what becomes of the pair at hand.
// Either one of the nodes is halved, and the walk goes on with its first half and then with its second one; or
// a plane parts all parts of one from all of the other; or both are one part, and the two have a common point;
// or the pair is left open. So no pair can be missing, and none can be there twice.
//
// All poses are taken literally: a part of a compound has the product of the two matrices, in rationals. A half-space
// among the parts is in no box, and its plane that of the inverse transpose of that product.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pair_sink.h"
#include "algorithms/oracle/certificates/certificate.h"

namespace touchstone::oracle {

struct PartsCertificate {
  // What is claimed. Intersect: the answer. Distance: that, and if the bodies are separated and have parts, bounds on
  // their distance. Contacts: that, and every pair of parts that has a common point.
  enum class Claim : std::uint8_t { intersect, distance, contacts };
  Claim claim = Claim::intersect;
  // Separated: the closed bodies share no point. Overlapping: they share one, as those that only touch do.
  // Unknown: some pairs of parts are open, and the others share no point.
  Answer answer = Answer::unknown;
  // Of a distance: at least and at most, metres.
  struct Bounds {
    double lower, upper;
  };
  std::optional<Bounds> bounds;
  std::uint64_t undecided = 0;  // how many pairs of parts are open

  // For the trees: each part of a body once. Empty where there is no cover.
  std::vector<std::uint32_t> order_a, order_b;
  struct Step {
    enum class Kind : std::uint8_t {
      halve_a,
      halve_b,
      plane,      // along `direction`, from a to b in world axes, of any length
      own_plane,  // that of the half-space which one of the two parts is
      meet,       // the next of `met`; of contacts alone
      open,
    };
    Kind kind = Kind::open;
    IntegerVector direction{};
  };
  std::vector<Step> cover;

  // A common point of two parts, as in certificate.h: a convex combination of points of their difference that
  // is within the radii, or a surface around 0; two half-spaces need neither. Of a distance: the points that
  // are so near.
  struct Met {
    IndexPair parts;
    std::vector<Generator> a, b;
    std::vector<Certificate::Term> closest;
    Certificate::Surface surface;
  };
  std::vector<Met> met;

  // A part of one body is inside of a solid mesh of the other, which winds around a point of it.
  struct Inside {
    bool a_is_inside = true;
    std::uint32_t part = 0;     // of the body that is inside
    std::uint32_t surface = 0;  // of the other; 0 of a mesh
  };
  std::optional<Inside> inside;
};

}  // namespace touchstone::oracle
